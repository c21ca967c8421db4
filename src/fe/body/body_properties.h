// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/material.h"

#include <deal.II/base/types.h>

#include <map>
#include <vector>

namespace sprag
{
  // Ids that make_mesh() gives and ElasticBody reads.
  namespace material_id
  {
    inline constexpr dealii::types::material_id lever    = 1;
    inline constexpr dealii::types::material_id layer    = 2;
    inline constexpr dealii::types::material_id hub      = 3; ///< rigid: its nodes do not move in lever axes
    inline constexpr dealii::types::material_id web      = 4; ///< of the lever, where its width is smaller
    inline constexpr dealii::types::material_id plate    = 5; ///< that carries the friction layer
    inline constexpr dealii::types::material_id cylinder = 6;
    inline constexpr dealii::types::material_id leaf     = 7;

    /// Returns whether what is made of it turns with the lever; a cylinder does not.
    inline bool turns(const dealii::types::material_id id)
    {
      return id != cylinder;
    }
  } // namespace material_id

  namespace boundary_id
  {
    inline constexpr dealii::types::boundary_id friction_face = 1;
    inline constexpr dealii::types::boundary_id hub           = 2; ///< does not move in lever axes
    inline constexpr dealii::types::boundary_id core          = 3; ///< of an elastic cylinder, does not move in its axes
    inline constexpr dealii::types::boundary_id cylinder_face = 4; ///< of an elastic cylinder, where it can touch the lever
    inline constexpr dealii::types::boundary_id sensor_plate  = 5; ///< of the friction plate, towards the sensors
    inline constexpr dealii::types::boundary_id sensor_lever  = 6; ///< of the lever, towards the sensors
    inline constexpr dealii::types::boundary_id joint         = 7; ///< far end of a leaf spring
    inline constexpr dealii::types::boundary_id clamp         = 8; ///< of a leaf spring in the hub, which turns it
    inline constexpr dealii::types::boundary_id symmetry      = 9; ///< of a half over the width: it does not move along zeta
  }                                                                // namespace boundary_id

  /// Directions of the force of a spring between friction plate and lever.
  enum class ConnectorType
  {
    sensor, ///< carries normal force alone
    guide   ///< carries tangential force alone
  };

  /// A spring between friction plate and lever, see Connector.
  struct ConnectorSettings
  {
    ConnectorType type = ConnectorType::sensor;
    double middle      = 0.; ///< along the lever from the pivot [mm]
    double length      = 1.; ///< of its pads along the lever [mm], > 0
    double stiffness   = 0.; ///< [N/mm], > 0
  };

  /// Elements, materials and widths of a meshed body.
  struct BodyProperties
  {
    unsigned int degree = 2;
    PlaneState plane    = PlaneState::stress;
    std::map<dealii::types::material_id, PlaneState> planes; ///< of materials in another
    MaterialModel material = MaterialModel::linear;
    double width           = 1.;                         ///< out of plane [mm]
    std::map<dealii::types::material_id, double> widths; ///< of materials with another width [mm]
    bool curved          = false;                        ///< whether cells follow the triangulation's manifolds
    double point_spacing = 0.02;                         ///< aimed at between integration points of the friction face [mm]
    std::map<dealii::types::material_id, ElasticConstants> constants;
    std::vector<ConnectorSettings> connectors; ///< of a friction plate

    PlaneState plane_state(const dealii::types::material_id id) const
    {
      const auto found = planes.find(id);
      return found == planes.end() ? plane : found->second;
    }

    double material_width(const dealii::types::material_id id) const
    {
      const auto found = widths.find(id);
      return found == widths.end() ? width : found->second;
    }
  };
} // namespace sprag
