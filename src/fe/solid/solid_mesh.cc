#include "fe/solid/solid_mesh.h"

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <cmath>
#include <tuple>

namespace sprag
{
  using namespace dealii;

  std::vector<double> planes_across(const Scene &scene)
  {
    const unsigned int n = scene.mesh.elements_across;
    const double width   = scene.lever.width;
    std::vector<double> sizes(n);
    double sum = 0.;
    for (unsigned int i = 0; i < n; ++i)
      sum += sizes[i] = std::pow(scene.mesh.growth_across, std::min(i, n - 1 - i));
    std::vector<double> result{ -0.5 * width };
    for (const double size : sizes)
      result.push_back(result.back() + size / sum * width);
    result.back() = 0.5 * width;
    return result;
  }

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
    void free_ends(const double half_width, SolidMesh &mesh)
    {
      for (const auto &cell : mesh.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && std::abs(std::abs(face->center()[2]) - half_width) < 1e-9 * half_width)
            face->set_boundary_id(0);
    }
  } // namespace

  void extrude(const Scene &scene, const Mesh &plane, SolidMesh &mesh)
  {
    Mesh shared;
    share(plane, mesh.get_communicator(), shared);
    GridGenerator::extrude_triangulation(shared, planes_across(scene), mesh);
    free_ends(0.5 * scene.lever.width, mesh);
  }
} // namespace sprag
