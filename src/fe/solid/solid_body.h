// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/friction_face.h"
#include "fe/solid/body_factors.h"
#include "fe/solid/solid_mesh.h"

#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q1.h>

#include <optional>

namespace sprag
{
  struct Scene;

  struct FactorSettings
  {
    std::optional<bool> single = {}; ///< whether in single precision; without it those of large bodies without inertia are
    std::string folder         = {}; ///< for files with the factors of the whole body; empty: they stay in memory
  };

  /// What all ranks must know of a body in three dimensions besides its mesh.
  struct SolidProperties
  {
    BodyProperties body;
    double interface_offset = 0.; ///< e [mm]
    double layer            = 0.; ///< thickness [mm]
    double skin             = 0.; ///< how far it reaches from the friction face where nothing forbids it [mm]
    std::string folder;           ///< for files with factors of the whole body; empty: they stay in memory
  };

  /// The linear elastic lever in three dimensions, in axes in which its hub does not move. The ranks at hand hold the mesh and
  /// the numbers of its displacements, each for itself; they share stiffness and factors. The first asks the others for it, see
  /// help_first_rank(): what responds, factorises or releases is for the first.
  class SolidBody
  {
  public:
    /// Builds and factorises it from the scene's plane mesh, see make_solid_mesh(). Throws AnalysisError where the factorisation
    /// fails, InputError for a Mesh/File that cannot serve.
    SolidBody(const Scene &scene, const Mesh &plane, const FactorSettings &settings = {});

    /// Helps the first rank to build one.
    explicit SolidBody(MPI_Comm ranks);
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

    /// Those that hold the hub, and the middle of a half.
    const dealii::AffineConstraints<double> &held() const
    {
      return constraints;
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

    /// Returns the calls by which the first rank asks the others for help with this body.
    const BodyCalls &calls() const
    {
      return call_others;
    }

  private:
    SolidBody(const BodyCalls &calls, SolidProperties of_first);
    void number_displacements(bool is_half);
    void factorise(bool single);
    void do_factorise(bool single);
    void release();
    bool factors_serve();
    SparseColumns loads_on_face(bool near) const;
    void hold_hub();
    void find_skin();
    bool number_skin();
    void order_face_nodes();

    const BodyCalls call_others;
    const SolidProperties given;
    double depth_of_skin; ///< [mm]
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
    BodyFactors factors;
    BodyFactors factors_of_skin;
  };
} // namespace sprag
