// SPDX-License-Identifier: GPL-3.0-only
#include "fe/fields/help_first_rank.h"

#include "fe/fields/body_fields.h"

#include <map>
#include <optional>

namespace sprag
{
  namespace
  {
    struct HelpedBody
    {
      explicit HelpedBody(const MPI_Comm ranks)
          : body(ranks)
      {
      }

      SolidBody body;
      std::optional<BodyFields> fields = {}; ///< of one whose fields are found
    };

    void take_part(HelpedBody &helped, const SharedTask task)
    {
      if (task != SharedTask::recover_stress)
        return helped.body.take_part(task);
      if (!helped.fields)
        helped.fields.emplace(helped.body);
      helped.fields->take_part();
    }
  } // namespace

  void help_first_rank(const MPI_Comm ranks)
  {
    std::map<int, HelpedBody> bodies;
    for (auto call = next_call(ranks); call.task != SharedTask::end; call = next_call(ranks))
      try
      {
        if (call.task == SharedTask::build)
          bodies.try_emplace(call.body, ranks);
        else if (call.task == SharedTask::release)
          bodies.erase(call.body);
        else if (call.task == SharedTask::write_rows)
          take_part_in_writing(ranks);
        else
          take_part(bodies.at(call.body), call.task);
      }
      catch (const std::runtime_error &)
      {
        // The first rank fails as well and reports why.
      }
  }

  Writers writers_at_hand()
  {
    const MPI_Comm ranks = ranks_at_hand();
    return { ranks, [ranks] { call_others({ SharedTask::write_rows, 0 }, ranks); } };
  }
} // namespace sprag
