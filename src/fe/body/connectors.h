// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/ranges.h"
#include "fe/body/body_properties.h"
#include "fe/body/dimension.h"

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sprag
{
  /// A spring between a friction plate and its lever: a force of `stiffness` times its compression, the sum of weights times
  /// displacements, which no rigid movement changes.
  struct Connector
  {
    ConnectorType type = ConnectorType::sensor;
    double stiffness   = 0.;                          ///< [N/mm]
    std::vector<std::pair<unsigned int, double>> row; ///< free degrees of freedom, increasing, and their weights

    /// Returns the compression [mm], positive where plate and lever approach (sensor) or the plate moves towards the tip (guide).
    template <class Vector>
    double compression(const Vector &displacement) const
    {
      return sum_over(row, [&](const auto &entry) { return entry.second * displacement[entry.first]; });
    }
  };

  /// A range along xi and, in three dimensions, one along zeta [mm].
  template <int dim>
  struct PadRange
  {
    std::array<double, dim - 1> begin, end;

    /// Returns the length or the area [mm^(dim - 1)], 0 where it ends before it begins.
    double measure() const;

    PadRange within(const PadRange &other) const;
  };

  /// Weights of displacements, by degree of freedom.
  using DofWeights = std::map<unsigned int, double>;

  /// Pads of plate and lever that face each other: the same range of the sides `sensor_plate` and `sensor_lever`. Means are
  /// integrals over the pads, which need not end where cells do.
  template <int dim>
  class FacingPads
  {
  public:
    /// Throws InputError if the sides do not reach as far or, in three dimensions, are not made of rectangles along xi and
    /// zeta.
    FacingPads(ConnectorType type, const PadRange<dim> &range, const ElasticBody<dim> &body);

    /// Returns the mean normal displacement of the plate's pad less that of the lever's.
    DofWeights approach() const;

    /// Returns the mean displacement of the plate's pad along xi (0) or zeta (1) less that of a rigid block which stands on the
    /// lever's pad and reaches to the plate, as it turns with the pad: forces on plate and lever lie in one line.
    DofWeights shift(unsigned int direction) const;

    /// Returns the turn of the plate's pad about eta less that of the lever's, in three dimensions.
    DofWeights turn() const;

  private:
    /// Mean displacement, mean slopes of that along eta towards xi and zeta, and the turn about eta.
    struct Pad
    {
      std::array<DofWeights, dim> mean;
      std::array<DofWeights, dim - 1> slope;
      DofWeights turn;
      double measure = 0.; ///< of what was found of it [mm^(dim - 1)]
      double height  = 0.; ///< mean eta [mm]
    };
    struct Collector;

    static Pad pad_on(dealii::types::boundary_id side, const std::string &name, ConnectorType type, const PadRange<dim> &range,
                      const ElasticBody<dim> &body);

    const Pad plate, lever;
  };

  Connector connector(ConnectorType type, double stiffness, const DofWeights &row);

  /// Finds the connectors of the settings in a plane, in their order: a sensor takes the approach of its pads, a guide their
  /// shift.
  std::vector<Connector> find_connectors(const ElasticBody<2> &body, const std::vector<ConnectorSettings> &settings);
} // namespace sprag
