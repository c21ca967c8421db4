// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/sparse_structure.h"

#include "base/ranges.h"
#include "fe/dynamics/sparse_vibration.h"

#include <algorithm>
#include <numeric>

namespace sprag
{
  using namespace dealii;

  void SparseStructure::mass_product(const Vector<double> &q, Vector<double> &result) const
  {
    mass.multiply<1>({ { &q } }, { { &result } });
    if (constants.sprung)
      result[n_lever] = constants.support_mass * q[n_lever];
  }

  /// In extended precision: what round-off of the metal's stiffness makes of a vibration is as soft as the whole lever, 1e-9 of
  /// it.
  void SparseStructure::stiffness_product(const Vector<double> &q, Vector<double> &result) const
  {
    std::vector<long double> elastic(n_lever);
    const long double rotation = q[n_lever - 1];
    for (unsigned int i = 0; i < n_lever; ++i)
      elastic[i] = q[i] - rotation * rigid_rotation[i];
    stiffness.multiply(elastic, result);
    result[n_lever - 1] += constants.spring_stiffness * q[n_lever - 1];
    if (constants.sprung)
      result[n_lever] = constants.support_stiffness * q[n_lever];
  }

  void SparseStructure::damping_product(const Vector<double> &q, Vector<double> &result) const
  {
    result = 0.;
    Vector<double> part(q.size());
    const auto add = [&](const CompressedRows &matrix, const double factor)
    {
      if (factor == 0.)
        return;
      matrix.multiply<1>({ { &q } }, { { &part } });
      result.add(factor, part);
    };
    add(mass, constants.mass_damping);
    add(stiffness, constants.stiffness_damping);
    add(layer, constants.relaxation);
    for (unsigned int i = 0; i < damping.directions.size(); ++i)
    {
      const auto &direction = damping.directions[i];
      double amount         = 0.;
      for (unsigned int j = 0; j < n_lever; ++j)
        amount += direction[j] * q[j];
      for (unsigned int j = 0; j < n_lever; ++j)
        result[j] += damping.factors[i] * amount * direction[j];
    }
    if (constants.sprung)
      result[n_lever] = constants.support_damping * q[n_lever];
  }

  double SparseStructure::damping_form(const Motion &velocities) const
  {
    const auto &v = velocities.coordinates.position;
    Vector<double> product(v.size());
    damping_product(v, product);
    return product * v;
  }

  void SparseStructure::solve_statics(const Vector<double> &load, Vector<double> &q) const
  {
    const auto lever_solution = statics->system->solve(Vector<double>(load.begin(), load.begin() + n_lever));
    std::copy(lever_solution.begin(), lever_solution.end(), q.begin());
    if (constants.sprung)
      q[n_lever] = load[n_lever] / constants.support_stiffness;
  }

  std::vector<StructureMode> SparseStructure::vibrations(const LinearisedForces &forces, const unsigned int number,
                                                         const bool /*shapes*/)
  {
    use_statics();
    return sparse_vibrations(*this, forces, number);
  }

  namespace
  {
    double product(const Vector<double> &a, const Vector<double> &b)
    {
      return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
    }
  } // namespace

