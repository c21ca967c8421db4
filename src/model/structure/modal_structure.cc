// SPDX-License-Identifier: GPL-3.0-only
#include "model/structure/modal_structure.h"

#include "base/ranges.h"
#include "base/unknown.h"
#include "model/interface/block_product.h"
#include "model/structure/modal_vibration.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sprag
{
  using namespace dealii;

  namespace
  {
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

    /// Adds a share of G f to displacements of the selected dofs. Forces may be empty, which move nothing.
    void add_static_displacements(const FullMatrix<double> &compliance, Vector<double> forces, const double share,
                                  const DofSelection &selected, Vector<double> &displacements)
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
  } // namespace

  void add_damping_and_support(const LeverDynamics &constants, ModalData &data)
  {
    const auto n           = static_cast<unsigned int>(data.stiffness.size());
    const auto &shapes     = data.shapes;
    const auto &layer      = data.layer_stiffness;
    const unsigned int hub = data.layout.rotation();
    data.relaxation        = constants.relaxation;
    data.spring_stiffness  = constants.spring_stiffness;
    data.damping.reinit(shapes.n(), shapes.n());
    for (unsigned int i = 0; i < n; ++i)
    {
      // The spring's share of the modes' stiffness is not damped.
      for (unsigned int j = 0; j < n; ++j)
        data.damping(i, j) = (layer.empty() ? 0. : constants.relaxation * layer(i, j)) -
                             constants.stiffness_damping * constants.spring_stiffness * shapes(hub, i) * shapes(hub, j);
      data.damping(i, i) += constants.mass_damping + constants.stiffness_damping * data.stiffness[i] +
                            (i == 0 ? 0. : 2. * constants.modal_damping * std::sqrt(data.stiffness[i]));
    }
    if (!constants.sprung)
      return;
    data.support = n;
    data.stiffness.push_back(constants.support_stiffness / constants.support_mass);
    data.damping(n, n)                    = constants.support_damping / constants.support_mass;
    data.shapes(data.layout.support(), n) = 1. / std::sqrt(constants.support_mass);
  }

  ModalStructure::ModalStructure(ModalData modal_data)
      : data(std::move(modal_data))
  {
    const unsigned int n = n_modes();
    statics.inverse.reinit(n, n);
    for (unsigned int i = 0; i < n; ++i)
      statics.inverse(i, i) = 1. / data.stiffness[i];
    statics.compliance = interface_compliance(statics.inverse, 1.);
    current            = &statics;
  }

  Motion ModalStructure::rest() const
  {
    return at_rest(n_modes(), static_cast<unsigned int>(data.face_compliance.m()));
  }

  InterfaceCompliance ModalStructure::interface_compliance(const FullMatrix<double> &inverse, const double static_share) const
  {
    // Avoids a second matrix of the whole interface, whose memory could not be reused.
    const unsigned int n = data.layout.dofs_per_lever();
    FullMatrix<double> lever_compliance(n), half(n_interface(), n_modes()), shapes(n, n_modes()), own(n, n_modes());
    data.shapes.mmult(half, inverse);
    shapes.fill(data.shapes);
    own.fill(half);
    own.mTmult(lever_compliance, shapes);
    for (unsigned int i = 0; i < data.face_compliance.m(); ++i)
      for (unsigned int j = 0; j < data.face_compliance.n(); ++j)
        lever_compliance(i, j) += static_share * data.face_compliance(i, j);
    InterfaceCompliance result;
    result.append(std::move(lever_compliance));
    if (data.layout.sprung)
    {
      const double *const support_row = &half(data.layout.support(), 0);
      result.append(std::inner_product(support_row, support_row + n_modes(), &data.shapes(data.layout.support(), 0), 0.));
    }
    return result;
  }

  std::unique_ptr<ModalStructure::Step> ModalStructure::make_step(const StepWeights &weights) const
  {
    auto step     = std::make_unique<Step>();
    step->weights = weights;
    FullMatrix<double> effective(n_modes(), n_modes());
    effective.add(weights.damping(), data.damping);
    for (unsigned int i = 0; i < n_modes(); ++i)
      effective(i, i) += weights.mass() + weights.stiffness() * data.stiffness[i];
    step->inverse    = inverse(effective);
    step->compliance = interface_compliance(step->inverse, 1. / static_weight(weights));
    return step;
  }

  void ModalStructure::use_step(const StepWeights &weights)
  {
    constexpr std::size_t kept = 16;
    current                    = step_among(steps, weights, kept, [&] { return make_step(weights); });
  }

  Vector<double> ModalStructure::modal_forces(const InterfaceForces &forces) const
  {
    Vector<double> result(n_modes());
    for (unsigned int a = 0; a < forces.dofs.size(); ++a)
      for (unsigned int i = 0; i < n_modes(); ++i)
        result[i] += data.shapes(forces.dofs[a], i) * forces.values[a];
    return result;
  }

  Motion ModalStructure::deform(const InterfaceForces &forces) const
  {
    Motion motion = rest();
    statics.inverse.vmult(motion.coordinates.position, modal_forces(forces));
    for (unsigned int a = 0; a < forces.dofs.size(); ++a)
      if (forces.dofs[a] < motion.face_force.size())
        motion.face_force[forces.dofs[a]] = forces.values[a];
    return motion;
  }

  void ModalStructure::add_positions(const Vector<double> &coordinates, const DofSelection &selected,
                                     Vector<double> &result) const
  {
    for (const unsigned int dof : selected)
    {
      const double *const shape = &data.shapes(dof, 0);
      for (unsigned int i = 0; i < coordinates.size(); ++i)
        result[dof] += shape[i] * coordinates[i];
    }
  }

  Vector<double> ModalStructure::positions(const Motion &motion, const DofSelection &selected) const
  {
    if (selected.empty())
      return positions(motion, all_dofs(n_interface()));
    Vector<double> result(n_interface());
    add_positions(motion.coordinates.position, selected, result);
    add_static_displacements(data.face_compliance, motion.face_force, 1., selected, result);
    return result;
  }

  DofState ModalStructure::dof_state(const Motion &motion, const unsigned int dof) const
  {
    DofState state{};
    for (unsigned int i = 0; i < n_modes(); ++i)
    {
      state.position += data.shapes(dof, i) * motion.coordinates.position[i];
      state.velocity += data.shapes(dof, i) * motion.coordinates.velocity[i];
    }
    if (dof < motion.face_force.size())
      for (const unsigned int i : filled_places(motion.face_force))
        state.position += data.face_compliance(dof, i) * motion.face_force[i];
    return state;
  }

  Kinematic ModalStructure::kinematics(const Motion &motion) const
  {
    Kinematic result{ positions(motion), Vector<double>(n_interface()), Vector<double>(n_interface()) };
    data.shapes.vmult(result.velocity, motion.coordinates.velocity);
    data.shapes.vmult(result.acceleration, motion.coordinates.acceleration);
    return result;
  }

  Vector<double> ModalStructure::free_displacements(const Motion &accepted, const DofSelection &selected) const
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

    selected_dofs = selected;
    Vector<double> result(n_interface());
    add_positions(free_motion, selected, result);
    add_static_displacements(data.face_compliance, accepted.face_force, kept_share(w), selected, result);
    return result;
  }

  Motion ModalStructure::advance(const Motion &accepted, const InterfaceForces &forces, const DrivePoint &to) const
  {
    const auto &w = current->weights;
    Motion motion;
    motion.drive = to;
    Vector<double> position(n_modes());
    current->inverse.vmult(position, modal_forces(forces));
    position += free_motion;
    motion.coordinates = unaccelerated(accepted.coordinates, w);
    set_position(motion.coordinates, position, w);

    motion.face_force = accepted.face_force; // a share of which is carried on
    if (motion.face_force.size() > 0)
      motion.face_force *= kept_share(w);
    for (unsigned int a = 0; a < forces.dofs.size(); ++a)
      if (forces.dofs[a] < motion.face_force.size())
        motion.face_force[forces.dofs[a]] += forces.values[a] / static_weight(w);
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
    energy.layer   = unknown;
    for (unsigned int i = 0; i < n_modes(); ++i)
      (i == data.support ? energy.support : energy.elastic) += 0.5 * data.stiffness[i] * q.position[i] * q.position[i];
    energy.elastic += 0.5 * quadratic_form(data.face_compliance, motion.face_force);
    const double rotation = dof_state(motion, data.layout.rotation()).position;
    energy.spring         = 0.5 * data.spring_stiffness * rotation * rotation;
    energy.elastic -= energy.spring;
    return energy;
  }

  std::vector<StructureMode> ModalStructure::vibrations(const LinearisedForces &forces, const unsigned int /*number*/,
                                                        const bool shapes) const
  {
    return modal_vibrations(data, forces, shapes);
  }

  void ModalStructure::use_relaxation(const double relaxation)
  {
    if (!data.layer_stiffness.empty())
      data.damping.add(relaxation - data.relaxation, data.layer_stiffness);
    data.relaxation = relaxation;
  }

  namespace
  {
    /// Two levers as one, whose dofs, modes and static shapes follow each other.
    ModalData stacked(const ModalData &first, const ModalData &second)
    {
      ModalData both                = first;
      const std::size_t modes       = first.shapes.n();
      const std::size_t n_interface = first.shapes.m();
      both.stiffness.insert(both.stiffness.end(), second.stiffness.begin(), second.stiffness.end());
      both.shapes.reinit(n_interface + second.shapes.m(), modes + second.shapes.n());
      both.damping.reinit(both.shapes.n(), both.shapes.n());
      both.shapes.fill(first.shapes);
      both.shapes.fill(second.shapes, n_interface, modes);
      both.damping.fill(first.damping);
      both.damping.fill(second.damping, modes, modes);
      if (first.face_compliance.m() > 0)
      {
        both.face_compliance.reinit(n_interface + second.face_compliance.m(), n_interface + second.face_compliance.m());
        both.face_compliance.fill(first.face_compliance);
        both.face_compliance.fill(second.face_compliance, n_interface, n_interface);
      }
      return both;
    }
  } // namespace

  std::vector<StructureMode> ModalStructure::vibrations_with(const ModalStructure &other, const LinearisedForces &forces) const
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
          std::copy_n(force.begin() + n_interface(), other_size, joined.begin() + own_size);
        force = joined;
      }
    return modes;
  }

  double ModalStructure::damping_form(const Motion &velocities) const
  {
    const auto &v = velocities.coordinates.position;
    return product(data.damping, v, v) + data.relaxation * quadratic_form(data.face_compliance, velocities.face_force);
  }

  Vector<double> ModalStructure::local_error(const Motion &begin, const Motion &end) const
  {
    const auto &w        = current->weights;
    Vector<double> error = end.coordinates.acceleration;
    error -= begin.coordinates.acceleration;
    error *= w.dt * w.dt * (w.beta - 1. / 6.);
    Vector<double> result(n_interface());
    add_positions(error, selected_dofs, result);
    return result;
  }
} // namespace sprag
