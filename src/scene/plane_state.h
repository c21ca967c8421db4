// SPDX-License-Identifier: GPL-3.0-only
#pragma once

namespace sprag
{
  /// Behaviour of a part of a plane model out of the plane.
  enum class PlaneState
  {
    stress, ///< it may contract and bears no stress there
    strain  ///< it may not contract
  };
} // namespace sprag
