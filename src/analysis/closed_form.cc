#include "analysis/closed_form.h"

#include "scene/sprung_closed_form.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprag
{
  namespace
  {
    /// v, or where that is 0 the smallest speed in the direction of dx. A rest keeps the direction it was reached in.
    double velocity_of(const DrivePoint &point, const double dx, const double direction)
    {
      return point.v != 0. ? point.v : std::copysign(std::numeric_limits<double>::min(), dx != 0. ? dx : direction);
    }

    Row row_at(const Scene &scene, const DrivePoint &point, const SprungClosedForm::State &at)
    {
      const auto &state = at.lever;
      const double turn = state.contact.theta - kinematics(scene.geometry, 0.).theta;
      Row row;
      row[Column::time]                 = point.time;
      row[Column::x]                    = point.x;
      row[Column::v]                    = point.v;
      row[Column::theta]                = state.contact.theta;
      row[Column::s]                    = state.contact.s;
      row[Column::P]                    = state.P;
      row[Column::F]                    = state.F;
      row[Column::Q]                    = state.Q;
      row[Column::normal_resultant]     = state.P;
      row[Column::friction_resultant]   = state.F;
      row[Column::v_rel]                = state.v_rel;
      row[Column::mu]                   = state.mu;
      row[Column::friction_power]       = state.F * state.v_rel;
      row[Column::P_closed_form]        = state.P;
      row[Column::Q_closed_form]        = state.Q;
      row[Column::theta_closed_form]    = state.contact.theta;
      row[Column::spring_energy]        = moment_law(scene.spring).energy(turn);
      row[Column::support_displacement] = at.displacement;
      row[Column::Q_support]            = state.Q;
      row[Column::support_energy]       = at.support_energy;
      row[Column::drive_work]           = at.work.drive;
      row[Column::friction_work]        = at.work.friction;
      for (const auto column : { Column::centre_offset, Column::contact_width, Column::penetration, Column::indentation,
                                 Column::cone_violation, Column::elastic_slip, Column::elastic_energy })
        row[column] = 0.;
      return row;
    }
  } // namespace

  void run_closed_form(const Scene &scene, const std::function<void(const Row &)> &sink)
  {
    const auto &drive     = scene.drive;
    const auto &reversals = drive.reversals();
    const bool sprung     = scene.support.type == SupportType::sprung;
    SprungClosedForm lever(scene);
    SprungClosedForm::State state;
    const auto advance = [&](const DrivePoint &from, const DrivePoint &to, const double v)
    {
      if (sprung)
        state = lever.advance(to.x, v);
      else
      {
        const auto work = work_between(scene, from.time, to.time);
        state.lever     = closed_form(scene, to.x, v);
        state.work.drive += work.drive;
        state.work.friction += work.friction;
      }
      return state;
    };
    const auto hand_on = [&](const DrivePoint &point, const SprungClosedForm::State &at, const double step)
    {
      Row row           = row_at(scene, point, at);
      row[Column::step] = step;
      sink(row);
    };

    DrivePoint point = drive.at(0., Drive::Side::after);
    double velocity  = velocity_of(point, drive.step(0., scene.analysis.step).x - point.x, 1.);
    if (sprung)
      state = lever.start(point.x, velocity);
    else
      state.lever = closed_form(scene, point.x, velocity);
    hand_on(point, state, 0.);
    while (point.time < drive.duration())
    {
      const auto next = drive.step(point.time, scene.analysis.step);
      velocity        = velocity_of(next, next.x - point.x, velocity);
      hand_on(next, advance(point, next, velocity), next.x - point.x);
      point = next;
      if (std::binary_search(reversals.begin(), reversals.end(), point.time))
      {
        point    = drive.at(point.time, Drive::Side::after);
        velocity = velocity_of(point, -velocity, velocity);
        hand_on(point, advance(point, point, velocity), 0.);
      }
    }
  }
} // namespace sprag
