#pragma once

#include "fe/contact/face_contact.h"

namespace sprag
{
  /// What a step without inertia adds to the contact. `geometry`: of the damper, for speeds of sliding as of a rigid lever at the
  /// end of the step, see FaceStep; none: its means. In the cone mode nothing has been rubbed yet where no time has passed.
  StaticTerms static_terms(const FrictionLaw &friction, const std::optional<Geometry> &geometry, const DrivePoint &begin,
                           const DrivePoint &end, FrictionMode mode);
} // namespace sprag
