#pragma once

#include "fe/material.h"

#include <deal.II/base/types.h>

#include <map>

namespace sprag
{
  // Ids that make_mesh() gives and ElasticBody reads.
  namespace material_id
  {
    inline constexpr dealii::types::material_id lever = 1;
    inline constexpr dealii::types::material_id layer = 2;
    inline constexpr dealii::types::material_id hub   = 3; ///< rigid: its nodes do not move in lever axes
  }                                                        // namespace material_id

  namespace boundary_id
  {
    inline constexpr dealii::types::boundary_id friction_face = 1;
    inline constexpr dealii::types::boundary_id hub           = 2; ///< does not move in lever axes
  }                                                                // namespace boundary_id

  struct BodyProperties
  {
    unsigned int degree    = 2;
    PlaneState plane       = PlaneState::stress;
    MaterialModel material = MaterialModel::linear;
    double width           = 1.;   ///< out of plane [mm]
    double point_spacing   = 0.02; ///< aimed at between integration points of the friction face [mm]
    std::map<dealii::types::material_id, ElasticConstants> constants;
  };
} // namespace sprag
