#include "fe/circle_surface.h"

#include <algorithm>

namespace sprag
{
  using dealii::Tensor;
  using dealii::Vector;

  CircleSurface::CircleSurface(const ElasticBody<2> &, const FacePatches &face_, const FaceStepProperties &properties_)
      : face(face_)
      , properties(properties_)
  {
  }

  void CircleSurface::enter(const FaceStepPlaces &of_step)
  {
    places        = of_step;
    balance_theta = places.balanced(places.begin.theta, places.end.theta);
    balance_x     = places.balanced(places.begin.x, places.end.x);
  }

  FacePatches::Range CircleSurface::near() const
  {
    const double R     = properties.geometry.cylinder_radius;
    const auto at_last = face.near(places.end, R);
    return places.moves() ? FacePatches::united(at_last, face.near(places.begin, R)) : at_last;
  }

  void CircleSurface::enter(const unsigned int of_face)
  {
    patch    = of_face;
    at_begin = FacePatches::nodal(face.patches()[patch], *places.begin.displacement);
    at_end   = FacePatches::nodal(face.patches()[patch], *places.end.displacement);
    touched  = false;
    std::fill_n(values, n_local, 0.);
    std::fill_n(&tangents[0][0], n_local * n_local, 0.);
  }

  double CircleSurface::place(FacePointState &state) const
  {
    const auto &point = face.points()[state.index];
    const double R    = properties.geometry.cylinder_radius;
    state.position    = FacePatches::position(point, at_end);
    state.gap         = gap(state.position, places.end, R);
    return gap(FacePatches::position(point, at_begin), places.begin, R);
  }

  void CircleSurface::step(FacePointState &state, const double begin_gap, const ContactMemory &memory, const StepContactLaw &law,
                           const double surface_run, FaceStepSums &sums)
  {
    const auto &point   = face.points()[state.index];
    const auto &circle  = properties.geometry;
    const auto &begin   = places.begin;
    const auto &end     = places.end;
    const auto position = FacePatches::position(point, at_begin);
    const auto first    = moving_circle_contact(circle, position, begin.x, begin.theta);
    const auto last     = moving_circle_contact(circle, state.position, end.x, end.theta);
    const double share  = places.balance;
    const Tensor<1, 4> change(
        { state.position.xi - position.xi, state.position.eta - position.eta, end.theta - begin.theta, end.x - begin.x });
    const LeverPoint between = { places.balanced(position.xi, state.position.xi),
                                 places.balanced(position.eta, state.position.eta) };
    const auto balance       = moving_circle_contact(circle, between, balance_x, balance_theta);

    StepKinematics<4> kinematics;
    kinematics.gap_begin       = begin_gap;
    kinematics.gap_end         = state.gap;
    kinematics.gap_row_end     = last.gap_row;
    kinematics.gap_row         = balance.gap_row;
    kinematics.gap_curvature   = share * balance.gap_curvature;
    kinematics.gap_bend        = change * (balance.gap_curvature * change);
    kinematics.slip_change     = last.slip - first.slip + surface_run;
    kinematics.slip_change_row = last.slip_row;
    kinematics.slip_row        = balance.slip_row;
    kinematics.slip_curvature  = share * balance.slip_curvature;
    kinematics.slip_bend       = change * (balance.slip_curvature * change);
    const auto response        = step_response(kinematics, memory, law);

    record(response, kinematics.slip_change, point.weight, surface_run, state, sums);
    state.end_force = response.pressure * last.gap_row - response.traction * last.slip_row;
    sums.force_on_circle += point.weight * response.force[3];
    add(point, response.force, response.tangent);
  }

