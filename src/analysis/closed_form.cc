#include "analysis/closed_form.h"

#include "scene/closed_form.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    /// Direction of motion where v = 0: towards `next`.
    double velocity_of(const DrivePoint &point, const DrivePoint &next)
    {
      return point.v != 0. ? point.v : std::copysign(std::numeric_limits<double>::min(), next.x - point.x);
    }

    Row row_at(const Scene &scene, const DrivePoint &point, const double v)
    {
      const auto state  = closed_form(scene, point.x, v);
      const double turn = state.contact.theta - kinematics(scene.geometry, 0.).theta;
      Row row;
      row[Column::time]               = point.time;
      row[Column::x]                  = point.x;
      row[Column::v]                  = point.v;
      row[Column::theta]              = state.contact.theta;
      row[Column::s]                  = state.contact.s;
      row[Column::P]                  = state.P;
      row[Column::F]                  = state.F;
      row[Column::Q]                  = state.Q;
      row[Column::normal_resultant]   = state.P;
      row[Column::friction_resultant] = state.F;
      row[Column::v_rel]              = state.v_rel;
      row[Column::mu]                 = state.mu;
      row[Column::friction_power]     = state.F * state.v_rel;
      row[Column::spring_energy]      = 0.5 * scene.spring_stiffness * turn * turn;
      for (const auto column : { Column::centre_offset, Column::contact_width, Column::penetration, Column::indentation,
                                 Column::cone_violation, Column::elastic_slip, Column::elastic_energy })
        row[column] = 0.;
      return row;
    }

    struct Work
    {
      double drive    = 0.;
      double friction = 0.;
    };

    Work work_between(const Scene &scene, const double begin, const double end)
    {
      const auto integral = [&](const auto &power)
      {
        return boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
            [&](const double time)
            {
              const auto point = scene.drive.at(time);
              return power(closed_form(scene, point.x, point.v), point.v);
            },
            begin, end, 5, 1e-12);
      };
      return { integral([](const ClosedFormState &state, const double v) { return state.Q * v; }),
               integral([](const ClosedFormState &state, double) { return state.F * state.v_rel; }) };
    }
  } // namespace

  void run_closed_form(const Scene &scene, const std::function<void(const Row &)> &sink)
  {
    const auto &drive     = scene.drive;
    const auto &reversals = drive.reversals();
    Work done;
    const auto hand_on = [&](const DrivePoint &point, const double v, const double step)
    {
      Row row                    = row_at(scene, point, v);
      row[Column::drive_work]    = done.drive;
      row[Column::friction_work] = done.friction;
      row[Column::step]          = step;
      sink(row);
    };

    DrivePoint point = drive.at(0., Drive::Side::after);
    hand_on(point, velocity_of(point, drive.step(0., scene.analysis.step)), 0.);
    while (point.time < drive.duration())
    {
      const auto next = drive.step(point.time, scene.analysis.step);
      const auto work = work_between(scene, point.time, next.time);
      done.drive += work.drive;
      done.friction += work.friction;
      const double before = next.v != 0. ? next.v : std::copysign(std::numeric_limits<double>::min(), next.x - point.x);
      hand_on(next, before, next.x - point.x);
      point = next;
      if (std::binary_search(reversals.begin(), reversals.end(), point.time))
      {
        point = drive.at(point.time, Drive::Side::after);
        hand_on(point, velocity_of(point, drive.step(point.time, scene.analysis.step)), 0.);
      }
    }
  }
} // namespace sprag
