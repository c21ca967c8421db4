#pragma once

namespace sprag
{
  struct Scene;

  /// Returns the scene with the behaviour of its meshed spring, which levers of every fidelity need. Throws InputError where the
  /// parts do not fit together then, AnalysisError where the spring cannot be solved.
  Scene prepared(const Scene &scene);
} // namespace sprag
