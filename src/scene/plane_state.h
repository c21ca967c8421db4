// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"

namespace sprag
{
  /// Selects plane stress or plane strain for a part of a plane model.
  SPRAG_ENUMERATION(PlaneState, stress, strain)
} // namespace sprag
