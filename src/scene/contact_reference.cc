#include "scene/contact_reference.h"

#include "scene/closed_form.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace sprag
{
  namespace
  {
    /// Largest P over the drive with its s, both ways at peak speed: P of the closed form may be infinite where the lever locks.
    std::pair<double, double> peak(const Scene &scene)
    {
      constexpr unsigned int samples = 64;
      std::pair<double, double> largest{ 0., 0. };
      const double from = scene.drive.minimum();
      const double to   = scene.drive.maximum();
      for (unsigned int i = 0; i <= samples; ++i)
        for (const double direction : { 1., -1. })
        {
          const auto state = closed_form(scene, from + (to - from) * i / samples, direction * scene.drive.peak_speed());
          if (std::isfinite(state.P) && state.P > largest.first)
            largest = { state.P, state.contact.s };
        }
      return largest;
    }
  } // namespace

  ContactReference contact_reference(const Scene &scene)
  {
    const auto &contact = scene.contact;
    const auto &layer   = scene.layer;
    ContactReference result{};
    std::tie(result.P, result.s) = peak(scene);

    const double n     = contact.exponent;
    result.stiffness   = n * std::pow(contact.stiffness, 1. / n) * std::pow(result.P, 1. - 1. / n);
    const double omega = result.s * std::sqrt(result.stiffness / scene.lever.moment_of_inertia);
    result.relaxation  = 2. * contact.damping / omega;
    const double nu    = layer.thickness > 0. ? layer.poisson_ratio : scene.lever.poisson_ratio;
    result.tangential  = contact.tangential_stiffness.value_or(result.stiffness / (2. * (1. + nu)));
    return result;
  }

  double neutral_axis_offset(const Scene &scene)
  {
    const double mesh = scene.geometry.interface_offset + scene.layer.thickness + 0.5 * scene.lever.depth;
    return scene.lever.neutral_axis_offset.value_or(mesh);
  }

  double mass_per_length(const Scene &scene)
  {
    const double L   = scene.lever.length;
    const double e_a = neutral_axis_offset(scene);
    const double J   = scene.lever.moment_of_inertia - scene.lever.tip_mass * (L * L + e_a * e_a);
    return J / (L * L * L / 3. + L * e_a * e_a);
  }
} // namespace sprag
