#pragma once

#include "fe/body/friction_face.h"
#include "fe/solid/body_factors.h"
#include "fe/solid/solid_mesh.h"

#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q1.h>

#include <optional>

namespace sprag
{
  struct FactorSettings
  {
    std::optional<bool> single = {}; ///< whether in single precision; without it those of large bodies without inertia are
    std::string folder         = {}; ///< for files with the factors of the whole body; empty: they stay in memory
  };

  /// The linear elastic lever in three dimensions, in axes in which its hub does not move. All ranks hold the mesh and the
  /// numbers of its displacements; stiffness and factors are shared. Everything but construction is for the first rank.
  class SolidBody
  {
  public:
    /// To be called by all ranks with the plane mesh of the first, see make_solid_mesh(); the first calls the others to it.
    /// Throws AnalysisError where the factorisation fails, InputError for a Mesh/File that cannot serve.
    SolidBody(const Scene &scene, const Mesh &plane, MPI_Comm ranks, const FactorSettings &settings = {});
    SolidBody &operator=(SolidBody &&) = delete;
    ~SolidBody();

    unsigned int n_dofs() const
    {
      return dof_handler.n_dofs();
    }

    const dealii::DoFHandler<3> &dofs() const
    {
      return dof_handler;
    }

    const dealii::Mapping<3> &cell_mapping() const
    {
      return mapping;
    }

    const BodyProperties &body_properties() const
    {
      return properties;
    }

    bool is_held(const unsigned int dof) const
    {
      return constraints.is_constrained(dof);
    }

    /// Whether it is a half, which is the same on both sides of the middle.
    bool is_half() const
    {
      return properties.width == 2.;
    }

    /// Those of the friction plate, see find_connectors().
    const std::vector<Connector> &connectors() const
    {
      return springs;
    }

    const FrictionFace<3> &friction_face() const
    {
      return face;
    }

    /// How far the skin reaches from the friction face [mm]: beyond the layer as far as the pressure of a contact is more than
    /// its resultant, or less where there is too little behind it.
    double skin() const
    {
      return depth_of_skin;
    }

    /// Returns whether a cell is of the skin: the friction layer and a strip of what is behind it.
    bool is_skin(const dealii::DoFHandler<3>::active_cell_iterator &cell) const;

    /// Whether there is a skin and something behind it.
    bool has_skin() const
    {
      return !number_in_skin.empty();
    }

    /// Returns the number of a degree of freedom for loads of respond_near(), -1 where it has none: with a skin of those of the
    /// skin off its bond, else the degree of freedom itself where it is free.
    int number_near(unsigned int dof) const;

    /// Returns mass [t] and moment of inertia about the pivot [t mm^2] at the given density [t/mm^3], hub included.
    std::array<double, 2> mass_and_inertia(double density) const;

    /// Turns forces on the degrees of freedom [N] into displacements [mm].
    void respond(std::vector<double> &loads) const;

    /// Returns the displacements under sparse loads, one column after another.
    std::vector<double> respond(const SparseColumns &loads) const;

    /// Returns those of the skin on a rigid bond alone, by number_near(); without a skin those of the body.
    std::vector<double> respond_near(const SparseColumns &loads) const;

    /// Number of displacements in a column of respond_near().
    unsigned int n_near() const;

    /// Gives the factors back, after which nothing responds.
    void release_factors();

    /// Takes part in what the first rank does with the factors.
    void take_part(SharedTask task);

  private:
    void factorise(bool single);
    void release();
    void prepare_solves();
    void make_precise();
    SparseColumns loads_on_face(bool near) const;
    void hold_hub();
    void find_skin(double layer);
    bool number_skin();
    void order_face_nodes();

    const MPI_Comm ranks;
    const double interface_offset; ///< e [mm]
    double depth_of_skin;          ///< [mm]
    BodyProperties properties;
    SolidMesh mesh;
    const dealii::FESystem<3> fe;
    const dealii::MappingQ1<3> mapping;
    dealii::DoFHandler<3> dof_handler;
    dealii::AffineConstraints<double> constraints;
    FrictionFace<3> face;
    double face_begin = 0.; ///< along xi [mm]
    double face_end   = 0.;
    std::vector<Connector> springs;
    std::vector<int> number_in_skin;
    const std::vector<int> all; ///< no numbers
    std::string folder;         ///< for files with factors of the whole
    BodyFactors factors;
    BodyFactors factors_of_skin;
  };

  /// Builds the scene's body with the first rank and takes part in its solves until it ends. To be called by the others.
  void help_first_rank(const Scene &scene, MPI_Comm ranks);
} // namespace sprag
