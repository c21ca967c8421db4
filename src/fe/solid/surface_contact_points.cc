#include "fe/solid/surface_contact.h"

#include <algorithm>

namespace sprag
{
  void SurfaceContact::add_points(SurfaceEvaluation &found) const
  {
    found.points.clear();
    for (const unsigned int patch : looked_at)
      in_lanes.add_points(patch, true, found.points);
  }

  bool SurfaceContact::share_line(const unsigned int patch, const unsigned int other) const
  {
    const auto &a = lines_of_patch[patch], &b = lines_of_patch[other];
    return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
  }

  void SurfaceContact::add_points_in_contact(SurfaceEvaluation &found) const
  {
    double largest    = 0.;
    unsigned int peak = dealii::numbers::invalid_unsigned_int;
    for (const unsigned int patch : looked_at)
      if (const double pressure = in_lanes.largest_pressure(patch); pressure > largest)
      {
        largest = pressure;
        peak    = patch;
      }
    found.points.clear();
    for (const unsigned int patch : looked_at)
      in_lanes.add_points(patch, largest == 0. || share_line(patch, peak), found.points);
  }

  void SurfaceContact::complete(SurfaceEvaluation &found) const
  {
    StepInLanes::Sums sums;
    for (const unsigned int patch : looked_at)
      in_lanes.add_works(patch, sums);
    add_points_in_contact(found);
    found.stored            = sums.stored;
    found.beyond_face       = reaches_end(found);
    found.works             = StepWork();
    found.works.drive       = sums.drive;
    found.works.friction    = sums.friction;
    found.works.algorithmic = sums.algorithmic;
    found.works.creep       = sums.creep;
  }

  bool SurfaceContact::reaches_end(const SurfaceEvaluation &found) const
  {
    return std::any_of(found.points.begin(), found.points.end(),
                       [&](const auto &point) { return point.pressure > 0. && is_at_end[point.patch]; });
  }
} // namespace sprag