  SparseStructure::Products SparseStructure::make_products(const Motion &motion) const
  {
    const auto &q = motion.coordinates;
    Products motion_products;
    motion_products.position = q.position;
    motion_products.velocity = q.velocity;
    for (unsigned int k = 0; k < 3; ++k)
    {
      motion_products.mass[k].reinit(n_lever, true);
      motion_products.modal[k].reinit(static_cast<unsigned int>(mode_momenta.size()));
    }
    // A rigid rotation meets no stiffness, but round-off as large as its displacements.
    motion_products.elastic = Vector<double>(q.position.begin(), q.position.begin() + n_lever);
    motion_products.elastic.add(-q.position[n_lever - 1], rigid_rotation);
    const std::array<const Vector<double> *, 3> motions = { { &q.position, &q.velocity, &q.acceleration } };
    mass.multiply<3>(motions, { { &motion_products.mass[0], &motion_products.mass[1], &motion_products.mass[2] } });
    const std::array<const Vector<double> *, 3> strains = { { &motion_products.elastic, &q.velocity, &q.acceleration } };
    const auto multiply = [&](const CompressedRows &matrix, const bool rates, std::array<Vector<double>, 3> &results)
    {
      for (unsigned int k = 0; k < (rates ? 3u : 1u); ++k)
        results[k].reinit(n_lever, true);
      if (rates)
        matrix.multiply<3>(strains, { { &results[0], &results[1], &results[2] } });
      else
        matrix.multiply<1>({ { strains[0] } }, { { &results[0] } });
    };
    multiply(stiffness, constants.stiffness_damping > 0., motion_products.stiffness);
    multiply(layer, constants.relaxation > 0., motion_products.layer);
    for (unsigned int i = 0; i < mode_momenta.size(); ++i)
      for (unsigned int k = 0; k < 3; ++k)
        motion_products.modal[k][i] = product(mode_momenta[i], *motions[k]);
    return motion_products;
  }

