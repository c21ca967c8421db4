#include "program/run_files.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <unistd.h>

namespace sprag
{
  bool has_progress(const std::string &folder)
  {
    const char *const names[] = { checkpoint_name, row_journal_name, map_journal_name, study_journal_name };
    std::error_code ignored;
    return std::any_of(std::begin(names), std::end(names),
                       [&](const char *name) { return std::filesystem::exists(folder + '/' + name, ignored); });
  }

  void remove_checkpoint(const std::string &folder)
  {
    for (const char *name : { checkpoint_name, next_checkpoint_name, row_journal_name })
      ::unlink((folder + '/' + name).c_str());
  }
} // namespace sprag
