// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/connectors.h"
#include "fe/solid/shared_factors.h"

namespace sprag
{
  struct Scene;

  /// A body in three dimensions that a friction plate may belong to.
  struct PlateAndLever
  {
    const dealii::Mapping<3> &mapping;
    const dealii::DoFHandler<3> &dof_handler;
    const dealii::AffineConstraints<double> &constraints;
    bool is_half; ///< of one that is the same on both sides of the middle: zeta >= 0
  };

  /// Finds the connectors of the scene's friction plate; none without one. First come the sensors, of each place along the lever
  /// that on the left (zeta < 0) and that on the right, half as stiff as the place each; of a half the right one alone, which
  /// stands for both. Then comes the guide, over the whole width: a spring along the lever, and of a whole also one across it,
  /// as stiff, and one against turning about eta, as of springs along the lever spread over the width [N mm]. Pads and
  /// compressions are those of find_connectors(). Throws InputError if the sides do not reach as far or are not made of
  /// rectangles along xi and zeta.
  std::vector<Connector> find_connectors(const PlateAndLever &body, const Scene &scene);

  /// Adds the stiffness of a connector to that of its body.
  void add(const Connector &connector, SymmetricEntries &stiffness);
} // namespace sprag
