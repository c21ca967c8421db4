// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/fields/body_fields.h"
#include "levers/dynamics.h"
#include "scene/held_slide.h"

namespace sprag
{
  struct Scene;

  /// Returns the body of a meshed model in time for its fields.
  inline BodyFields shown_body(const Scene &scene, const Dynamics &dynamics)
  {
    if (dynamics.lever)
      return BodyFields(*dynamics.lever->body);
    const auto &body = *dynamics.solid->body;
    return { body, reached_face(reachable_contact(scene), body) };
  }
} // namespace sprag
