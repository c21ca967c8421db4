// SPDX-License-Identifier: GPL-3.0-only
#include "fe/solid/solid_connectors.h"

#include "scene/across.h"
#include "scene/device.h"

namespace sprag
{
  namespace
  {
    void add_guide(const ElasticBody<3> &body, const Device &device, const bool is_half, std::vector<Connector> &result)
    {
      const auto &plate      = device.plate;
      const double half      = 0.5 * device.lever.width;
      const double xi        = 0.5 * plate.sensor_length;
      const double stiffness = plate.guide_stiffness;
      const FacingPads<3> pads(ConnectorType::guide,
                               { { { plate.guide - xi, is_half ? 0. : -half } }, { { plate.guide + xi, half } } }, body);
      result.push_back(connector(ConnectorType::guide, stiffness, pads.shift(0)));
      if (is_half)
        return;
      result.push_back(connector(ConnectorType::guide, stiffness, pads.shift(1)));
      result.push_back(connector(ConnectorType::guide, stiffness * half * half / 3., pads.turn()));
    }
  } // namespace

  std::vector<Connector> find_connectors(const ElasticBody<3> &body, const Device &device, const bool is_half)
  {
    const auto &plate = device.plate;
    std::vector<Connector> result;
    if (plate.type == PlateType::none)
      return result;
    const double middle = sensors_across(device), xi = 0.5 * plate.sensor_length, zeta = 0.5 * plate.sensor_width;
    for (const double place : plate.sensors)
      for (const double side : { -1., 1. })
      {
        if (is_half && side < 0.)
          continue;
        const FacingPads<3> pads(ConnectorType::sensor,
                                 { { { place - xi, side * middle - zeta } }, { { place + xi, side * middle + zeta } } }, body);
        const double share = is_half ? 1. : 0.5;
        result.push_back(connector(ConnectorType::sensor, share * plate.sensor_stiffness, pads.approach()));
      }
    add_guide(body, device, is_half, result);
    return result;
  }

  void add(const Connector &connector, MatrixEntries &stiffness)
  {
    for (const auto &[row, of_row] : connector.row)
      for (const auto &[column, of_column] : connector.row)
        if (row <= column)
          stiffness.add(row, column, connector.stiffness * of_row * of_column);
  }
} // namespace sprag
