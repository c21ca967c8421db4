#include "analysis/run_calibration.h"

#include "base/errors.h"

namespace sprag
{
  void run_calibration(const Scene &, const RunOptions &)
  {
    throw AnalysisError("calibration is not there yet");
  }
} // namespace sprag
