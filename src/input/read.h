// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/text.h"

namespace sprag
{
  struct Scene;

  /// Reads a parameter file and the overrides "Section/Name=value", which count more. Paths in the file are relative to its
  /// folder. Throws InputError holding every mistake, each as "FILE:LINE: Section/Name = value: RULE", FILE alone where a
  /// default is at fault and "--set" for an override.
  Scene read_scene(const std::string &file, const std::vector<std::string> &overrides = {});

  /// Returns the scene with some parameters changed, each "Section/Name=value", as if it had been read with these overrides: what
  /// was left at its default follows from them. Throws InputError as read_scene() does.
  Scene variant(const Scene &scene, const std::vector<std::string> &overrides);

  /// Returns the scene with parameters that the program has chosen, each "Section/Name=value". They do not count as given.
  Scene with_chosen(const Scene &scene, const std::vector<std::string> &overrides);

  /// Returns the text "Section/Name=value" for a number.
  inline std::string override_text(const std::string &parameter, const double value)
  {
    return parameter + '=' + number_text(value);
  }

  /// Writes every parameter as it was read, before any was chosen, with its documentation, in .prm form, and as comments those
  /// that were left open; empty for a scene that was not read.
  std::string parameters_text(const Scene &scene);

  /// Writes the parameters that were given, in the same form. It is read back as the same scene, but for what the program chose.
  std::string specified_parameters_text(const Scene &scene);

  /// Writes every parameter with its default and documentation, in .prm form, as comments.
  std::string default_parameters_text();
} // namespace sprag
