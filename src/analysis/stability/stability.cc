// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/stability/stability.h"

#include "base/errors.h"
#include "base/unknown.h"
#include "model/lever/reduced_lever.h"
#include "model/structure/eigenmodes.h"
#include "scene/held_slide.h"
#include "scene/lever_inertia.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace sprag
{
  namespace
  {
    SlideKind classify(const HeldSlide &slide, const std::complex<double> worst)
    {
      if (!(slide.uniqueness > 0.) || !slide.is_pressed())
        return SlideKind::jammed;
      if (worst.real() <= smallest_growth * std::abs(worst))
        return SlideKind::stable;
      return worst.imag() > smallest_growth * std::abs(worst) ? SlideKind::flutter : SlideKind::divergence;
    }

    constexpr unsigned int most_elements = 4 * beam_elements; ///< of a beam on which a slide is checked

    /// Factor on the lever's Young's modulus that makes its flexure negligible.
    constexpr double rigid_factor = 1e4;

    Role checked(const std::string &name, const std::string &meaning, const Scene &scene, DynamicsMaker &maker)
    {
      try
      {
        return { name, meaning, check_slide(scene, maker) };
      }
      catch (const AnalysisError &error)
      {
        return { name, meaning + "; " + error.what() };
      }
    }

    /// Without mass nothing vibrates: only the uniqueness of the equilibrium is decided.
    Role without_inertia(const SlideStability &present)
    {
      SlideStability massless;
      massless.kind = present.slide && present.uniqueness() > 0. ? SlideKind::stable : SlideKind::jammed;
      return { "without_inertia", "massless: stable where the equilibrium is unique", massless };
    }
  } // namespace

  double mode_frequency(const Eigenmode &mode)
  {
    return mode.mode.eigenvalue.imag() / (2. * M_PI);
  }

  std::string kind_name(const SlideKind kind)
  {
    return enumerator_name(kind);
  }

  std::string SlideStability::motion() const
  {
    constexpr double pure = 0.99;
    if (modes.empty() || std::isnan(worst_mode().symmetry))
      return "";
    const auto is_other = [this](const Eigenmode &mode)
    { return are_tied(mode.mode, worst_mode().mode) && mode.symmetry * worst_mode().symmetry < 0.; };
    if (std::any_of(modes.begin(), modes.end(), is_other))
      return "either";
    if (std::abs(worst_mode().symmetry) < pure)
      return "mixed";
    return worst_mode().symmetry > 0. ? "mirroring" : "swinging";
  }

  CheckedModes checked_modes(const Scene &scene, const bool refined)
  {
    CheckedModes result{ scene.stability.modes };
    result.explained = scene.pair.type == PairType::full;
    if (scene.analysis.model == ModelType::beam)
    {
      result.up_to            = highest_beam_frequency(scene);
      result.length_frequency = bending_frequency(scene, scene.lever.length);
      if (refined)
        result.finer_beam = [held = held_scene(scene)](const unsigned int elements)
        { return make_reduced_lever(held, elements); };
    }
    return result;
  }

  double CheckedModes::growth_error(const std::complex<double> lambda) const
  {
    const double share = 9e-4 * std::pow(static_cast<double>(beam_elements) / elements, 3);
    if (std::isinf(length_frequency))
      return 0.;
    return share * std::abs(lambda) * std::max(1., lambda.imag() / (2. * M_PI * length_frequency));
  }

  bool is_decided(const std::complex<double> eigenvalue, const double error)
  {
    constexpr double round_off = 1e-9; // of |lambda|
    const double growth        = std::abs(eigenvalue.real());
    return !(growth < error && growth > round_off * std::abs(eigenvalue));
  }

  std::complex<double> eigenvalue_near(const SlideStability &slide, const double frequency)
  {
    std::complex<double> result = std::nan("");
    for (const auto &mode : slide.modes)
      if (const auto lambda = mode.mode.eigenvalue;
          !(std::abs(lambda.imag() / (2. * M_PI) - frequency) >= std::abs(result.imag() / (2. * M_PI) - frequency)))
        result = lambda;
    return result;
  }

  bool SlideStability::is_decided() const
  {
    return modes.empty() || kind == SlideKind::jammed || sprag::is_decided(worst_mode().mode.eigenvalue, error);
  }

  double SlideStability::highest_frequency() const
  {
    double result = unknown;
    for (const auto &mode : modes)
      if (const auto lambda = mode.mode.eigenvalue; lambda.imag() > -lambda.real())
        result = std::fmax(result, mode_frequency(mode));
    return result;
  }

  SlideStability check_slide(DynamicModel &model, const DrivePoint &drive, const CheckedModes &modes)
  {
    return check_slide(model, model.hold(drive, ContactFriction::sliding), modes);
  }

  SlideStability check_slide(DynamicModel &model, const std::optional<HeldSlide> &slide, const CheckedModes &modes)
  {
    SlideStability result;
    result.slide = slide;
    if (!result.slide)
      return result;
    if (modes.explained)
      result.modes = model.vibrations(*result.slide, true, modes.lowest);
    else
      for (const auto lambda : model.eigenvalues(*result.slide, modes.lowest))
        result.modes.emplace_back().mode.eigenvalue = lambda;
    const auto growth = [](const Eigenmode &mode) { return mode.mode.eigenvalue.real() / std::abs(mode.mode.eigenvalue); };
    const auto grows  = [&](const Eigenmode &mode)
    { return growth(mode) > smallest_growth && mode.mode.eigenvalue.real() > modes.growth_error(mode.mode.eigenvalue); };
    const auto is_worse = [&](const Eigenmode &a, const Eigenmode &b)
    {
      const bool a_grows = grows(a);
      const bool b_grows = grows(b);
      return a_grows == b_grows ? a.mode.eigenvalue.real() < b.mode.eigenvalue.real() : b_grows;
    };
    const auto is_fast = [&](const Eigenmode &mode) { return mode_frequency(mode) > modes.up_to; };
    const auto fast    = std::stable_partition(result.modes.begin(), result.modes.end(), std::not_fn(is_fast));
    if (const auto most = std::max_element(fast, result.modes.end(), is_worse);
        most != result.modes.end() && growth(*most) > smallest_growth)
      result.beyond = *most;
    if (fast != result.modes.begin())
      result.modes.erase(fast, result.modes.end());
    const auto worst = std::max_element(result.modes.begin(), result.modes.end(), is_worse);
    const auto first =
        std::find_if(result.modes.begin(), worst, [&](const Eigenmode &mode) { return are_tied(mode.mode, worst->mode); });
    result.worst = static_cast<std::size_t>(first - result.modes.begin());
    result.kind  = classify(*result.slide, result.worst_mode().mode.eigenvalue);
    result.error = modes.growth_error(result.worst_mode().mode.eigenvalue);
    if (!grows(result.worst_mode()))
      for (const auto &mode : result.modes)
        result.error =
            std::max(result.error, mode.mode.eigenvalue.real() - result.growth_rate() + modes.growth_error(mode.mode.eigenvalue));
    result.elements = modes.elements;
    if (result.is_decided() || !modes.finer_beam || modes.elements >= most_elements)
      return result;
    auto finer = modes;
    finer.elements *= 2;
    auto by_finer   = check_slide(*modes.finer_beam(finer.elements), slide->drive, finer);
    by_finer.beyond = result.beyond; // finer beams have ever faster modes
    return by_finer;
  }

  SlideStability check_slide(const Scene &scene, DynamicsMaker &maker)
  {
    const Scene held    = held_scene(scene);
    const auto dynamics = maker.make(held);
    return check_slide(dynamics.model(), held_drive(scene), checked_modes(held, true));
  }

  std::vector<Role> roles(const Scene &scene, const SlideStability &present, DynamicsMaker &maker)
  {
    std::vector<Role> result    = { without_inertia(present) };
    const bool depends_on_speed = !std::holds_alternative<CoulombFriction>(held_scene(scene).friction.law);
    if (present.slide && depends_on_speed)
    {
      Scene constant           = held_scene(scene);
      constant.friction.law    = CoulombFriction{ present.slide->mu };
      constant.friction.factor = 1.;
      result.push_back(checked("without_friction_derivative", "mu constant, as it is at this speed", constant, maker));
    }
    Scene undamped             = scene;
    undamped.stability.damping = false;
    result.push_back(checked("without_damping", "no damping of lever, contact and support", undamped, maker));
    if (scene.support.type == SupportType::sprung)
    {
      Scene fixed        = scene;
      fixed.support.type = SupportType::rigid;
      result.push_back(checked("without_support", "pivot at rest", fixed, maker));
    }
    if (scene.analysis.model != ModelType::rigid)
    {
      const bool is_beam = scene.analysis.model == ModelType::beam;
      Scene stiff        = scene;
      if (is_beam)
        stiff.analysis.model = ModelType::rigid;
      else
        stiff.lever.young_modulus *= rigid_factor;
      result.push_back(
          checked("without_flexure", is_beam ? "a rigid lever" : "Young's modulus of the lever times 1e4", stiff, maker));
    }
    return result;
  }
} // namespace sprag
