#include "program/run_files.h"

#include <unistd.h>

namespace sprag
{
  void remove_checkpoint(const std::string &folder)
  {
    for (const char *name : { checkpoint_name, next_checkpoint_name, row_journal_name })
      ::unlink((folder + '/' + name).c_str());
  }
} // namespace sprag
