// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/algebra/first_rank.h"
#include "fe/algebra/mumps.h"
#include "fe/body/dimension.h"
#include "fe/body/elastic_body.h"

#include <deal.II/distributed/shared_tria.h>

#include <memory>
#include <optional>

namespace sprag
{
  struct Device;

  /// A mesh of three dimensions, which every rank knows whole and shares the work on.
  using SolidMesh = dealii::parallel::shared::Triangulation<3>;

  /// Extrudes the plane mesh of the scene's lever over its width, or over a half of it where it is symmetric; zeta counts from
  /// the middle. A web is as wide as the scene has it, in the middle: planes across hold its sides, and its cells beyond them are
  /// left out. Materials and boundaries keep their ids, the ends are free, that in the middle boundary_id::symmetry. A plane mesh
  /// without cells stands for a Mesh/File of three dimensions, which is read as it is. Returns whether the mesh is a half. To be
  /// called by the first rank, while the others receive_solid_mesh(). All throw InputError for a file that cannot serve, see
  /// read_solid_file().
  bool make_solid_mesh(const Device &device, const Mesh &plane, SolidMesh &mesh);

  /// Receives what the first rank makes.
  bool receive_solid_mesh(SolidMesh &mesh);

  /// Returns this rank's entries of the stiffness of a part of a body without load, with unit entries for held degrees of
  /// freedom. A part is given by a number for each degree of freedom, from 0, -1 where it is not of the part; no numbers stand
  /// for the whole body. To be called by all ranks.
  MatrixEntries assemble_stiffness(const ElasticBody<3> &body, const std::vector<int> &number_in_part);

  /// Properties of a body in three dimensions that all ranks know besides its mesh.
  struct SolidProperties
  {
    BodyProperties body;
    double interface_offset = 0.; ///< e [mm]
    double layer            = 0.; ///< thickness [mm]
    double near_layer_depth = 0.; ///< how far it reaches from the friction face where nothing forbids it [mm]
    std::string folder;           ///< for files with factors of the whole body; empty: they stay in memory
  };

  /// The mesh of a body in three dimensions, which the ranks at hand build together before there is a body on it.
  struct SharedSolid
  {
    /// The first rank builds from the scene's plane mesh, see make_solid_mesh(), the others without a scene help.
    SharedSolid(const BodyCalls &calls, SolidProperties first_data, const Device *device, const Mesh *plane);

    const BodyCalls call_others;
    const SolidProperties solid;
    SolidMesh mesh;
    bool half; ///< whether it is a half, which is the same on both sides of the middle
  };

  /// The lever in three dimensions. The ranks at hand hold the mesh and the numbers of its displacements, each for itself; they
  /// share stiffness without load and its factors. The first asks the others for it, see help_first_rank(): what responds,
  /// factorises or releases is for the first.
  class SolidBody : private SharedSolid, public ElasticBody<3>
  {
  public:
    /// Builds and factorises it from the scene's plane mesh, see make_solid_mesh(); the factors of the whole body are kept in
    /// files in a folder, or without one in memory. Throws AnalysisError where the factorisation
    /// fails, InputError for a Mesh/File that cannot serve.
    SolidBody(const Device &device, const Mesh &plane, const std::string &folder = {});

    /// Helps the first rank to build one.
    explicit SolidBody(MPI_Comm ranks);
    SolidBody &operator=(SolidBody &&) = delete;
    ~SolidBody();

    /// Returns true if the body is a half, which is the same on both sides of the middle.
    bool is_half() const
    {
      return half;
    }

    /// Depth of the near-surface layer from the friction face [mm]: beyond the layer as far as the pressure of a contact is more
    /// than its resultant, or less where there is too little behind it.
    double near_layer_depth() const
    {
      return near_depth;
    }

    /// Returns whether a cell is of the near-surface layer: the friction layer and a strip of what is behind it.
    bool is_near_layer(const dealii::DoFHandler<3>::active_cell_iterator &cell) const;

    /// Returns true if there is a near-surface layer and something behind it.
    bool has_near_layer() const
    {
      return !near_number.empty();
    }

    /// Returns the number of a degree of freedom for loads of respond_near(), -1 where it has none: with a near-surface layer of
    /// those of the near-surface layer off its bond, else the degree of freedom itself where it is free.
    int number_near(unsigned int dof) const;

    /// Turns forces on the degrees of freedom [N] into displacements [mm].
    void respond(std::vector<double> &loads) const;

    /// Returns the displacements under sparse loads, one column after another.
    std::vector<double> respond(const SparseColumns &loads) const;

    /// Returns those of the near-surface layer on a rigid bond alone, by number_near(); without a near-surface layer those of the
    /// body.
    std::vector<double> respond_near(const SparseColumns &loads) const;

    /// Number of displacements in a column of respond_near().
    unsigned int n_near() const
    {
      return has_near_layer() ? n_near_dofs : n_dofs();
    }

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
    SolidBody(const BodyCalls &calls, SolidProperties first_data, const Device *device, const Mesh *plane);
    std::unique_ptr<Mumps> factorised_part(const std::vector<int> &number_in_part, const std::vector<Connector> &connectors,
                                           const std::string &folder) const;
    void factorise();
    void release();
    void find_near_layer();
    bool number_near_layer();

    double near_depth;                                      ///< [mm]
    double face_begin = std::numeric_limits<double>::max(); ///< along xi [mm]
    double face_end   = -face_begin;
    std::vector<int> near_number;
    unsigned int n_near_dofs = 0; ///< such numbers
    std::unique_ptr<Mumps> factors;
    std::unique_ptr<Mumps> near_factors;
  };

  /// Returns the answer by the factors of a body, which must outlive it.
  inline Response make_response(const SolidBody &body)
  {
    return [&body](std::vector<double> columns)
    {
      body.respond(columns);
      return columns;
    };
  }
} // namespace sprag
