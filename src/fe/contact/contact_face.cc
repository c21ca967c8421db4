// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/contact_face.h"

#include "base/errors.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace sprag
{
  template <int dim>
  void FaceEvaluation<dim>::begin(const dealii::Vector<double> &displacements, const double at_x, const double duration_)
  {
    displacement      = displacements;
    x                 = at_x;
    duration          = duration_;
    within_candidates = true;
    sums              = {};
    points.clear();
  }

  template <int dim>
  std::string FaceEvaluation<dim>::check_validity() const
  {
    if (!sums.beyond_face)
      return {};
    return dim == 2 ? "the contact reaches the end of the cylinder's face"
                    : "the contact reaches the end of the friction face, or of the part of it that is looked at";
  }

  template <int dim>
  std::vector<ContactHistory> FaceEvaluation<dim>::history() const
  {
    if (sums.beyond_face)
      throw AnalysisError(dim == 3 ? check_validity()
                                   : "the contact reaches the end of the part of the elastic cylinder's surface that is meshed "
                                     "to touch the lever, at x = " +
                                         rounded_text(x) +
                                         " mm: the cylinder yields or the lever bends too much. Try a larger Cylinder/Young "
                                         "modulus or a rigid cylinder.");
    std::vector<ContactHistory> result;
    for (const auto &point : points)
      if (point.pressure > 0.)
        result.push_back(point.history);
    return result;
  }

  template struct FaceEvaluation<2>;
  template struct FaceEvaluation<3>;

  namespace
  {
    /// Returns the nodes that lie closest to a zeta, in a plane all.
    template <int dim>
    std::vector<unsigned int> nodes_at(const FrictionFace<dim> &face, const double zeta)
    {
      const auto distance = [&](const FaceNode<dim> &node) { return dim == 3 ? std::abs(node.position[dim - 1] - zeta) : 0.; };
      double closest      = std::numeric_limits<double>::max();
      for (const auto &node : face.nodes)
        closest = std::min(closest, distance(node));
      std::vector<unsigned int> result;
      for (unsigned int i = 0; i < face.nodes.size(); ++i)
        if (distance(face.nodes[i]) < closest + 1e-6)
          result.push_back(i);
      return result;
    }

    /// Displacement along eta at xi, linear between the points [mm].
    double deflection(const FaceElements<2> &face, const dealii::Vector<double> &displacement, const double xi)
    {
      const auto &points     = face.points;
      const auto is_before   = [](const auto &point, const double value) { return point.position[0] < value; };
      const auto after       = std::lower_bound(points.begin() + 1, points.end() - 1, xi, is_before);
      const auto before      = after - 1;
      const double share     = std::clamp((xi - before->position[0]) / (after->position[0] - before->position[0]), 0., 1.);
      const auto point_value = [&](const FacePoint<2> &point)
      {
        const auto &element = face.elements[face.point_elements[&point - points.data()]];
        double result       = 0.;
        for (unsigned int a = 0; a < element.n_nodes; ++a)
          result += point.shapes[a] * displacement[2 * element.nodes[a] + 1];
        return result;
      };
      return (1. - share) * point_value(*before) + share * point_value(*after);
    }

    /// Distance of the places beside the contact at which the face is looked at from its middle [mm].
    double distance_beside(const double thickness, const Row &row)
    {
      return 0.5 * row[Column::contact_width] + 4. * thickness;
    }

    /// Returns the deflection of a layer's face at the centre of pressure over that aside of the contact, from the columns that
    /// are filled [mm]; 0 without a layer.
    double indentation(const FaceElements<2> &face, const double thickness, const FaceEvaluation<2> &found, const Row &row)
    {
      if (thickness == 0. || !(row[Column::normal_resultant] > 0.))
        return 0.;
      const double centre = row[Column::s];
      const double aside  = distance_beside(thickness, row);
      const auto at       = [&](const double xi) { return deflection(face, found.displacement, xi); };
      return at(centre) - 0.5 * (at(centre - aside) + at(centre + aside));
    }

    /// Friction over pressure at a point.
    struct FrictionRatio
    {
      double ratio = 0.;
      double mu    = 0.; ///< largest ratio
    };

    /// Returns the ratio of every point; those without pressure take it from one beside them.
    std::vector<FrictionRatio> friction_ratios(const std::vector<FacePointState<2>> &points)
    {
      const auto is_closed   = [](const FacePointState<2> &point) { return point.pressure > 0.; };
      const auto point_ratio = [](const FacePointState<2> &point) {
        return FrictionRatio{ point.traction[0] / point.pressure, point.mu };
      };
      const auto first = std::find_if(points.begin(), points.end(), is_closed);
      auto friction    = first == points.end() ? FrictionRatio() : point_ratio(*first);
      std::vector<FrictionRatio> result;
      for (const auto &point : points)
      {
        if (is_closed(point))
          friction = point_ratio(point);
        result.push_back(friction);
      }
      return result;
    }

    /// Returns the friction that the recovered pressure takes along: in the ratio of each point, then as far towards mu p, either
    /// way, as the resultant of the points asks, the same share of the way everywhere.
    std::vector<double> recovered_traction(const FrictionFace<2> &face, const FaceEvaluation<2> &found,
                                           const std::vector<double> &pressure)
    {
      const auto friction = friction_ratios(found.points);
      const auto area     = [&](const std::size_t i) { return face.points[found.points[i].index].weight; };
      std::vector<double> result;
      double lacking = 0.;
      for (std::size_t i = 0; i < friction.size(); ++i)
      {
        result.push_back(friction[i].ratio * pressure[i]);
        lacking += area(i) * (found.points[i].traction[0] - result.back());
      }
      const auto deficit = [&](const std::size_t i) { return std::copysign(friction[i].mu * pressure[i], lacking) - result[i]; };
      double whole       = 0.;
      for (std::size_t i = 0; i < friction.size(); ++i)
        whole += area(i) * deficit(i);
      if (lacking * whole > 0.)
        for (std::size_t i = 0; i < friction.size(); ++i)
          result[i] += std::min(1., lacking / whole) * deficit(i);
      return result;
    }

    /// See ContactFace; `lines`: see lines_along().
    DofLoads find_indentation_shares(const FrictionFace<3> &face, const std::vector<std::vector<unsigned int>> &lines,
                                     const double thickness, const Row &row)
    {
      if (thickness == 0. || !(row[Column::normal_resultant] > 0.) || lines.empty())
        return {};
      const auto distance  = [&](const auto &some) { return std::abs(face.nodes[some.front()].position[2] - row.across[4]); };
      const auto is_closer = [&](const auto &a, const auto &b) { return distance(a) < distance(b); };
      const auto &line     = *std::min_element(lines.begin(), lines.end(), is_closer);
      const auto xi_at     = [&](const std::size_t i) { return face.nodes[line[i]].position[0]; };
      const auto is_before = [&](const unsigned int node, const double xi) { return face.nodes[node].position[0] < xi; };
      std::map<unsigned int, double> shares;
      // Between nodes the displacement follows a parabola through three of them.
      const auto add = [&](const double xi, const double factor)
      {
        const auto after = std::lower_bound(line.begin(), line.end(), xi, is_before) - line.begin();
        const auto first = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(after - 1, 0, line.size() - 3));
        for (std::size_t i = first; i < first + 3; ++i)
        {
          double share = factor;
          for (std::size_t j = first; j < first + 3; ++j)
            if (j != i)
              share *= (xi - xi_at(j)) / (xi_at(i) - xi_at(j));
          shares[3 * line[i] + 1] += share;
        }
      };
      const double aside = distance_beside(thickness, row);
      add(row[Column::s], 1.);
      add(row[Column::s] - aside, -0.5);
      add(row[Column::s] + aside, -0.5);
      DofLoads result{ {}, dealii::Vector<double>(static_cast<unsigned int>(shares.size())) };
      for (const auto &[dof, share] : shares)
      {
        result.values[static_cast<unsigned int>(result.dofs.size())] = share;
        result.dofs.push_back(dof);
      }
      return result;
    }
  } // namespace

  template <int dim>
  ContactFace<dim>::ContactFace(const FrictionFace<dim> &face_, FaceProperties properties_)
      : face(face_)
      , grid(face)
      , properties(std::move(properties_))
      , parts(face_parts(face))
  {
    if constexpr (looks_beside)
      lines = lines_along(face);
  }

  template <int dim>
  DofLoads ContactFace<dim>::indentation_shares([[maybe_unused]] const Row &row, unsigned int) const
  {
    if constexpr (looks_beside)
      return find_indentation_shares(face, lines, properties.layer_thickness, row);
    else
      return {};
  }

  template <int dim>
  AxisSlopes ContactFace<dim>::axis_turn(const dealii::Vector<double> &displacements) const
  {
    AxisSlopes result{};
    for (unsigned int i = 0; i < properties.layout.slopes; ++i)
      result[i] = displacements[properties.layout.slope(i)];
    return result;
  }

  template <int dim>
  AxisSlopes ContactFace<dim>::slopes_in(const FaceEvaluation<dim> &found) const
  {
    auto result = axis_turn(found.displacement);
    for (unsigned int i = 0; i < 2; ++i)
      result[i] += properties.cylinder.slopes[i];
    return result;
  }

  template <int dim>
  SurfaceShape ContactFace<dim>::surface_shape(const dealii::Vector<double> &displacements, unsigned int) const
  {
    SurfaceShape shape;
    for (const unsigned int node : nodes_at(face, 0.))
    {
      shape.xi.push_back(face.nodes[node].position[0]);
      shape.along.push_back(displacements[dim * node]);
      shape.across.push_back(displacements[dim * node + 1]);
    }
    return shape;
  }

  /// Reports the recovered pressure in a plane, that of the points on a surface.
  template <int dim>
  FaceState ContactFace<dim>::face_state(const FaceEvaluation<dim> &found, const DrivePoint &drive) const
  {
    const std::vector<double> nothing(parts.points.xi.size(), 0.);
    FaceState result{ drive.time, drive.x, nothing, nothing, {}, {}, {} };
    if constexpr (dim == 2)
    {
      const auto pressure = recover(pressure_samples(found, 0)).pressure;
      const auto traction = recovered_traction(face, found, pressure);
      for (std::size_t i = 0; i < found.points.size(); ++i)
      {
        result.pressure[found.points[i].index] = pressure[i];
        result.traction[found.points[i].index] = traction[i];
      }
    }
    else
    {
      result.traction_across = nothing;
      for (const auto &point : found.points)
      {
        const unsigned int part = parts.point_parts[point.index];
        const double share      = face.points[point.index].weight / parts.points.weight[part];
        result.pressure[part] += share * point.pressure;
        result.traction[part] += share * point.traction[0];
        result.traction_across[part] += share * point.end_force[2];
      }
    }
    return result;
  }

  template <int dim>
  double ContactFace<dim>::drive_force(const FaceEvaluation<dim> &found) const
  {
    double sum = 0.;
    for (const auto &point : found.points)
      sum -= face.points[point.index].weight * point.end_force[dim + 1];
    return sum;
  }

  template <int dim>
  void ContactFace<dim>::observe(const FaceEvaluation<dim> &found, Row &row, unsigned int) const
  {
    observe_contact(found, row);
    if constexpr (dim == 2)
      row[Column::indentation] = indentation(grid, properties.layer_thickness, found, row);
  }

  template <int dim>
  void ContactFace<dim>::observe_contact(const FaceEvaluation<dim> &found, Row &row) const
  {
    observe_resultants(found, row);
    observe_pressure(found, row);
    row[Column::Q] = drive_force(found);
    if constexpr (dim == 3)
      if (properties.cylinder.has_free_axis)
      {
        const auto slopes = slopes_in(found);
        row.across.insert(row.across.end(), slopes.begin(), slopes.end());
      }
  }

  template <int dim>
  void ContactFace<dim>::observe_resultants(const FaceEvaluation<dim> &found, Row &row) const
  {
    double normal = 0., speed = 0., mu = 0., power = 0., energy = 0., active = 0.;
    double elastic_slip = 0., penetration = 0., excess = 0., cone = 0.;
    dealii::Tensor<1, dim> force, position;
    Slip friction;
    for (const auto &point : found.points)
    {
      penetration = std::max(penetration, -point.gap);
      if (!(point.pressure > 0.))
        continue;
      const auto &face_point = face.points[point.index];
      const double area      = face_point.weight;
      double free            = 0.; // share of a force here that nodes take which the hub does not hold
      dealii::Tensor<1, dim> moved;
      const auto &element = face.elements[point.element];
      for (unsigned int a = 0; a < element.n_nodes; ++a)
      {
        free += face_point.shapes[a];
        for (unsigned int d = 0; d < dim; ++d)
          moved[d] += face_point.shapes[a] * found.displacement[dim * element.nodes[a] + d];
      }
      for (unsigned int d = 0; d < dim; ++d)
      {
        force[d] += area * free * point.end_force[d];
        energy += 0.5 * area * point.end_force[d] * moved[d];
      }
      const auto rate = found.duration > 0. ? point.slip_change / found.duration : Slip();
      normal += area * point.pressure;
      friction += area * point.traction;
      position += area * point.pressure * point.position;
      speed += area * point.pressure * rate[0];
      mu += area * point.pressure * point.mu;
      power += area * (point.traction * rate);
      active += 1.;
      elastic_slip = std::max(elastic_slip, point.elastic_slip);
      excess       = std::max(excess, point.traction.norm() - point.mu * point.pressure);
      cone         = std::max(cone, point.mu * point.pressure);
    }
    row[Column::P]                  = force[1];
    row[Column::F]                  = -force[0];
    row[Column::normal_resultant]   = normal;
    row[Column::friction_resultant] = friction[0];
    row[Column::friction_power]     = power;
    row[Column::elastic_energy]     = energy;
    row[Column::active_points]      = active;
    row[Column::elastic_slip]       = elastic_slip;
    row[Column::penetration]        = penetration;
    row[Column::cone_violation]     = cone > 0. ? excess / cone : 0.;
    if (normal > 0.)
    {
      row[Column::s]  = position[0] / normal;
      row[Column::mu] = mu / normal;
      if (found.duration > 0.)
        row[Column::v_rel] = speed / normal;
    }
    if constexpr (dim == 3)
    {
      row.across.assign(columns_across().size(), 0.);
      if (properties.half)
        return;
      row.across[0] = force[2];
      row.across[1] = normal > 0. ? position[2] / normal : 0.;
      for (const auto &point : found.points)
      {
        const double arm = face.points[point.index].weight * point.position[2];
        row.across[2] += arm * point.end_force[1];
        row.across[3] -= arm * point.end_force[0];
      }
    }
  }

  template <int dim>
  PressureSamples ContactFace<dim>::pressure_samples(const FaceEvaluation<dim> &found, const unsigned int line) const
  {
    PressureSamples samples;
    for (const auto &point : found.points)
      if (grid.point_lines[point.index] == line)
      {
        samples.xi.push_back(point.position[0]);
        samples.weight.push_back(face.points[point.index].weight);
        samples.pressure.push_back(point.pressure);
        samples.trial.push_back(point.trial_pressure);
        samples.cell.push_back(point.element);
      }
    samples.begin = face.points[grid.lines[line].front()].position[0];
    samples.end   = face.points[grid.lines[line].back()].position[0];
    return samples;
  }

  /// On a surface the pressure is recovered as in a plane, along the points with the zeta where it is largest.
  template <int dim>
  void ContactFace<dim>::observe_pressure(const FaceEvaluation<dim> &found, Row &row) const
  {
    row[Column::contact_width] = row[Column::largest_pressure] = 0.;
    const auto by_pressure = [](const auto &a, const auto &b) { return a.pressure < b.pressure; };
    const auto largest     = std::max_element(found.points.begin(), found.points.end(), by_pressure);
    if (largest == found.points.end() || largest->pressure == 0.)
      return;
    const auto samples               = pressure_samples(found, grid.point_lines[largest->index]);
    const auto recovered             = recover(samples);
    row[Column::contact_width]       = contact_width(samples, recovered);
    row[Column::largest_pressure]    = recovered.largest;
    row[Column::largest_pressure_xi] = recovered.place;
    if constexpr (dim == 3)
      row.across[4] = largest->position[2];
  }

  template class ContactFace<2>;
  template class ContactFace<3>;
} // namespace sprag
