// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/statics/contact_law.h"

#include "analysis/statics/quasi_static.h"
#include "base/least_squares.h"
#include "base/ranges.h"
#include "levers/meshed_constants.h"
#include "model/contact/circle.h"
#include "scene/closed_form.h"
#include "scene/contact_estimates.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    constexpr double largest_P_ratio  = 1.2;  ///< of the indentation, over the run's largest P
    constexpr double smallest_P_ratio = 0.05; ///< of fitted points, over the run's largest P
    constexpr double drive_steps      = 40.;
    constexpr double refinement       = 2.; ///< of the faces: hard contact is narrower

    /// Fits log P = log k + n log delta with weights P^2: least squares of the errors of P to first order, which favours the
    /// stiffness at the largest P. Requires two or more points with P, local() > 0.
    ContactLawFit fit_contact_law(const std::vector<Indentation> &points)
    {
      std::vector<double> log_local, log_P, weights;
      for (const auto &point : points)
      {
        log_local.push_back(std::log(point.local()));
        log_P.push_back(std::log(point.P));
        weights.push_back(point.P * point.P);
      }
      Line line  = fitted_line(log_local, log_P, weights);
      line.slope = std::clamp(line.slope, 1., 3.);
      ContactLawFit fit{};
      fit.exponent   = line.slope;
      fit.stiffness  = std::exp(line.at(0.));
      double squares = 0.;
      for (const auto &point : points)
      {
        const double error = fit.stiffness * std::pow(point.local(), fit.exponent) / point.P - 1.;
        fit.largest_error  = std::max(fit.largest_error, std::abs(error));
        squares += error * error;
      }
      fit.rms_error = std::sqrt(squares / static_cast<double>(points.size()));
      return fit;
    }

    /// Returns the scene without friction and with a linear rotational spring that leads to 1.2 times the run's P.
    Scene indentation_scene(const Scene &scene, const ContactReference &reference)
    {
      Scene result             = scene;
      result.friction.law      = CoulombFriction{ 0. };
      result.drive             = Drive(DriveProfile::triangle, 0., scene.drive.maximum(), scene.drive.peak_speed(), 0.5);
      result.spring.type       = SpringType::torsional;
      result.spring.behaviour  = {};
      result.spring.rest_angle = 0.;
      const double P           = closed_form(result, scene.drive.maximum(), 1.).P;
      result.spring.stiffness *= largest_P_ratio * reference.P / P;
      result.mesh.face_size /= refinement;
      return result;
    }

    /// Returns E I = E b d^3/12 of the bar [N mm^2], with E/(1 - nu^2) in plane strain.
    double bar_stiffness(const Scene &scene)
    {
      const Lever &lever  = scene.lever;
      const double nu     = lever.poisson_ratio;
      const double strain = scene.analysis.plane == PlaneState::strain ? 1. - nu * nu : 1.;
      return lever.young_modulus / strain * lever.width * std::pow(lever.depth, 3) / 12.;
    }

    Indentation indentation(const Scene &scene, const double bending_stiffness, const Row &row)
    {
      const auto centre = cylinder_centre(scene.geometry, row[Column::x], row[Column::theta]);
      return { row[Column::P], scene.geometry.cylinder_radius - scene.geometry.interface_offset + centre.eta,
               row[Column::P] * std::pow(centre.xi, 3) / (3. * bending_stiffness), row[Column::penetration] };
    }
  } // namespace

  double FittedContact::penalty_error() const
  {
    return largest(points, [&](const Indentation &point) { return fit.exponent * point.penetration / point.local(); });
  }

  FittedContact indent(const Scene &scene, const std::optional<double> bending_stiffness)
  {
    const double EI      = bending_stiffness.value_or(bar_stiffness(scene));
    const auto reference = contact_reference(scene);
    const Scene pressed  = indentation_scene(scene, reference);
    const auto lever     = make_lever_in_hard_contact(pressed);

    FittedContact result{};
    const double from = std::max(smallest_P_ratio * reference.P, reference.smallest_P);
    const QuasiStaticSettings settings{ scene.drive.maximum() / drive_steps, scene.analysis.minimum_step, scene.contact };
    run_quasi_static(*lever.model, pressed.drive, settings,
                     [&](const State &, const Row &row, const Evaluation &)
                     {
                       if (row[Column::P] >= from)
                         result.points.push_back(indentation(pressed, EI, row));
                     });
    result.fit = fit_contact_law(result.points);
    return result;
  }
} // namespace sprag
