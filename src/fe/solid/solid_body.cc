#include "fe/solid/solid_body.h"

#include "base/errors.h"
#include "fe/solid/solid_stiffness.h"
#include "fe/statics/lever_properties.h"
#include "scene/across.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/numerics/vector_tools.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    BodyProperties solid_properties(const Scene &scene)
    {
      auto result  = lever_properties(scene).body;
      result.plane = PlaneState::strain;                   // its constants are those of the body
      result.width = is_symmetric_across(scene) ? 2. : 1.; // stiffness and areas of a half stand for the whole
      result.widths.clear();
      if (scene.analysis.type != AnalysisType::quasi_static)
        result.point_spacing = scene.geometry.cylinder_radius / 1000.; // as of levers in a plane in time
      return result;
    }

    using Sharing = SolidMesh::Settings;

    /// To come before anything that all ranks do together.
    MPI_Comm called_to_build(const MPI_Comm ranks)
    {
      if (Utilities::MPI::this_mpi_process(ranks) == 0)
        call_others(SharedTask::build, ranks);
      return ranks;
    }
  } // namespace

  double skin_depth(const Scene &scene)
  {
    constexpr double over_radius = 0.08;
    return scene.layer.thickness + over_radius * scene.geometry.cylinder_radius;
  }

  SolidBody::SolidBody(const Scene &scene, const Mesh &plane, const MPI_Comm ranks_)
      : ranks(called_to_build(ranks_))
      , interface_offset(scene.geometry.interface_offset)
      , depth_of_skin(skin_depth(scene))
      , properties(solid_properties(scene))
      , mesh(ranks, SolidMesh::none, false, Sharing::partition_zorder)
      , fe(FE_Q<3>(properties.degree), 3)
      , dof_handler(mesh)
      , factors(ranks)
      , factors_of_skin(ranks)
  {
    extrude(scene, plane, mesh);
    dof_handler.distribute_dofs(fe);
    hold_hub();
    face = find_friction_face(mapping, dof_handler, constraints, properties, boundary_id::friction_face);
    order_face_nodes();
    number_skin();
    auto stiffness = assemble_stiffness({ mapping, dof_handler, constraints, properties }, number_in_skin);
    factors.factorise(std::move(stiffness.whole));
    if (has_skin())
      factors_of_skin.factorise(std::move(stiffness.part));
  }

  /// Mesh and factors are given back by all ranks together.
  SolidBody::~SolidBody()
  {
    if (Utilities::MPI::this_mpi_process(ranks) == 0)
      call_others(SharedTask::release, ranks);
  }

  void SolidBody::hold_hub()
  {
    VectorTools::interpolate_boundary_values(dof_handler, boundary_id::hub, Functions::ZeroFunction<3>(3), constraints);
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->material_id() == material_id::hub)
      {
        cell->get_dof_indices(indices);
        for (const auto index : indices)
          constraints.add_line(index);
      }
    VectorTools::interpolate_boundary_values(dof_handler, boundary_id::symmetry, Functions::ZeroFunction<3>(3), constraints,
                                             fe.component_mask(FEValuesExtractors::Scalar(2)));
    constraints.close();
  }

  /// Orders them along xi, those of the same xi along zeta.
  void SolidBody::order_face_nodes()
  {
    std::vector<unsigned int> order(face.nodes.size()), place(face.nodes.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto rounded = [&](const unsigned int node, const unsigned int d)
    { return std::lround(1e6 * face.nodes[node].position[d]); };
    std::sort(order.begin(), order.end(),
              [&](const unsigned int a, const unsigned int b)
              { return std::pair(rounded(a, 0), rounded(a, 2)) < std::pair(rounded(b, 0), rounded(b, 2)); });
    std::vector<FaceNode<3>> ordered;
    for (unsigned int i = 0; i < order.size(); ++i)
    {
      place[order[i]] = i;
      ordered.push_back(face.nodes[order[i]]);
    }
    face.nodes = std::move(ordered);
    for (auto &point : face.points)
      for (auto &[node, shape] : point.nodes)
        node = place[node];
    for (auto &edge : face.edges)
      for (auto &node : edge.nodes)
        if (node.index != FaceEdge<3>::held)
          node.index = place[node.index];
  }

  /// Numbers what belongs to the skin alone, all three displacements of its nodes. A lever that is no deeper has none.
  void SolidBody::number_skin()
  {
    std::vector<char> in_skin(n_dofs(), 0), elsewhere(n_dofs(), 0);
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->material_id() != material_id::hub)
      {
        cell->get_dof_indices(indices);
        for (const auto index : indices)
          (is_skin(cell) ? in_skin : elsewhere)[index] = 1;
      }
    int number = 0;
    number_in_skin.assign(n_dofs(), -1);
    for (unsigned int dof = 0; dof < n_dofs(); ++dof)
      if (in_skin[dof] && !elsewhere[dof])
        number_in_skin[dof] = number++;
    const bool is_all = std::find(elsewhere.begin(), elsewhere.end(), 1) == elsewhere.end();
    if (number == 0 || is_all)
      number_in_skin.clear();
  }

  std::array<double, 2> SolidBody::mass_and_inertia(const double density) const
  {
    FEValues<3> values(mapping, fe, QGauss<3>(2), update_quadrature_points | update_JxW_values);
    std::array<double, 2> result{};
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      for (const unsigned int q : values.quadrature_point_indices())
      {
        const auto &place = values.quadrature_point(q);
        const double mass = density * properties.width * values.JxW(q);
        result[0] += mass;
        result[1] += mass * (place[0] * place[0] + place[1] * place[1]);
      }
    }
    return result;
  }

  bool SolidBody::is_skin(const DoFHandler<3>::active_cell_iterator &cell) const
  {
    return cell->material_id() != material_id::hub && cell->center()[1] < interface_offset + depth_of_skin;
  }

  int SolidBody::number_near(const unsigned int dof) const
  {
    if (is_held(dof))
      return -1;
    return has_skin() ? number_in_skin[dof] : static_cast<int>(dof);
  }

  unsigned int SolidBody::n_near() const
  {
    return has_skin() ? factors_of_skin.size() : n_dofs();
  }

  void SolidBody::respond(std::vector<double> &loads) const
  {
    call_others(SharedTask::solve_whole, ranks);
    factors.solve(loads);
  }

  std::vector<double> SolidBody::respond(SparseColumns loads) const
  {
    call_others(SharedTask::solve_whole, ranks);
    return factors.solve(std::move(loads));
  }

  std::vector<double> SolidBody::respond_near(SparseColumns loads) const
  {
    if (!has_skin())
      return respond(std::move(loads));
    call_others(SharedTask::solve_near, ranks);
    return factors_of_skin.solve(std::move(loads));
  }

  void SolidBody::take_part(const SharedTask task) const
  {
    (task == SharedTask::solve_whole ? factors : factors_of_skin).take_part();
  }

  void help_first_rank(const Scene &scene, const MPI_Comm ranks)
  {
    std::unique_ptr<SolidBody> body;
    for (auto task = next_call(ranks); task != SharedTask::end; task = next_call(ranks))
      try
      {
        if (task == SharedTask::build)
          body = std::make_unique<SolidBody>(scene, Mesh(), ranks);
        else if (task == SharedTask::release)
          body.reset();
        else
          body->take_part(task);
      }
      catch (const AnalysisError &)
      {
        // The first rank fails as well and tells why.
      }
  }
} // namespace sprag
