// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"

namespace sprag
{
  /// Behaviour of a part of a plane model out of the plane.
  SPRAG_ENUMERATION(PlaneState, stress, strain)
} // namespace sprag
