// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/face_contact_point.h"

#include <array>

namespace sprag
{
  /// Multipliers of the augmented Lagrangian method on a friction face: continuous and linear between the corners of its cells,
  /// for any degree of the displacements, which keeps the pair stable. A coefficient is the mean traction weighted with the
  /// corner's hat function (lumped dual basis),
  ///   lambda_c = int t h_c dA / int h_c dA,
  /// so that pressures >= 0 give multipliers >= 0. The variation of the traction within a cell is left to the penalty. Points
  /// that slip keep their own traction, by which the friction law is met there.
  template <int dim>
  class FaceMultipliers
  {
  public:
    using States = std::vector<FacePointState<dim>>;

    /// The face must outlive this. On a surface its cells are rectangles along xi and zeta.
    explicit FaceMultipliers(const FrictionFace<dim> &face);

    /// Multipliers of the next augmentation at the points of `states`, from their tractions.
    std::vector<ContactHistory> augmented(const States &states) const;

    /// Largest change of a pressure multiplier by the next augmentation, from those in `history` [MPa].
    double largest_change(const States &states, const std::vector<ContactHistory> &history) const;

  private:
    static constexpr unsigned int n_corners = 1u << (dim - 1);

    template <class Traction>
    std::vector<Traction> averaged(const States &states, Traction PointTraction::*traction) const;

    /// The hats of a cell's corners at one of its points.
    struct Share
    {
      std::array<unsigned int, n_corners> corners;
      std::array<double, n_corners> values;
    };

    const FrictionFace<dim> &face;
    std::vector<Share> shares; ///< of the points
    std::vector<double> areas; ///< of the face, weighted with a hat [mm^2]
  };
} // namespace sprag
