// SPDX-License-Identifier: GPL-3.0-only
#include "fe/statics/solid_body.h"

#include "base/errors.h"
#include "base/messages.h"
#include "base/ranges.h"
#include "fe/body/cell_stiffness.h"
#include "fe/body/end_face.h"
#include "fe/statics/lever_properties.h"
#include "scene/analysis_use.h"
#include "scene/device.h"
#include "scene/lever_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprag
{
  using namespace dealii;

  void serialise(Archive &archive, SolidProperties &properties)
  {
    auto &body = properties.body;
    archive(body.degree, body.plane, body.material, body.width, body.curved, body.point_spacing, body.constants,
            properties.interface_offset, properties.layer, properties.near_layer_depth, properties.folder);
  }

  namespace
  {
    void add_guide(const ElasticBody<3> &body, const Device &device, const bool is_half, std::vector<Connector> &result)
    {
      const auto &plate      = device.plate;
      const double half      = 0.5 * device.lever.width;
      const double xi        = 0.5 * plate.sensor_length;
      const double stiffness = plate.guide_stiffness;
      const FacingPads<3> pads(ConnectorType::guide,
                               { { { plate.guide - xi, is_half ? 0. : -half } }, { { plate.guide + xi, half } } }, body);
      result.push_back(connector(ConnectorType::guide, stiffness, pads.shift(0)));
      if (is_half)
        return;
      result.push_back(connector(ConnectorType::guide, stiffness, pads.shift(1)));
      result.push_back(connector(ConnectorType::guide, stiffness * half * half / 3., pads.turn()));
    }

    /// Finds the connectors of the scene's friction plate; none without one. First come the sensors, of each place along the
    /// lever that on the left (zeta < 0) and that on the right, half as stiff as the place each; of a half, which is the same on
    /// both sides of the middle and has zeta >= 0, the right one alone, which stands for both. Then comes the guide, over the
    /// whole width: a spring along the lever, and of a whole also one across it, as stiff, and one against turning about eta, as
    /// of springs along the lever spread over the width [N mm]. Throws InputError as FacingPads.
    std::vector<Connector> find_connectors(const ElasticBody<3> &body, const Device &device, const bool is_half)
    {
      const auto &plate = device.plate;
      std::vector<Connector> result;
      if (plate.type == PlateType::none)
        return result;
      const double middle = sensors_across(device), xi = 0.5 * plate.sensor_length, zeta = 0.5 * plate.sensor_width;
      for (const double place : plate.sensors)
        for (const double side : { -1., 1. })
        {
          if (is_half && side < 0.)
            continue;
          const FacingPads<3> pads(ConnectorType::sensor,
                                   { { { place - xi, side * middle - zeta } }, { { place + xi, side * middle + zeta } } }, body);
          const double share = is_half ? 1. : 0.5;
          result.push_back(connector(ConnectorType::sensor, share * plate.sensor_stiffness, pads.approach()));
        }
      add_guide(body, device, is_half, result);
      return result;
    }

    /// Adds the stiffness of a connector to that of its body.
    void add(const Connector &connector, MatrixEntries &stiffness)
    {
      for (const auto &[row, row_weight] : connector.row)
        for (const auto &[column, column_weight] : connector.row)
          if (row <= column)
            stiffness.add(row, column, connector.stiffness * row_weight * column_weight);
    }

    BodyProperties solid_properties(const Device &device)
    {
      auto result  = lever_properties(device).body;
      result.plane = PlaneState::strain; // its constants are those of the body
      result.planes.clear();
      result.width = 1.;
      result.widths.clear();
      result.connectors.clear(); // has its own
      result.curved = false;
      if (device.analysis.type != AnalysisType::quasi_static)
        result.point_spacing = device.geometry.cylinder_radius / 1000.; // as of levers in a plane in time
      return result;
    }

    /// Returns how far the near-surface layer of a lever reaches from its friction face where nothing forbids it [mm]: beyond the
    /// layer as far as the pressure of a contact is more than its resultant.
    double largest_near_layer_depth(const Device &device)
    {
      constexpr double over_radius = 0.08;
      return device.layer.thickness + over_radius * device.geometry.cylinder_radius;
    }

    /// Returns true if the side of a cell away from the friction face is free.
    bool has_free_back(const DoFHandler<3>::active_cell_iterator &cell)
    {
      const auto is_back = [&](const auto &face)
      {
        const auto offset = face->center() - cell->center();
        return offset[1] > std::abs(offset[0]) && offset[1] > std::abs(offset[2]);
      };
      const auto faces = cell->face_iterators();
      return std::any_of(faces.begin(), faces.end(), [&](const auto &face) { return face->at_boundary() && is_back(face); });
    }

    SolidProperties make_properties(const Device &device, const std::string &folder)
    {
      return { solid_properties(device), device.geometry.interface_offset, device.layer.thickness,
               largest_near_layer_depth(device), folder };
    }

    /// Returns those that the first rank has, which calls the others to build the body.
    SolidProperties shared(const BodyCalls &call_others, SolidProperties properties)
    {
      call_others(SharedTask::build);
      return broadcast(call_others.ranks, std::move(properties));
    }

    /// Stiffness and areas of a half stand for the whole.
    BodyProperties to_whole(BodyProperties properties, const bool is_half)
    {
      properties.width = is_half ? 2. : 1.;
      return properties;
    }

    /// Adds a cell's part of the upper triangle on those of its displacements that have numbers.
    void add(const FullMatrix<double> &cell_matrix, const std::vector<int> &numbers, MatrixEntries &entries)
    {
      for (unsigned int i = 0; i < numbers.size(); ++i)
        for (unsigned int j = 0; j <= i && numbers[i] >= 0; ++j)
          if (numbers[j] >= 0 && cell_matrix(i, j) != 0.)
            entries.add(std::min(numbers[i], numbers[j]), std::max(numbers[i], numbers[j]), cell_matrix(i, j));
    }

    /// Returns the numbers of a cell's displacements, -1 also where they are held.
    std::vector<int> cell_numbers(const DoFHandler<3>::active_cell_iterator &cell, const ElasticBody<3> &body,
                                  const std::vector<int> &number_in_part)
    {
      const auto indices = cell_dofs(cell);
      std::vector<int> result(indices.size(), -1);
      for (unsigned int i = 0; i < indices.size(); ++i)
        if (!body.is_held(static_cast<unsigned int>(indices[i])))
          result[i] = number_in_part.empty() ? static_cast<int>(indices[i]) : number_in_part[indices[i]];
      return result;
    }
  } // namespace

  MatrixEntries assemble_stiffness(const ElasticBody<3> &body, const std::vector<int> &number_in_part)
  {
    std::vector<std::pair<DoFHandler<3>::active_cell_iterator, std::vector<int>>> cells;
    for (const auto &cell : body.dofs().active_cell_iterators())
      if (cell->is_locally_owned() && cell->material_id() != material_id::hub)
      {
        auto numbers = cell_numbers(cell, body, number_in_part);
        if (std::any_of(numbers.begin(), numbers.end(), [](const int number) { return number >= 0; }))
          cells.emplace_back(cell, std::move(numbers));
      }

    MatrixEntries result;
    result.size = number_in_part.empty() ? body.n_dofs() : 1 + *std::max_element(number_in_part.begin(), number_in_part.end());
    const std::size_t n = body.dofs().get_fe().n_dofs_per_cell();
    // Growing vectors would take twice the memory, which is what limits a run.
    result.reserve(cells.size() * n * (n + 1) / 2 + body.held().n_constraints());
    CellStiffness<3> stiffness(body);
    for (const auto &[cell, numbers] : cells)
      add(stiffness(cell), numbers, result);
    for (const auto index : body.dofs().locally_owned_dofs())
      if (const int number = number_in_part.empty() ? static_cast<int>(index) : number_in_part[index];
          number >= 0 && body.held().is_constrained(index))
        result.add(number, number, 1.);
    return result;
  }

  SharedSolid::SharedSolid(const BodyCalls &calls, SolidProperties first_data, const Device *const device,
                           const Mesh *const plane)
      : call_others(calls)
      , solid(shared(calls, std::move(first_data)))
      , mesh(calls.ranks, SolidMesh::none, false, SolidMesh::Settings::partition_zorder)
      , half(device != nullptr ? make_solid_mesh(*device, *plane, mesh) : receive_solid_mesh(mesh))
  {
  }

  SolidBody::SolidBody(const Device &device, const Mesh &plane, const std::string &folder)
      : SolidBody(BodyCalls(), make_properties(device, folder), &device, &plane)
  {
    use_connectors(find_connectors(*this, device, half));
    call_others(SharedTask::factorise);
    factorise();
  }

  SolidBody::SolidBody(const MPI_Comm ranks)
      : SolidBody(BodyCalls(ranks), SolidProperties(), nullptr, nullptr)
  {
  }

  SolidBody::SolidBody(const BodyCalls &calls, SolidProperties first_data, const Device *const device, const Mesh *const plane)
      : SharedSolid(calls, std::move(first_data), device, plane)
      , ElasticBody<3>(mesh, to_whole(solid.body, half))
      , near_depth(solid.near_layer_depth)
  {
    for (const auto &edge : friction_face().edges)
      for (const auto &node : edge.nodes)
      {
        face_begin = std::min(face_begin, node.position[0]);
        face_end   = std::max(face_end, node.position[0]);
      }
    find_near_layer();
  }

  /// Returns factors of the stiffness of a part, see assemble_stiffness(), with connectors of the whole body, which the first
  /// rank gives. With a folder they are kept in files there, else in memory.
  std::unique_ptr<Mumps> SolidBody::factorised_part(const std::vector<int> &number_in_part,
                                                    const std::vector<Connector> &connectors, const std::string &folder) const
  {
    auto entries = assemble_stiffness(*this, number_in_part);
    for (const auto &connector : connectors)
      add(connector, entries);
    auto result = std::make_unique<Mumps>(MatrixKind::solid_stiffness, call_others.ranks, folder);
    result->factorise(std::move(entries));
    return result;
  }

  /// Factors of the whole come first: nothing else takes memory then.
  void SolidBody::factorise()
  {
    factors = factorised_part({}, connectors(), solid.folder);
    if (has_near_layer())
      near_factors = factorised_part(near_number, {}, {});
  }

  /// Mesh and factors are given back by all ranks together.
  SolidBody::~SolidBody()
  {
    call_others(SharedTask::release);
  }

  /// Makes the near-surface layer shallower until it is bonded everywhere; where it never is, there is none.
  void SolidBody::find_near_layer()
  {
    constexpr double least = 1e-3;
    while (!number_near_layer())
    {
      if (near_depth < solid.layer + least)
        return near_number.clear();
      near_depth = solid.layer + 0.5 * (near_depth - solid.layer);
    }
  }

  /// Numbers what belongs to the near-surface layer alone, all three displacements of its nodes. A lever that is no deeper has
  /// none. Returns false where a part of it has nothing behind it, as a flange beside a web or a plate.
  bool SolidBody::number_near_layer()
  {
    std::vector<char> in_near_layer(n_dofs(), 0), elsewhere(n_dofs(), 0);
    bool is_bonded = true;
    for (const auto &cell : dofs().active_cell_iterators())
      if (cell->material_id() != material_id::hub)
      {
        for (const auto index : cell_dofs(cell))
          (is_near_layer(cell) ? in_near_layer : elsewhere)[index] = 1;
        is_bonded = is_bonded && !(is_near_layer(cell) && has_free_back(cell));
      }
    n_near_dofs = 0;
    near_number.assign(n_dofs(), -1);
    for (unsigned int dof = 0; dof < n_dofs(); ++dof)
      if (in_near_layer[dof] && !elsewhere[dof])
        near_number[dof] = static_cast<int>(n_near_dofs++);
    const bool is_all = !contains(elsewhere, 1);
    if (n_near_dofs == 0 || is_all)
      near_number.clear();
    return is_bonded || near_number.empty();
  }

  bool SolidBody::is_near_layer(const DoFHandler<3>::active_cell_iterator &cell) const
  {
    const auto centre = cell->center();
    return cell->material_id() != material_id::hub && centre[1] > solid.interface_offset &&
           centre[1] < solid.interface_offset + near_depth && centre[0] > face_begin && centre[0] < face_end;
  }

  int SolidBody::number_near(const unsigned int dof) const
  {
    if (is_held(dof))
      return -1;
    return has_near_layer() ? near_number[dof] : static_cast<int>(dof);
  }

  void SolidBody::respond(std::vector<double> &loads) const
  {
    call_others(SharedTask::solve_whole);
    factors->solve(loads);
  }

  std::vector<double> SolidBody::respond(const SparseColumns &loads) const
  {
    call_others(SharedTask::solve_whole);
    return factors->solve(loads);
  }

  std::vector<double> SolidBody::respond_near(const SparseColumns &loads) const
  {
    if (!has_near_layer())
      return respond(loads);
    call_others(SharedTask::solve_near);
    return near_factors->solve(loads);
  }

  void SolidBody::release_factors()
  {
    call_others(SharedTask::release_factors);
    release();
  }

  void SolidBody::release()
  {
    factors.reset();
    near_factors.reset();
  }

  void SolidBody::take_part(const SharedTask task)
  {
    switch (task)
    {
    case SharedTask::solve_whole:
      return factors->take_part();
    case SharedTask::solve_near:
      return near_factors->take_part();
    case SharedTask::factorise:
      return factorise();
    default:
      return release();
    }
  }
} // namespace sprag
