// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/face_contact.h"

namespace sprag
{
  /// The terms that a step without inertia adds to the contact. With the damper's `geometry` friction takes the speeds of sliding
  /// of a rigid lever at the end of the step, see FaceStep, without it their means over the step. In the cone mode nothing has
  /// been rubbed yet where no time has passed.
  StaticTerms static_terms(const FrictionLaw &friction, const std::optional<Geometry> &geometry, const DrivePoint &begin,
                           const DrivePoint &end, FrictionMode mode);
} // namespace sprag
