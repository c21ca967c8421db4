// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"
#include "fe/fields/body_fields.h"
#include "results/columns.h"
#include "results/result_file.h"

#include <array>
#include <optional>

namespace sprag
{
  /// Returns where the stress of a node counts: 0 lever, 1 layer, 2 cells at the hub; none for other parts.
  std::optional<unsigned int> stress_region(const BodyFields::Node &node);

  /// Returns the largest sqrt(p^2 + 3 t^2) of the points of a face [MPa].
  double largest_surface_stress(const std::vector<double> &pressure, const std::vector<double> &traction);

  /// Largest von Mises stress in lever (web included) and layer over the states that are looked at. In the cells that the hub
  /// holds the stress of linear elasticity grows without bound with a finer mesh, so the lever's peak leaves them out and theirs
  /// is told by itself.
  class StressPeaks
  {
  public:
    explicit StressPeaks(const BodyFields &fields);

    /// Looks at the fields of a state at x [mm]. `direction` is 1 forward and -1 backward, `lever` is 0 or of a pair 1.
    void look_at(const std::vector<NodalField> &nodal, double x, int direction, unsigned int lever);

    /// Returns the entries of /summary for so many levers. They are NaN where nothing has been looked at.
    std::vector<Entry> entries(unsigned int levers) const;

    /// Serialises what was found so far.
    void serialise_progress(Archive &archive);

  private:
    /// A largest stress [MPa] and its place, x and lever.
    struct Peak
    {
      double stress      = 0.;
      double x           = 0.;
      int direction      = 0;
      unsigned int lever = 0;
      dealii::Point<3> place;
    };

    const BodyFields &fields;
    std::array<std::optional<Peak>, 3> peaks;
    std::array<bool, 3> there{}; ///< whether the mesh has such cells
  };
} // namespace sprag
