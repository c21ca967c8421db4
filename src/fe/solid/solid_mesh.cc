#include "fe/solid/solid_mesh.h"

#include "fe/body/body_properties.h"

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

namespace sprag
{
  using namespace dealii;

  bool is_symmetric_across(const Scene &scene)
  {
    return scene.cylinder.tilt == 0. && scene.cylinder.skew == 0. && scene.cylinder.position == 0.;
  }

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
    if (!is_symmetric_across(scene))
      return result;
    const double round_off = 1e-9 * width;
    std::vector<double> half{ 0. };
    std::copy_if(result.begin(), result.end(), std::back_inserter(half), [&](const double zeta) { return zeta > round_off; });
    return half;
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
