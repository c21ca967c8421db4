// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/contact/mirrored_contact.h"
#include "model/lever/dynamic_lever.h"
#include "model/structure/mirrored_structure.h"

namespace sprag
{
  /// A lever of a structure, or a pair of a MirroredStructure. `contact(lever)` makes the contact of a lever, with dofs of its
  /// own, `points` is more than the points of its history.
  template <class Structure, class MakeContact>
  std::unique_ptr<DynamicModel> assemble_lever(std::unique_ptr<Structure> structure, LeverFrame frame, const MakeContact &contact,
                                               [[maybe_unused]] const unsigned int points)
  {
    using Contact = typename std::decay_t<decltype(contact(0))>::element_type;
    if constexpr (Structure::levers == 1)
      return std::make_unique<DynamicLever<Structure, Contact>>(std::move(structure), contact(0), std::move(frame));
    else
    {
      using Pair        = MirroredContact<Contact>;
      const auto layout = structure->layout();
      return std::make_unique<DynamicLever<Structure, Pair>>(
          std::move(structure),
          std::make_unique<Pair>(std::array<std::unique_ptr<Contact>, 2>{ { contact(0), contact(1) } }, layout, points),
          std::move(frame));
    }
  }
} // namespace sprag
