#pragma once

#include "fe/elastic_body.h"

namespace sprag
{
  /// Ports of a meshed lever without inertia: displacements of the nodes of friction face and elastic cylinder (2 i + d of node i
  /// along xi, eta; the cylinder's after the lever's), the hub's turn from the spring's rest and, on a sprung support, its
  /// displacement along x.
  struct StaticPorts
  {
    unsigned int surface = 0; ///< number of ports of the faces
    bool sprung          = false;

    unsigned int rotation() const
    {
      return surface;
    }
    unsigned int support() const
    {
      return surface + 1;
    }
    unsigned int size() const
    {
      return surface + (sprung ? 2 : 1);
    }
  };

  /// Linear springs at the ports of hub and support.
  struct PortSprings
  {
    double rotation = 0.; ///< k [N mm/rad], > 0
    double support  = 0.; ///< k_f [N/mm], > 0; counts on a sprung support
    double arm      = 0.; ///< length that turns a rotation into a movement [mm], > 0
  };

  /// Degrees of freedom of the ports of the faces.
  inline std::vector<unsigned int> surface_dofs(const ElasticBody<2> &body)
  {
    std::vector<unsigned int> result;
    for (const auto *const face : { &body.friction_face(), &body.cylinder_face() })
      for (const auto &node : face->nodes)
        result.insert(result.end(), node.dofs.begin(), node.dofs.end());
    return result;
  }
} // namespace sprag
