#pragma once

#include <string>

namespace sprag
{
  /// Before a run with these parameters: throws InputError where the folder cannot serve, another run has it, or it holds the
  /// completed result of a run with other parameters, unless that is to be overwritten. Makes nothing.
  /// From then on, or once prepare_folder() has made it, the folder is this process's until that ends, by a lock on the folder
  /// itself, which leaves nothing behind; file systems without locks are taken as they are.
  void claim_folder(const std::string &folder, const std::string &parameters, bool overwrite);
} // namespace sprag
