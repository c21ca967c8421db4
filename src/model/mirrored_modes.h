#pragma once

#include "model/modal_structure.h"

namespace sprag
{
  /// The modes of a mirrored pair, each lever's ports in its own axes: of the motion in which both levers mirror each other, and
  /// of that in which the second does the opposite. Each is the motion of one lever, at 1/sqrt(2) of its size for both; a sprung
  /// support moves with the first alone. Both must have the same layout of ports and the same stiffness of the spring.
  ModalData mirrored_modes(const ModalData &mirroring, const ModalData &opposite);

  /// The motions of one lever that make up a motion of a pair of those modes, equally many of both: that in which the levers
  /// mirror each other and the opposite one, positions and forces in static shapes alone.
  std::array<Motion, 2> mirrored_motions(const PortLayout &ports, const Motion &of_pair);
} // namespace sprag
