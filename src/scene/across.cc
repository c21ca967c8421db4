#include "scene/across.h"

#include "scene/analysis_use.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sprag
{
  bool is_symmetric_across(const Scene &scene)
  {
    return !holds_slide(scene.analysis.type) && scene.cylinder.tilt == 0. && scene.cylinder.skew == 0. &&
           scene.cylinder.position == 0.;
  }

  std::vector<double> planes_across(const Scene &scene)
  {
    const unsigned int n = scene.mesh.elements_across;
    const double width   = scene.lever.width;
    std::vector<double> sizes(n);
    double sum = 0.;
    for (unsigned int i = 0; i < n; ++i)
      sum += sizes[i] = std::pow(scene.mesh.growth_across, std::min(i, n - 1 - i));
    std::vector<double> result{ -0.5 * width };
    for (const double size : sizes)
      result.push_back(result.back() + size / sum * width);
    result.back() = 0.5 * width;
    if (!is_symmetric_across(scene))
      return result;
    const double round_off = 1e-9 * width;
    std::vector<double> half{ 0. };
    std::copy_if(result.begin(), result.end(), std::back_inserter(half), [&](const double zeta) { return zeta > round_off; });
    return half;
  }
} // namespace sprag
