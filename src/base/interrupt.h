#pragma once

namespace sprag
{
  /// From now on SIGINT and SIGTERM ask for an end instead of making one, so that results can be finished. A second one ends at
  /// once.
  void catch_interrupts();

  /// Whether an end was asked for.
  bool interrupted();
} // namespace sprag
