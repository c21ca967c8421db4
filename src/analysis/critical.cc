#include "analysis/critical.h"

#include "analysis/prepared_scene.h"
#include "base/errors.h"
#include "scene/read.h"

#include <cmath>
#include <limits>

namespace sprag
{
  namespace
  {
    struct Tried
    {
      double value;
      std::optional<SlideKind> kind; ///< none where the scene is not admitted
      double mu = std::numeric_limits<double>::quiet_NaN();
    };

    Tried attempt(const Scene &scene, const std::string &parameter, const double value, DynamicsMaker &maker)
    {
      try
      {
        const auto found = judge(prepared(variant(scene, { override_text(parameter, value) })), maker);
        Tried result{ value, found.kind };
        if (found.slide)
          result.mu = found.slide->mu;
        return result;
      }
      catch (const InputError &)
      {
      }
      catch (const AnalysisError &)
      {
      }
      return Tried{ value, {} };
    }
  } // namespace

  CriticalSearch critical_values(const Scene &scene, const ParameterRange &range, const double tolerance, DynamicsMaker &maker,
                                 const std::function<void()> &point_done)
  {
    CriticalSearch result{ range, {}, {}, {} };
    const auto attempt = [&](const double value)
    {
      const Tried tried = sprag::attempt(scene, range.name, value, maker);
      if (!tried.kind)
        result.not_judged.push_back(value);
      return tried;
    };
    const double width = range.to - range.from;
    Tried before       = attempt(range.from);
    result.first       = before.kind;
    point_done();
    for (unsigned int i = 1; i < range.points; ++i)
    {
      const Tried after = attempt(range.from + width * i / (range.points - 1));
      Tried low         = before;
      if (!result.first)
        result.first = after.kind;
      Tried high = after;
      while (low.kind && high.kind && low.kind != high.kind && std::abs(high.value - low.value) > tolerance * std::abs(width))
      {
        const Tried middle                     = attempt(0.5 * (low.value + high.value));
        (middle.kind == low.kind ? low : high) = middle;
      }
      if (low.kind && high.kind && low.kind != high.kind)
        result.changes.push_back(
            { 0.5 * (low.value + high.value), std::isnan(low.mu) ? high.mu : low.mu, *low.kind, *high.kind });
      before = after;
      point_done();
    }
    return result;
  }
} // namespace sprag