  const SparseStructure::Products &SparseStructure::products(const Motion &motion) const
  {
    const auto &q       = motion.coordinates;
    const auto is_equal = [](const Vector<double> &a, const Vector<double> &b)
    { return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin()); };
    for (const unsigned int slot : { latest, 1 - latest })
      if (is_equal(q.position, known[slot].position) && is_equal(q.velocity, known[slot].velocity))
      {
        latest = slot;
        return known[slot];
      }
    latest        = 1 - latest;
    known[latest] = make_products(motion);
    return known[latest];
  }

  void SparseStructure::add_work(const Motion &begin, const Motion &end, StepWork &work) const
  {
    const auto &w                  = current->weights;
    const auto &q_0                = begin.coordinates;
    const auto &q_1                = end.coordinates;
    const Products &begin_products = products(begin);
    const Products &end_products   = products(end);

    Vector<double> change = q_1.position;
    change -= q_0.position;
    // Damping acts on (1 - alpha_f) v_1 + alpha_f v_0.
    const auto power = [&](const Vector<double> &at_end, const Vector<double> &at_begin)
    { return w.stiffness() * product(at_end, change) + w.alpha_f * product(at_begin, change); };
    if (constants.mass_damping > 0.)
      work.damping += constants.mass_damping * power(end_products.mass[1], begin_products.mass[1]);
    if (constants.stiffness_damping > 0.)
      work.damping += constants.stiffness_damping * power(end_products.stiffness[1], begin_products.stiffness[1]);
    if (constants.relaxation > 0.)
      work.damping += constants.relaxation * power(end_products.layer[1], begin_products.layer[1]);
    for (unsigned int i = 0; i < damping.factors.size(); ++i)
    {
      const double mean_rate = w.stiffness() * end_products.modal[1][i + 1] + w.alpha_f * begin_products.modal[1][i + 1];
      work.damping += damping.factors[i] * mean_rate * (end_products.modal[0][i + 1] - begin_products.modal[0][i + 1]);
    }
    const double turn     = change[n_lever - 1];
    Vector<double> strain = end_products.elastic;
    strain -= begin_products.elastic;
    work.algorithmic += inertial_dissipation(q_0, q_1, begin_products.mass[2], end_products.mass[2], w) +
                        w.delay() * (product(end_products.stiffness[0], strain) - product(begin_products.stiffness[0], strain) +
                                     constants.spring_stiffness * turn * turn);
    if (!constants.sprung)
      return;
    const auto support_motion = [this](const Kinematic &q)
    {
      const auto entry = [&](const Vector<double> &values) { return Vector<double>(values.begin() + n_lever, values.end()); };
      return Kinematic{ entry(q.position), entry(q.velocity), entry(q.acceleration) };
    };
    const auto u_0 = support_motion(q_0), u_1 = support_motion(q_1);
    const double moved = u_1.position[0] - u_0.position[0];
    work.damping += constants.support_damping * moved * (w.stiffness() * u_1.velocity[0] + w.alpha_f * u_0.velocity[0]);
    work.algorithmic += constants.support_mass * inertial_dissipation(u_0, u_1, u_0.acceleration, u_1.acceleration, w) +
                        w.delay() * constants.support_stiffness * moved * moved;
  }

  StoredEnergy SparseStructure::stored_energy(const Motion &motion) const
  {
    const auto &q               = motion.coordinates;
    const auto &motion_products = products(motion);
    StoredEnergy energy;
    energy.kinetic = 0.5 * product(motion_products.mass[1], q.velocity);
    energy.spring  = 0.5 * constants.spring_stiffness * q.position[n_lever - 1] * q.position[n_lever - 1];
    energy.elastic = 0.5 * product(motion_products.stiffness[0], motion_products.elastic);
    energy.layer   = 0.5 * product(motion_products.layer[0], motion_products.elastic);
    if (constants.sprung)
    {
      energy.kinetic += 0.5 * constants.support_mass * q.velocity[n_lever] * q.velocity[n_lever];
      energy.support = 0.5 * constants.support_stiffness * q.position[n_lever] * q.position[n_lever];
    }
    return energy;
  }

  Vector<double> SparseStructure::local_error(const Motion &begin, const Motion &end) const
  {
    const auto &w                  = current->weights;
    const double factor            = w.dt * w.dt * (w.beta - 1. / 6.);
    const Products &begin_products = products(begin);
    const Products &end_products   = products(end);
    Vector<double> result(layout().size());
    for (unsigned int i = 0; i < mode_displacements.size(); ++i)
      result.add(factor * (end_products.modal[2][i] - begin_products.modal[2][i]), mode_displacements[i]);
    if (constants.sprung)
      result[layout().support()] = factor * (end.coordinates.acceleration[n_lever] - begin.coordinates.acceleration[n_lever]);
    return result;
  }

  namespace
  {
    /// Modes in which the local error of a step is estimated.
    constexpr unsigned int n_error_modes = 8;

    /// Step sizes whose factors are kept.
    constexpr std::size_t n_steps = 4;

    /// Factors of position, velocity and acceleration at the beginning of a step.
    using Share = std::array<double, 3>;

    /// Position, and what damping acts on, of a step without force: C times the latter is what the effective matrix leaves out.
    Share drifted_position(const StepWeights &w)
    {
      return { { 1., w.dt, w.dt * w.dt * (0.5 - w.beta) } };
    }

    Share drifted_rate(const StepWeights &w)
    {
      const auto position = drifted_position(w);
      return { { w.damping() * position[0], w.damping() * position[1] - 1.,
                 w.damping() * position[2] - w.stiffness() * w.dt * (1. - w.gamma) } };
    }

    /// Rate that damping acts on at the drifted position.
    Share mean_drifted_rate(const StepWeights &w)
    {
      return { { 0., 1., w.stiffness() * w.dt * (1. - w.gamma) } };
    }

    void add(const Share &share, const double factor, const std::array<Vector<double>, 3> &parts, Vector<double> &sum)
    {
      for (unsigned int k = 0; k < 3; ++k)
        if (share[k] * factor != 0.)
          for (unsigned int i = 0; i < parts[k].size(); ++i)
            sum[i] += share[k] * factor * parts[k][i];
    }
  } // namespace

  SparseStructure::SparseStructure(const ElasticBody<2> &body, std::shared_ptr<const InertialMatrices> matrices_,
                                   const LeverModes &modes, const LeverDynamics &constants_)
      : matrices(std::move(matrices_))
      , constants(constants_)
      , lever_interface(body, *matrices, constants.sprung)
      , n_lever(matrices->coordinates.size())
      , rigid_rotation(matrices->coordinates.rigid_rotation())
      , mass(matrices->mass)
      , stiffness(matrices->stiffness)
      , layer(matrices->layer_stiffness)
  {
    for (unsigned int i = 0; i < modes.stiffness.size(); ++i)
    {
      Vector<double> momentum(n_lever);
      auto shape = matrices->coordinates.total(modes.displacements[i], modes.leaf[i], modes.rotation[i]);
      shape.grow_or_shrink(lever_interface.n_coordinates());
      mass.multiply<1>({ { &shape } }, { { &momentum } });
      if (i > 0 && constants.modal_damping > 0.)
      {
        damping.directions.push_back(momentum);
        damping.factors.push_back(2. * constants.modal_damping * std::sqrt(modes.stiffness[i]));
      }
      mode_momenta.push_back(momentum);
      if (i < n_error_modes)
        mode_displacements.push_back(lever_interface.displacements(shape));
    }
  }

  Motion SparseStructure::rest() const
  {
    return at_rest(n_coordinates());
  }

  void SparseStructure::use_statics()
  {
    if (!statics)
    {
      statics         = std::make_unique<Step>();
      statics->system = std::make_unique<EffectiveSystem>(
          *matrices, lever_interface, damping, InertialMatrices::Weights{ 0., 1., 0., constants.spring_stiffness }, 0.);
      statics->compliance = interface_compliance(*statics->system, constants.support_stiffness);
    }
    current = statics.get();
  }

  std::unique_ptr<SparseStructure::Step> SparseStructure::make_step(const StepWeights &w) const
  {
    auto step     = std::make_unique<Step>();
    step->weights = w;
    const InertialMatrices::Weights matrix_weights{ w.mass() + w.damping() * constants.mass_damping,
                                                    w.stiffness() + w.damping() * constants.stiffness_damping,
                                                    w.damping() * constants.relaxation,
                                                    w.stiffness() * constants.spring_stiffness };
    step->system     = std::make_unique<EffectiveSystem>(*matrices, lever_interface, damping, matrix_weights, w.damping());
    step->compliance = interface_compliance(*step->system, effective_support(w));
    return step;
  }

  void SparseStructure::use_step(const StepWeights &weights)
  {
    current = step_among(steps, weights, n_steps, [&] { return make_step(weights); });
  }

  void SparseStructure::serialise_history(Archive &archive)
  {
    auto weights = mapped(steps, [](const auto &step) { return step->weights; });
    archive(weights);
    if (!archive.reads())
      return;
    steps.clear();
    current = nullptr;
    for (const auto &step_weights : weights)
      steps.push_back(make_step(step_weights));
  }

  InterfaceCompliance SparseStructure::interface_compliance(const EffectiveSystem &system, const double support_stiffness) const
  {
    InterfaceCompliance result;
    result.append(system.interface_compliance());
    if (constants.sprung)
      result.append(1. / support_stiffness);
    return result;
  }

  double SparseStructure::effective_support(const StepWeights &w) const
  {
    return w.mass() * constants.support_mass + w.damping() * constants.support_damping +
           w.stiffness() * constants.support_stiffness;
  }

  double SparseStructure::free_support(const Kinematic &start, const StepWeights &w) const
  {
    const auto position = drifted_position(w);
    const auto rate     = drifted_rate(w);
    const double q[]    = { start.position[n_lever], start.velocity[n_lever], start.acceleration[n_lever] };
    double load         = -w.alpha_m * constants.support_mass * q[2] - w.alpha_f * constants.support_stiffness * q[0];
    for (unsigned int k = 0; k < 3; ++k)
      load += (w.mass() * constants.support_mass * position[k] + constants.support_damping * rate[k]) * q[k];
    return load / effective_support(w);
  }

  Motion SparseStructure::deform(const InterfaceForces &forces) const
  {
    Vector<double> load(lever_interface.n_coordinates());
    for (unsigned int a = 0; a < forces.dofs.size(); ++a)
      lever_interface.add_force(forces.dofs[a], forces.values[a], load);
    // The rotational spring is soft beside the lever: what the first solution leaves out of balance is solved for again.
    constexpr unsigned int corrections = 2;
    Motion motion                      = rest();
    auto &q                            = motion.coordinates.position;
    Vector<double> left                = load;
    Vector<double> product(load.size());
    for (unsigned int i = 0; i <= corrections; ++i)
    {
      const auto lever_solution = statics->system->solve(Vector<double>(left.begin(), left.begin() + n_lever));
      for (unsigned int j = 0; j < n_lever; ++j)
        q[j] += lever_solution[j];
      stiffness_product(q, product);
      left = load;
      left -= product;
    }
    if (constants.sprung)
      q[n_lever] = load[n_lever] / constants.support_stiffness;
    return motion;
  }

  DofState SparseStructure::dof_state(const Motion &motion, const unsigned int dof) const
  {
    const auto &q = motion.coordinates;
    return { lever_interface.displacements(q.position)[dof], lever_interface.displacements(q.velocity)[dof] };
  }

  Kinematic SparseStructure::kinematics(const Motion &motion) const
  {
    const auto &q = motion.coordinates;
    return { lever_interface.displacements(q.position), lever_interface.displacements(q.velocity),
             lever_interface.displacements(q.acceleration) };
  }

  /// Residual of the motion at the drifted position without force: the effective matrix times the way from there to the free
  /// one. That way is short, so that round-off does not grow with the lever's rotation.
  Vector<double> SparseStructure::motion_load(const Kinematic &start, const Products &motion_products, const StepWeights &w) const
  {
    const Share rate = mean_drifted_rate(w);
    Share mass_share;
    for (unsigned int k = 0; k < 3; ++k)
      mass_share[k] = -constants.mass_damping * rate[k];
    mass_share[2] -= w.alpha_m;

    Vector<double> load(n_lever);
    add(mass_share, 1., motion_products.mass, load);
    add(rate, -constants.stiffness_damping, motion_products.stiffness, load);
    add(rate, -constants.relaxation, motion_products.layer, load);
    for (unsigned int i = 0; i < damping.directions.size(); ++i)
    {
      double amount = 0.;
      for (unsigned int k = 0; k < 3; ++k)
        amount -= rate[k] * motion_products.modal[k][i + 1];
      load.add(damping.factors[i] * amount, damping.directions[i]);
    }

    // Forces of lever, layer and rotational spring at the weighted mean of begin and drifted position.
    const Share drifted = drifted_position(w);
    Vector<double> mean(n_lever), force(n_lever);
    for (unsigned int i = 0; i < n_lever; ++i)
      mean[i] = start.position[i] + w.stiffness() * (drifted[1] * start.velocity[i] + drifted[2] * start.acceleration[i]);
    const double rotation = mean[n_lever - 1];
    mean.add(-rotation, rigid_rotation);
    stiffness.multiply<1>({ { &mean } }, { { &force } });
    load -= force;
    load[n_lever - 1] -= constants.spring_stiffness * rotation;
    return load;
  }

  Vector<double> SparseStructure::free_displacements(const Motion &accepted, const DofSelection &) const
  {
    const auto &w             = current->weights;
    const auto &start         = accepted.coordinates;
    const auto lever_solution = current->system->solve(motion_load(start, products(accepted), w));
    const auto drifted        = unaccelerated(start, w);
    free_motion               = drifted.position;
    for (unsigned int i = 0; i < n_lever; ++i)
      free_motion[i] += lever_solution[i];
    if (constants.sprung)
      free_motion[n_lever] = free_support(start, w);
    return lever_interface.displacements(free_motion);
  }

  Motion SparseStructure::advance(const Motion &accepted, const InterfaceForces &forces, const DrivePoint &to) const
  {
    const auto &w = current->weights;
    Motion motion;
    motion.drive            = to;
    Vector<double> position = free_motion;
    const auto moved        = current->system->response(forces);
    for (unsigned int i = 0; i < n_lever; ++i)
      position[i] += moved[i];
    if (constants.sprung && !forces.dofs.empty() && forces.dofs.back() == layout().support())
      position[n_lever] += 1. / effective_support(w) * forces.values[forces.values.size() - 1];
    motion.coordinates = unaccelerated(accepted.coordinates, w);
    set_position(motion.coordinates, position, w);
    return motion;
  }
} // namespace sprag
