// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/closed_form.h"

#include "analytic/step_clock.h"
#include "base/errors.h"
#include "base/text.h"
#include "base/unknown.h"
#include "laws/friction_law.h"
#include "results/page_tables.h"
#include "scene/mirrored_pair.h"
#include "scene/pair_closed_form.h"
#include "scene/scene.h"
#include "scene/sprung_closed_form.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    Row row_at(const DrivePoint &point, const ClosedFormState &state, const double spring_energy, const Work &work)
    {
      Row row                        = ideal_contact_row(point, state, spring_energy);
      row[Column::P_closed_form]     = state.P;
      row[Column::Q_closed_form]     = state.Q;
      row[Column::theta_closed_form] = state.contact.theta;
      row[Column::drive_work]        = work.drive;
      row[Column::friction_work]     = work.friction;
      return row;
    }

    Row row_at(const DrivePoint &point, const PairedLever &lever, const Work &work)
    {
      Row row = row_at(point, lever.state, lever.spring_energy, work);
      if (!lever.touches)
        for (const auto column : { Column::s, Column::v_rel, Column::mu })
          row[column] = unknown;
      return row;
    }

    double spring_energy(const Scene &scene, const ClosedFormState &state)
    {
      return moment_law(scene.spring).energy(state.contact.theta - kinematics(scene.geometry, 0.).theta);
    }

    void add(const Work &more, Work &work)
    {
      work.drive += more.drive;
      work.friction += more.friction;
    }

    /// Integrates the works from one point of the drive to another and returns the row there.
    using Advance = std::function<Row(const DrivePoint &from, const DrivePoint &to)>;

    Advance on_rigid_support(const Scene &scene)
    {
      return [&scene, work = Work()](const DrivePoint &from, const DrivePoint &to) mutable
      {
        add(work_between(scene, from.time, to.time), work);
        const auto state = closed_form(scene, to.x, to.v);
        return row_at(to, state, spring_energy(scene, state), work);
      };
    }

    Advance on_sprung_support(const Scene &scene)
    {
      return [&scene, lever = SprungClosedForm(scene), begins = true](const DrivePoint &, const DrivePoint &to) mutable
      {
        const auto at                     = begins ? lever.start(to.x, to.v) : lever.advance(to.x, to.v);
        begins                            = false;
        Row row                           = row_at(to, at.lever, spring_energy(scene, at.lever), at.work);
        row[Column::support_displacement] = at.displacement;
        row[Column::support_energy]       = at.support_energy;
        return row;
      };
    }

    Advance pair_advance(const Scene &scene)
    {
      return [&scene, works = std::array<Work, 2>()](const DrivePoint &from, const DrivePoint &to) mutable
      {
        const auto more   = pair_work_between(scene, from.time, to.time);
        const auto levers = pair_closed_form(scene, to.x, to.v);
        for (unsigned int lever = 0; lever < 2; ++lever)
          add(more[lever], works[lever]);
        Row row = row_at(to, levers[0], works[0]);
        row.add_second_lever(row_at(to, levers[1], works[1]));
        return row;
      };
    }

    /// Computes rows of a rigid lever with inertia that always touches the cylinder.
    struct IdealContact
    {
      const Scene &scene;
      const double inertia; ///< J [t mm^2]
      const double rest      = kinematics(scene.geometry, 0.).theta;
      const MomentLaw spring = moment_law(scene.spring);

      /// Returns the row at a point of the drive, with subscripts for derivatives by x and theta_x = sin theta / s:
      ///   s_x = -cos theta - (R - e) theta_x,  theta_xx = (cos theta theta_x s - sin theta s_x) / s^2,
      ///   theta' = theta_x v,  theta'' = theta_x a + theta_xx v^2.
      Row row(const DrivePoint &point) const
      {
        const auto &g          = scene.geometry;
        ClosedFormState state  = closed_form(scene, point.x, point.v);
        const auto &contact    = state.contact;
        const double signed_mu = drive_direction(point.v) * state.mu;
        const double s_x       = -std::cos(contact.theta) - (g.cylinder_radius - g.interface_offset) * contact.theta_x;
        const double theta_xx =
            (std::cos(contact.theta) * contact.theta_x * contact.s - std::sin(contact.theta) * s_x) / (contact.s * contact.s);
        const double rate           = contact.theta_x * point.v;
        const double acceleration   = contact.theta_x * point.a + theta_xx * point.v * point.v;
        const double moment         = inertia * acceleration + spring.moment(contact.theta - rest);
        const double quasi_static_P = state.P, quasi_static_Q = state.Q;
        state.P = moment / (contact.s + signed_mu * g.interface_offset);
        state.F = signed_mu * state.P;
        state.Q = state.P * std::sin(contact.theta) + state.F * std::cos(contact.theta);

        Row result                     = ideal_contact_row(point, state, spring.energy(contact.theta - rest));
        result[Column::theta_rate]     = rate;
        result[Column::kinetic_energy] = 0.5 * inertia * rate * rate;
        result[Column::P_quasi_static] = quasi_static_P;
        result[Column::Q_quasi_static] = quasi_static_Q;
        for (const auto column : { Column::contact_energy, Column::damping_work, Column::algorithmic_work, Column::creep })
          result[column] = 0.;
        return result;
      }
    };

    StoredEnergy stored(const Row &row)
    {
      StoredEnergy energy;
      energy.kinetic = row[Column::kinetic_energy];
      energy.spring  = row[Column::spring_energy];
      return energy;
    }

    /// Returns the works of drive and friction over a time interval, by Gauss' rule with three points.
    StepWork work_between(const IdealContact &lever, const Drive &drive, const double begin, const double end)
    {
      const double points[]  = { 0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15) };
      const double weights[] = { 5. / 18., 8. / 18., 5. / 18. };
      StepWork work;
      for (unsigned int i = 0; i < 3; ++i)
      {
        const Row row = lever.row(drive.at(begin + points[i] * (end - begin)));
        work.drive += weights[i] * (end - begin) * row[Column::Q] * row[Column::v];
        work.friction += weights[i] * (end - begin) * row[Column::friction_power];
      }
      return work;
    }

    void require_contact(const Row &row)
    {
      if (row[Column::P] >= 0.)
        return;
      throw AnalysisError("the contact would have to pull: P = " + rounded_text(row[Column::P]) +
                          " N at t = " + rounded_text(row[Column::time]) + " s, x = " + mm(row[Column::x]) +
                          ". An ideal contact cannot open: use Contact/Type = compliant or a longer Drive/Reversal duration.");
    }

    Sweep over_coefficient(const Scene &scene)
    {
      Sweep sweep;
      sweep.columns  = page_columns("slope", "mu slope_forward slope_backward dimensionless_forward dimensionless_backward");
      const auto &at = scene.geometry;
      for (unsigned int i = 0; i < scene.slope.n_points; ++i)
      {
        const double mu = scene.slope.maximum_coefficient * i / (scene.slope.n_points - 1.);
        sweep.rows.push_back({ mu, representative_slope(at, scene.spring.stiffness, mu, 1),
                               representative_slope(at, scene.spring.stiffness, mu, -1), dimensionless_slope(at, mu, 1),
                               dimensionless_slope(at, mu, -1) });
      }
      return sweep;
    }

    Sweep over_inclination(const Scene &scene)
    {
      Sweep sweep;
      sweep.columns   = page_columns("slope", "theta0 offset_ratio dimensionless_forward dimensionless_backward");
      const double mu = friction_coefficient(scene.friction, scene.drive.peak_speed()).coefficient;
      for (const double ratio : scene.slope.offset_ratios)
      {
        const double end = std::min(scene.slope.maximum_inclination, std::asin(1. - ratio));
        for (unsigned int i = 1; i <= scene.slope.n_points; ++i)
        {
          const double inclination = end * i / scene.slope.n_points;
          const Geometry geometry{ 1., ratio, (1. - ratio) / std::sin(inclination), 0. };
          sweep.rows.push_back(
              { inclination, ratio, dimensionless_slope(geometry, mu, 1), dimensionless_slope(geometry, mu, -1) });
        }
      }
      return sweep;
    }
  } // namespace

  Row ideal_contact_row(const DrivePoint &point, const ClosedFormState &state, const double spring_energy)
  {
    Row row(point);
    row[Column::theta]              = state.contact.theta;
    row[Column::s]                  = state.contact.s;
    row[Column::P]                  = state.P;
    row[Column::F]                  = state.F;
    row[Column::Q]                  = state.Q;
    row[Column::Q_support]          = state.Q;
    row[Column::normal_resultant]   = state.P;
    row[Column::friction_resultant] = state.F;
    row[Column::v_rel]              = state.v_rel;
    row[Column::mu]                 = state.mu;
    row[Column::friction_power]     = state.F * state.v_rel;
    row[Column::spring_energy]      = spring_energy;
    for (const auto column :
         { Column::centre_offset, Column::contact_width, Column::penetration, Column::indentation, Column::cone_violation,
           Column::elastic_slip, Column::elastic_energy, Column::support_displacement, Column::support_energy })
      row[column] = 0.;
    return row;
  }

  void run_closed_form(const Scene &scene, const std::function<void(const Row &)> &sink)
  {
    const auto &drive  = scene.drive;
    const bool sprung  = scene.support.type == SupportType::sprung;
    const auto advance = count_levers(scene) == 2 ? pair_advance(scene)
                         : sprung                 ? on_sprung_support(scene)
                                                  : on_rigid_support(scene);
    const auto hand_on = [&](const DrivePoint &from, const DrivePoint &to)
    {
      Row row           = advance(from, to);
      row[Column::step] = to.x - from.x;
      sink(row);
    };

    DrivePoint point = drive.at(0., Drive::Side::after);
    hand_on(point, point);
    while (point.time < drive.duration())
    {
      const auto next = drive.step(point.time, scene.analysis.step, largest_speed_change);
      hand_on(point, next);
      point = next;
      if (drive.turns_at(point.time))
      {
        point = drive.at(point.time, Drive::Side::after);
        hand_on(point, point);
      }
    }
  }

  TransientReport run_ideal_contact(const Scene &scene, const double inertia, const std::function<void(const Row &)> &sink)
  {
    const auto &drive = scene.drive;
    const IdealContact lever{ scene, inertia };
    StepClock clock(drive, scene.time.step, 0);

    double time = 0.;
    Row row     = lever.row(drive.at(0., Drive::Side::after));
    EnergyLedger ledger(stored(row));
    TransientReport report;
    const auto hand_on = [&](const double step)
    {
      ledger.fill(row);
      row[Column::time_step] = step;
      require_contact(row);
      sink(row);
    };
    hand_on(0.);
    for (; !clock.finished(); clock.advance())
    {
      const double end = clock.step_end();
      const auto work  = work_between(lever, drive, time, end);
      row              = lever.row(drive.at(end));
      ledger.add(end, stored(row), work);
      ++report.steps;
      hand_on(end - time);
      time = end;
      if (drive.turns_at(end))
      {
        row = lever.row(drive.at(end, Drive::Side::after));
        hand_on(0.);
      }
    }
    report.ledger = ledger.report();
    return report;
  }

  Sweep slope_sweep(const Scene &scene)
  {
    return scene.slope.sweep == SlopeSweep::coefficient ? over_coefficient(scene) : over_inclination(scene);
  }
} // namespace sprag
