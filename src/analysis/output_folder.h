#pragma once

#include <string>

namespace sprag
{
  /// Throws InputError if the folder could not be made or written to, or where a result is to be written stands something else
  /// than a file; makes nothing.
  void require_writable(const std::string &folder);

  /// Makes the folder if needed and keeps it for this process until it ends, by a lock on the folder itself, which leaves
  /// nothing behind; file systems without locks are taken as they are. Throws InputError if nothing can be written there, or if
  /// another run still has it after 3 s.
  void prepare_folder(const std::string &folder);

  /// Before a run with these parameters: throws InputError where the folder cannot serve, another run has it, or it holds the
  /// completed result of a run with other parameters, unless that is to be overwritten. Makes nothing.
  void claim_folder(const std::string &folder, const std::string &parameters, bool overwrite);
} // namespace sprag
