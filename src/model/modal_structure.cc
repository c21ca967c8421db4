// SPDX-License-Identifier: GPL-3.0-only
#include "model/modal_structure.h"

#include "model/block_product.h"
#include "model/modal_vibration.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    FullMatrix<double> inverse_matrix(const FullMatrix<double> &matrix)
    {
      LAPACKFullMatrix<double> lapack(static_cast<unsigned int>(matrix.m()));
      lapack = matrix;
      lapack.invert();
      FullMatrix<double> result(matrix.m(), matrix.n());
      result = lapack;
      return result;
    }

    double product(const FullMatrix<double> &matrix, const Vector<double> &a, const Vector<double> &b)
    {
      return a.size() == 0 ? 0. : matrix.matrix_scalar_product(a, b);
    }

    /// Places of the entries that are not 0.
    std::vector<unsigned int> filled_places(const Vector<double> &sparse)
    {
      std::vector<unsigned int> result;
      for (unsigned int i = 0; i < sparse.size(); ++i)
        if (sparse[i] != 0.)
          result.push_back(i);
      return result;
    }

    /// Adds a share of G f to displacements of the selected ports. Forces may be empty, which move nothing.
    void add_static_displacements(const FullMatrix<double> &compliance, Vector<double> forces, const double share,
                                  const PortSelection &selected, Vector<double> &displacements)
    {
      const auto loaded = filled_places(forces);
      if (loaded.empty())
        return;
      forces *= share;
      const auto rows = find_ranges(selected.begin(), std::lower_bound(selected.begin(), selected.end(), forces.size()));
      for (const auto &columns : find_ranges(loaded.begin(), loaded.end()))
        for (const auto &row : rows)
          add_block_product(compliance, row, columns, forces.begin() + columns.begin, displacements.begin() + row.begin);
    }

    /// f^T G f.
    double quadratic_form(const FullMatrix<double> &compliance, const Vector<double> &forces)
    {
      if (forces.size() == 0)
        return 0.;
      Vector<double> displacements(forces.size());
      add_static_displacements(compliance, forces, 1., filled_places(forces), displacements);
      return displacements * forces;
    }

    /// Forces this small beside the largest are what repeated halving has left of old ones.
    void drop_remnants(Vector<double> &forces)
    {
      if (forces.size() == 0)
        return;
      const double small = 1e-16 * forces.linfty_norm();
      for (auto &force : forces)
        if (std::abs(force) <= small)
          force = 0.;
    }

    /// Face forces of which a share is carried on; reduced levers have none.
    Vector<double> scaled(Vector<double> forces, const double share)
    {
      if (forces.size() > 0)
        forces *= share;
      return forces;
    }

  } // namespace

  ModalStructure::ModalStructure(ModalData modal_data)
      : data(std::move(modal_data))
  {
    const unsigned int n = n_modes();
    statics.inverse.reinit(n, n);
    for (unsigned int i = 0; i < n; ++i)
      statics.inverse(i, i) = 1. / data.stiffness[i];
    statics.compliance = port_compliance(statics.inverse, 1.);
    current            = &statics;
  }

  unsigned int ModalStructure::n_modes() const
  {
    return static_cast<unsigned int>(data.stiffness.size());
  }

  unsigned int ModalStructure::n_ports() const
  {
    return data.ports.size();
  }

  const PortLayout &ModalStructure::ports() const
  {
    return data.ports;
  }

  Motion ModalStructure::rest() const
  {
    Motion motion;
    motion.coordinates.position.reinit(n_modes());
    motion.coordinates.velocity.reinit(n_modes());
    motion.coordinates.acceleration.reinit(n_modes());
    motion.face_force.reinit(static_cast<unsigned int>(data.face_compliance.m()));
    return motion;
  }

  PortCompliance ModalStructure::port_compliance(const FullMatrix<double> &inverse, const double static_share) const
  {
    // Without a matrix of all ports beside it, whose room in memory would not serve again.
    const unsigned int n = data.ports.ports_per_lever();
    FullMatrix<double> lever_compliance(n), half(n_ports(), n_modes()), shapes(n, n_modes()), own(n, n_modes());
    data.shapes.mmult(half, inverse);
    shapes.fill(data.shapes);
    own.fill(half);
    own.mTmult(lever_compliance, shapes);
    for (unsigned int i = 0; i < data.face_compliance.m(); ++i)
      for (unsigned int j = 0; j < data.face_compliance.n(); ++j)
        lever_compliance(i, j) += static_share * data.face_compliance(i, j);
    PortCompliance result;
    result.append(std::move(lever_compliance));
    if (data.ports.sprung)
    {
      const double *const support_row = &half(data.ports.support(), 0);
      result.append(std::inner_product(support_row, support_row + n_modes(), &data.shapes(data.ports.support(), 0), 0.));
    }
    return result;
  }

  /// f = K (u_f + relaxation [u] / dt) of the static shapes: weight of the elastic force at the end of the step.
  double ModalStructure::static_weight(const StepWeights &w) const
  {
    return w.stiffness() + data.relaxation / w.dt;
  }

  double ModalStructure::kept_share(const StepWeights &w) const
  {
    return -(w.alpha_f - data.relaxation / w.dt) / static_weight(w);
  }

  std::unique_ptr<ModalStructure::Step> ModalStructure::make_step(const StepWeights &weights) const
  {
    auto step     = std::make_unique<Step>();
    step->weights = weights;
    FullMatrix<double> effective(n_modes(), n_modes());
    effective.add(weights.damping(), data.damping);
    for (unsigned int i = 0; i < n_modes(); ++i)
      effective(i, i) += weights.mass() + weights.stiffness() * data.stiffness[i];
    step->inverse    = inverse_matrix(effective);
    step->compliance = port_compliance(step->inverse, 1. / static_weight(weights));
    return step;
  }

  void ModalStructure::use_statics()
  {
    current = &statics;
  }

  void ModalStructure::use_step(const StepWeights &weights)
  {
    constexpr std::size_t kept = 16;
    current                    = step_among(steps, weights, kept, [&] { return make_step(weights); });
  }

  const PortCompliance &ModalStructure::compliance() const
  {
    return current->compliance;
  }

  Vector<double> ModalStructure::modal_forces(const PortForces &forces) const
  {
    Vector<double> result(n_modes());
    for (unsigned int a = 0; a < forces.ports.size(); ++a)
      for (unsigned int i = 0; i < n_modes(); ++i)
        result[i] += data.shapes(forces.ports[a], i) * forces.values[a];
    return result;
  }

  Motion ModalStructure::deform(const PortForces &forces) const
  {
    Motion motion = rest();
    statics.inverse.vmult(motion.coordinates.position, modal_forces(forces));
    for (unsigned int a = 0; a < forces.ports.size(); ++a)
      if (forces.ports[a] < motion.face_force.size())
        motion.face_force[forces.ports[a]] = forces.values[a];
    return motion;
  }

  Vector<double> ModalStructure::port_positions(const Motion &motion) const
  {
    return port_positions(motion, all_ports(n_ports()));
  }

  double ModalStructure::port_position(const Motion &motion, const std::vector<unsigned int> &loaded,
                                       const unsigned int port) const
  {
    const auto &q             = motion.coordinates.position;
    const double *const shape = &data.shapes(port, 0);
    double sum                = 0.;
    for (unsigned int i = 0; i < q.size(); ++i)
      sum += shape[i] * q[i];
    if (port < motion.face_force.size())
      for (const unsigned int i : loaded)
        sum += data.face_compliance(port, i) * motion.face_force[i];
    return sum;
  }

  std::vector<unsigned int> ModalStructure::loaded_ports(const Motion &motion, const unsigned int first_selected) const
  {
    return first_selected < motion.face_force.size() ? filled_places(motion.face_force) : std::vector<unsigned int>();
  }

  void ModalStructure::add_positions(const Vector<double> &coordinates, const PortSelection &selected,
                                     Vector<double> &result) const
  {
    for (const unsigned int port : selected)
    {
      const double *const shape = &data.shapes(port, 0);
      for (unsigned int i = 0; i < coordinates.size(); ++i)
        result[port] += shape[i] * coordinates[i];
    }
  }

  Vector<double> ModalStructure::port_positions(const Motion &motion, const PortSelection &selected) const
  {
    Vector<double> result(n_ports());
    add_positions(motion.coordinates.position, selected, result);
    add_static_displacements(data.face_compliance, motion.face_force, 1., selected, result);
    return result;
  }

  PortState ModalStructure::port_state(const Motion &motion, const unsigned int port) const
  {
    PortState state{ port_position(motion, loaded_ports(motion, port), port), 0. };
    for (unsigned int i = 0; i < n_modes(); ++i)
      state.velocity += data.shapes(port, i) * motion.coordinates.velocity[i];
    return state;
  }

  Kinematic ModalStructure::port_kinematics(const Motion &motion) const
  {
    Kinematic result{ port_positions(motion), Vector<double>(n_ports()), Vector<double>(n_ports()) };
    data.shapes.vmult(result.velocity, motion.coordinates.velocity);
    data.shapes.vmult(result.acceleration, motion.coordinates.acceleration);
    return result;
  }

  Vector<double> ModalStructure::free_ports(const Motion &accepted, const PortSelection &selected) const
  {
    const auto &w      = current->weights;
    const auto &start  = accepted.coordinates;
    const auto drifted = unaccelerated(start, w);
    Vector<double> right(n_modes());
    Vector<double> damped(n_modes());
    damped.add(w.damping(), drifted.position, -w.stiffness(), drifted.velocity);
    damped.add(-w.alpha_f, start.velocity);
    data.damping.vmult(right, damped);
    right.add(w.mass(), drifted.position, -w.alpha_m, start.acceleration);
    for (unsigned int i = 0; i < n_modes(); ++i)
      right[i] -= w.alpha_f * data.stiffness[i] * start.position[i];
    free_motion.reinit(n_modes());
    current->inverse.vmult(free_motion, right);

    looked_at = selected;
    Vector<double> result(n_ports());
    add_positions(free_motion, selected, result);
    add_static_displacements(data.face_compliance, accepted.face_force, kept_share(w), selected, result);
    return result;
  }

  Motion ModalStructure::advance(const Motion &accepted, const PortForces &forces, const DrivePoint &to) const
  {
    const auto &w = current->weights;
    Motion motion;
    motion.drive = to;
    Vector<double> position(n_modes());
    current->inverse.vmult(position, modal_forces(forces));
    position += free_motion;
    motion.coordinates = unaccelerated(accepted.coordinates, w);
    set_position(motion.coordinates, position, w);

    motion.face_force = scaled(accepted.face_force, kept_share(w));
    for (unsigned int a = 0; a < forces.ports.size(); ++a)
      if (forces.ports[a] < motion.face_force.size())
        motion.face_force[forces.ports[a]] += forces.values[a] / static_weight(w);
    drop_remnants(motion.face_force);
    return motion;
  }

  void ModalStructure::add_work(const Motion &begin, const Motion &end, StepWork &work) const
  {
    const auto &w            = current->weights;
    const auto &q_0          = begin.coordinates;
    const auto &q_1          = end.coordinates;
    Vector<double> change    = q_1.position;
    Vector<double> mean_rate = q_1.velocity;
    change -= q_0.position;
    mean_rate *= 1. - w.alpha_f;
    mean_rate.add(w.alpha_f, q_0.velocity);
    work.damping += product(data.damping, change, mean_rate);
    work.algorithmic += inertial_dissipation(q_0, q_1, q_0.acceleration, q_1.acceleration, w);
    for (unsigned int i = 0; i < n_modes(); ++i)
      work.algorithmic += w.delay() * data.stiffness[i] * change[i] * change[i];

    Vector<double> force_change = end.face_force;
    if (force_change.size() > 0)
      force_change -= begin.face_force;
    const double static_change = quadratic_form(data.face_compliance, force_change);
    work.damping += data.relaxation / w.dt * static_change;
    work.algorithmic += w.delay() * static_change;
  }

  StoredEnergy ModalStructure::stored_energy(const Motion &motion) const
  {
    const auto &q = motion.coordinates;
    StoredEnergy energy;
    energy.kinetic = 0.5 * q.velocity.norm_sqr();
    energy.layer   = std::numeric_limits<double>::quiet_NaN();
    for (unsigned int i = 0; i < n_modes(); ++i)
      (i == data.support ? energy.support : energy.elastic) += 0.5 * data.stiffness[i] * q.position[i] * q.position[i];
    energy.elastic += 0.5 * quadratic_form(data.face_compliance, motion.face_force);
    const double rotation = port_state(motion, data.ports.rotation()).position;
    energy.spring         = 0.5 * data.spring_stiffness * rotation * rotation;
    energy.elastic -= energy.spring;
    return energy;
  }

  std::vector<StructureMode> ModalStructure::vibrations(const PortPerturbation &forces, const unsigned int /*number*/) const
  {
    return modal_vibrations(data, forces);
  }

  namespace
  {
    /// Two levers as one, whose ports, modes and static shapes follow each other.
    ModalData stacked(const ModalData &first, const ModalData &second)
    {
      ModalData both          = first;
      const std::size_t modes = first.shapes.n();
      const std::size_t ports = first.shapes.m();
      both.stiffness.insert(both.stiffness.end(), second.stiffness.begin(), second.stiffness.end());
      both.shapes.reinit(ports + second.shapes.m(), modes + second.shapes.n());
      both.damping.reinit(both.shapes.n(), both.shapes.n());
      both.shapes.fill(first.shapes);
      both.shapes.fill(second.shapes, ports, modes);
      both.damping.fill(first.damping);
      both.damping.fill(second.damping, modes, modes);
      if (first.face_compliance.m() > 0)
      {
        both.face_compliance.reinit(ports + second.face_compliance.m(), ports + second.face_compliance.m());
        both.face_compliance.fill(first.face_compliance);
        both.face_compliance.fill(second.face_compliance, ports, ports);
      }
      return both;
    }
  } // namespace

  std::vector<StructureMode> ModalStructure::vibrations_with(const ModalStructure &other, const PortPerturbation &forces) const
  {
    auto modes                   = modal_vibrations(stacked(data, other.data), forces);
    const std::size_t own_size   = data.face_compliance.m();
    const std::size_t other_size = other.data.face_compliance.m();
    for (auto &mode : modes)
      for (auto &force : mode.face_force)
      {
        Vector<double> joined(static_cast<unsigned int>(own_size + other_size));
        std::copy_n(force.begin(), own_size, joined.begin());
        if (other_size > 0)
          std::copy_n(force.begin() + n_ports(), other_size, joined.begin() + own_size);
        force = joined;
      }
    return modes;
  }

  double ModalStructure::damping_form(const Motion &velocities) const
  {
    const auto &v = velocities.coordinates.position;
    return product(data.damping, v, v) + data.relaxation * quadratic_form(data.face_compliance, velocities.face_force);
  }

  Vector<double> ModalStructure::port_error(const Motion &begin, const Motion &end) const
  {
    const auto &w        = current->weights;
    Vector<double> error = end.coordinates.acceleration;
    error -= begin.coordinates.acceleration;
    error *= w.dt * w.dt * (w.beta - 1. / 6.);
    Vector<double> result(n_ports());
    for (const unsigned int port : looked_at)
      for (unsigned int i = 0; i < error.size(); ++i)
        result[port] += data.shapes(port, i) * error[i];
    return result;
  }
} // namespace sprag
