// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/structure/modal_structure.h"

namespace sprag
{
  /// Three modes of a lever: a dof on the face with a static shape, another one without beside it, and the rotation.
  inline ModalData three_modes(const bool with_statics)
  {
    ModalData data;
    data.layout    = { 2, false };
    data.stiffness = { 400., 9e4, 4e6 };
    data.damping.reinit(3, 3);
    data.damping(0, 0) = 0.8;
    data.damping(1, 1) = 12.;
    data.damping(2, 2) = 80.;
    data.damping(0, 1) = data.damping(1, 0) = -1.5;
    data.shapes.reinit(3, 3);
    const double shapes[3][3] = { { 20., -31., 12. }, { 14., 9., -27. }, { 0.4, 0.2, -0.1 } };
    for (unsigned int a = 0; a < 3; ++a)
      for (unsigned int i = 0; i < 3; ++i)
        data.shapes(a, i) = shapes[a][i];
    data.spring_stiffness = 50.;
    if (with_statics)
    {
      data.face_compliance.reinit(2, 2);
      data.face_compliance(0, 0) = 2e-3;
      data.face_compliance(1, 1) = 3e-3;
      data.face_compliance(0, 1) = data.face_compliance(1, 0) = 1e-3;
      data.relaxation                                         = 2e-4;
    }
    return data;
  }
} // namespace sprag
