#include "fe/solid/solid_mesh.h"

#include "fe/body/body_properties.h"
#include "scene/across.h"

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <cmath>
#include <tuple>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    using Description = std::tuple<std::vector<Point<2>>, std::vector<CellData<2>>, std::vector<CellData<1>>>;

    /// Gives all ranks the plane mesh of the first.
    void share(const Mesh &of_first_rank, const MPI_Comm ranks, Mesh &mesh)
    {
      Description description;
      if (Utilities::MPI::this_mpi_process(ranks) == 0)
      {
        auto [vertices, cells, boundary] = GridTools::get_coarse_mesh_description(of_first_rank);
        description                      = { vertices, cells, boundary.boundary_lines };
      }
      description = Utilities::MPI::broadcast(ranks, description);
      SubCellData boundary;
      boundary.boundary_lines = std::get<2>(description);
      mesh.create_triangulation(std::get<0>(description), std::get<1>(description), boundary);
    }

    /// GridGenerator gives both ends ids of their own, which mean something else here.
    void mark_ends(const double first, const double last, SolidMesh &mesh)
    {
      const double round_off = 1e-9 * last;
      for (const auto &cell : mesh.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
        {
          const double zeta = face->center()[2];
          if (face->at_boundary() && (std::abs(zeta - first) < round_off || std::abs(zeta - last) < round_off))
            face->set_boundary_id(first == 0. && std::abs(zeta) < round_off ? boundary_id::symmetry : 0);
        }
    }
  } // namespace

  void extrude(const Scene &scene, const Mesh &plane, SolidMesh &mesh)
  {
    Mesh shared;
    share(plane, mesh.get_communicator(), shared);
    const auto planes = planes_across(scene);
    GridGenerator::extrude_triangulation(shared, planes, mesh);
    mark_ends(planes.front(), planes.back(), mesh);
  }
} // namespace sprag
