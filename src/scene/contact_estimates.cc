// SPDX-License-Identifier: GPL-3.0-only
#include "scene/contact_estimates.h"

#include "base/ranges.h"
#include "scene/closed_form.h"
#include "scene/device.h"
#include "scene/lever_inertia.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace sprag
{
  namespace
  {
    /// The layer under the contact, or the bare lever.
    struct FaceMaterial
    {
      double E, nu, h; ///< [MPa, -, mm]
    };

    FaceMaterial face_material(const Device &device)
    {
      if (device.layer.thickness > 0.)
        return { device.layer.young_modulus, device.layer.poisson_ratio, device.layer.thickness };
      return { device.lever.young_modulus, device.lever.poisson_ratio, device.lever.depth };
    }

    /// Returns what the contact compresses: the layer or of a bare lever the lever, and an elastic cylinder.
    std::vector<FaceMaterial> compressed_bodies(const Device &device)
    {
      std::vector<FaceMaterial> result = { face_material(device) };
      if (const auto &cylinder = device.cylinder; cylinder.type == CylinderType::solid)
        result.push_back(
            { cylinder.young_modulus, cylinder.poisson_ratio, device.geometry.cylinder_radius - cylinder.inner_radius });
      return result;
    }

    // Shares of Mesh/Face size: of the shortest faces, as the width of a contact begins at none, and of the longest.
    constexpr double shortest_share = 0.25;
    constexpr double least_longest  = 0.5;

    constexpr double faces_beyond = 4.;  ///< shortest faces beyond the last place of the contact's centre
    constexpr unsigned int places = 256; ///< of the drive that are looked at

    double needed_length(const Device &device, const double x)
    {
      const double v = device.drive.peak_speed();
      const double P = std::min(closed_form(device, x, v).P, closed_form(device, x, -v).P);
      return estimated_contact_width(device, std::max(0., P)) / device.mesh.faces_in_contact;
    }

    /// P of the closed form over the drive, both ways at peak speed, with s at the largest. It is infinite where the lever locks.
    void set_forces(const Device &device, ContactReference &result)
    {
      constexpr unsigned int samples = 64;
      const double from              = device.drive.minimum();
      const double to                = device.drive.maximum();
      result.smallest_P              = std::numeric_limits<double>::infinity();
      for (unsigned int i = 0; i <= samples; ++i)
        for (const double direction : { 1., -1. })
        {
          const auto state = closed_form(device, from + (to - from) * i / samples, direction * device.drive.peak_speed());
          if (!std::isfinite(state.P) || state.P < 0.)
            continue;
          result.smallest_P = std::min(result.smallest_P, state.P);
          if (state.P <= result.P)
            continue;
          result.P = state.P;
          result.s = state.contact.s;
        }
    }

    /// Returns dP/d(delta) of a contact of width w [N/mm]: b E w/(h (1 - nu^2)) of a thin bonded layer of thickness h, and of a
    /// contact that is narrow against it pi b E/(2 (1 - nu^2) log(1 + 2.426 h/w)), which tends to Johnson, Contact Mechanics,
    /// eq. 5.57. The larger of the two is within some 5 % of indentation by finite elements where nu is small, and up to a third
    /// too small at nu = 0.4. A bare lever is its own layer, an elastic cylinder one on its shaft, in series.
    double face_stiffness(const Device &device, const double P)
    {
      const bool is_short = device.analysis.dimension == 3 && device.cylinder.length > 0.;
      const double width  = is_short ? std::min(device.lever.width, device.cylinder.length) : device.lever.width;
      const double wide   = estimated_contact_width(device, P);
      const double compliance =
          sum_over(compressed_bodies(device),
                   [&](const FaceMaterial &body)
                   {
                     const double slender = body.h / wide;
                     return (1. - body.nu * body.nu) / body.E * std::min(slender, M_2_PI * std::log1p(2.426 * slender));
                   });
      return width / compliance;
    }

    /// Deflection of the face of a layer that is bonded to a rigid base under a pressure that varies as a cosine, over the
    /// pressure times 2 (1 - nu^2) t/E. `wave`: thickness t times the wave number; plane strain (Meijers, Applied
    /// Scientific Research 18, 353).
    double layer_deflection(const double wave, const double nu)
    {
      constexpr double thick = 30.;
      if (wave > thick)
        return 1. / wave;
      const double kappa = 3. - 4. * nu;
      return (2. * kappa * std::sinh(2. * wave) - 4. * wave) /
             (2. * kappa * std::cosh(2. * wave) + 4. * wave * wave + 1. + kappa * kappa) / wave;
    }

    /// Returns dP/d(delta) of the contact law of reduced models [N/mm].
    double law_stiffness(const ContactSettings &contact, const double P)
    {
      const double n = contact.exponent;
      return n * std::pow(contact.stiffness, 1. / n) * std::pow(P, 1. - 1. / n);
    }
  } // namespace

  double estimated_contact_width(const Device &device, const double P)
  {
    const auto width = [&](const FaceMaterial &body, const bool is_bonded)
    {
      const double load  = P * device.geometry.cylinder_radius * (1. - body.nu * body.nu) / (device.lever.width * body.E);
      const double hertz = 4. * std::sqrt(load / M_PI);
      return is_bonded ? std::min(hertz, 2. * std::cbrt(1.5 * load * body.h)) : hertz;
    };
    const auto bodies  = compressed_bodies(device);
    const double first = width(bodies.front(), device.layer.thickness > 0.);
    return bodies.size() == 1 ? first : std::max(first, width(bodies.back(), true));
  }

  std::optional<FaceGrading> face_grading(const Device &device)
  {
    const double size   = device.mesh.face_size;
    const double from   = device.drive.minimum();
    const double travel = device.drive.maximum() - from;
    if (!(device.mesh.faces_in_contact > 0.) || !device.mesh.file.empty() || device.lever.outline != LeverOutline::bar)
      return {};
    const double longest  = std::min(size, needed_length(device, device.drive.maximum()));
    const double shortest = std::max(shortest_share * size, needed_length(device, from));
    if (longest < least_longest * size || shortest >= longest)
      return {};
    double x = from;
    for (unsigned int i = 1; i <= places && needed_length(device, x) < longest; ++i)
      x = from + travel * i / places;
    const double end = kinematics(device.geometry, from).s + faces_beyond * shortest;
    return FaceGrading{ kinematics(device.geometry, x).s, end, longest, shortest };
  }

  bool is_narrower_than_faces(const Device &device, const double width)
  {
    const double least = device.mesh.degree == 1 ? 2. : 1.;
    return device.mesh.file.empty() && width > 0. && width < least * device.mesh.face_size && !face_grading(device);
  }

  double hertz_height(const Device &device, const double P)
  {
    auto bodies = compressed_bodies(device);
    if (device.layer.thickness > 0.)
      bodies.erase(bodies.begin());
    return 2. * P / (M_PI * device.lever.width) *
           sum_over(bodies, [](const FaceMaterial &body) { return (1. - body.nu * body.nu) / body.E; });
  }

  double layer_pressure(const Device &device, const double P)
  {
    constexpr double small = 1e-3;
    const double t = device.layer.thickness, R = device.geometry.cylinder_radius, load = P / device.lever.width;
    if (t == 0. || !(load > 0.))
      return 0.;
    const double own      = device.layer.poisson_ratio;
    const bool is_free    = device.layer.plane == PlaneState::stress;
    const double nu       = is_free ? own / (1. + own) : own;
    const double modulus  = device.layer.young_modulus * (is_free ? (1. + 2. * own) / std::pow(1. + own, 2) : 1.);
    const auto compliance = [&](const double a) { return 2. * t * (1. - nu * nu) / modulus * layer_deflection(2. * t / a, nu); };
    double a = std::sqrt(R * t), pressure = 0., step = 1.;
    for (unsigned int i = 0; i < 50 && std::abs(step) > 1e-9; ++i)
    {
      const double power = std::log(compliance(a * (1. + small)) / compliance(a * (1. - small))) / (2. * small);
      const double shape = 1. - 0.5 * power;
      const double mean  = 0.5 * std::sqrt(M_PI) * std::tgamma(shape + 1.) / std::tgamma(shape + 1.5);
      pressure           = a * a / (2. * R * compliance(a));
      step               = std::log(load / (2. * mean * a * pressure)) / (3. - power);
      a *= std::exp(step);
    }
    return pressure;
  }

  ContactReference contact_reference(const Device &device)
  {
    const auto &contact = device.contact;
    ContactReference result{};
    set_forces(device, result);

    result.stiffness  = is_meshed(device.analysis.model) ? face_stiffness(device, result.P) : law_stiffness(contact, result.P);
    result.omega      = result.s * std::sqrt(result.stiffness / moment_of_inertia(device));
    result.relaxation = 2. * contact.damping / result.omega;
    result.tangential = contact.tangential_stiffness.value_or(result.stiffness / (2. * (1. + face_material(device).nu)));
    return result;
  }

  ContactLaw face_law(const Device &device)
  {
    if (!is_meshed(device.analysis.model))
      return { device.contact.stiffness, device.contact.exponent };
    constexpr double n   = 1.5;
    const auto reference = contact_reference(device);
    return { std::pow(reference.stiffness / n, n) / std::sqrt(reference.P), n };
  }
} // namespace sprag