  void CircleSurface::slide(FacePointState &state, const SlidingState &sliding, const FrictionLaw &law, FaceStepSums &sums)
  {
    const auto &point  = face.points()[state.index];
    const auto &end    = places.end;
    const auto contact = moving_circle_contact(properties.geometry, state.position, end.x, end.theta);
    state.slip_change  = sliding.speed;
    if (sliding.rates != nullptr)
    {
      const auto nodal = FacePatches::nodal(face.patches()[patch], *sliding.rates);
      const auto moved = FacePatches::position(point, nodal);
      const auto &at   = properties.ports;
      state.slip_change += contact.slip_row[0] * (moved.xi - point.position.xi) +
                           contact.slip_row[1] * (moved.eta - point.position.eta) +
                           contact.slip_row[2] * (*sliding.rates)[at.rotation()] -
                           (at.sprung ? contact.slip_row[3] * (*sliding.rates)[at.support()] : 0.);
    }
    const auto of      = sprag::slide(properties, law, sliding, point.weight, state, sums);
    state.end_force    = state.pressure * contact.gap_row - state.traction * contact.slip_row;
    const auto tangent = of.normal * outer_product(contact.gap_row, contact.gap_row) +
                         of.coupled * outer_product(contact.slip_row, contact.gap_row) +
                         of.tangential * outer_product(contact.slip_row, contact.slip_row) +
                         of.gap_curvature * contact.gap_curvature + of.slip_gradient * contact.slip_curvature;
    add(point, state.end_force, tangent);
  }

  void CircleSurface::add(const FacePatches::Point &point, const Tensor<1, 4> &force, const Tensor<2, 4> &tangent)
  {
    touched                           = true;
    const unsigned int n_nodes        = face.patches()[patch].n_nodes;
    constexpr unsigned int rest[2][2] = { { 2, theta_index }, { 3, x_index } };
    for (const auto &[i, row] : rest)
    {
      values[row] += point.weight * force[i];
      for (const auto &[j, column] : rest)
        tangents[row][column] += point.weight * tangent[i][j];
    }
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int d = 0; d < 2; ++d)
      {
        const unsigned int row = 2 * a + d;
        const double weight    = point.weight * point.shapes[a];
        values[row] += weight * force[d];
        for (const auto &[j, column] : rest)
        {
          tangents[row][column] += weight * tangent[d][j];
          tangents[column][row] += weight * tangent[j][d];
        }
        for (unsigned int b = 0; b < n_nodes; ++b)
          for (unsigned int e = 0; e < 2; ++e)
            tangents[row][2 * b + e] += weight * point.shapes[b] * tangent[d][e];
      }
  }

  /// Coordinates of the patch that are ports. The support's moves the circle's position back.
  std::vector<FaceCoordinate> CircleSurface::ports() const
  {
    std::vector<FaceCoordinate> result;
    const auto &of = face.patches()[patch];
    for (unsigned int i = 0; i < 2 * of.n_nodes; ++i)
      result.push_back({ i, 2 * of.nodes[i / 2] + i % 2, 1. });
    result.push_back({ theta_index, properties.ports.rotation(), 1. });
    if (properties.ports.sprung)
      result.push_back({ x_index, properties.ports.support(), -1. });
    return result;
  }

  void CircleSurface::leave(FaceStepSums &sums)
  {
    if (touched)
      sums.loaded.push_back(forces_on_ports(
          ports(), [&](const unsigned int i) { return values[i]; },
          [&](const unsigned int i, const unsigned int j) { return tangents[i][j]; }));
  }

  FacePointRows CircleSurface::rows(const FacePointState &state) const
  {
    const auto &point   = face.points()[state.index];
    const auto contact  = moving_circle_contact(properties.geometry, state.position, places.end.x, places.end.theta);
    const auto of_patch = ports();
    const auto n        = static_cast<unsigned int>(of_patch.size());
    FacePointRows result{ point.weight, {}, Vector<double>(n), Vector<double>(n), Vector<double>(n) };
    for (unsigned int i = 0; i < n; ++i)
    {
      const unsigned int c   = of_patch[i].index;
      const double factor    = of_patch[i].sign * (c < theta_index ? point.shapes[c / 2] : 1.);
      const unsigned int row = c < theta_index ? c % 2 : c - theta_index + 2;
      result.ports.push_back(of_patch[i].port);
      result.gap[i]  = factor * contact.gap_row[row];
      result.slip[i] = factor * contact.slip_row[row];
    }
    return result;
  }

  double CircleSurface::slip(const FacePointState &state) const
  {
    const auto &point  = face.points()[state.index];
    const auto slip_of = [&](const FacePatches::Nodal &nodal, const FaceConfiguration &at)
    { return moving_circle_contact(properties.geometry, FacePatches::position(point, nodal), at.x, at.theta).slip; };
    return slip_of(at_end, places.end) - slip_of(at_begin, places.begin);
  }
} // namespace sprag
