#pragma once

#include "fe/contact/face_contact_point.h"

#include <array>

namespace sprag
{
  /// Multipliers of the augmented Lagrangian method on a friction face: continuous and linear between the corners of its cells,
  /// whatever the degree of the displacements, which keeps the pair stable. A coefficient is the mean traction weighted with its
  /// hat function (dual basis, lumped): it is never negative where the pressures are not, and a corner that the contact hardly
  /// reaches does not swing. What of the traction varies within a cell stays with the penalty, which stabilises it.
  class FaceMultipliers
  {
  public:
    /// The face must outlive this.
    explicit FaceMultipliers(const FrictionFace<2> &face);

    /// Multipliers of the next augmentation at the points of `states`, from their tractions.
    std::vector<ContactMemory> augmented(const std::vector<FacePointState<2>> &states) const;

    /// Largest change of a pressure multiplier by the next augmentation, from those in `memory` [MPa].
    double largest_change(const std::vector<FacePointState<2>> &states, const std::vector<ContactMemory> &memory) const;

  private:
    template <class Traction>
    std::vector<Traction> averaged(const std::vector<FacePointState<2>> &states, Traction PointTraction<1>::*traction) const;

    /// Two hats that share a point.
    struct Share
    {
      unsigned int first; ///< the second follows
      std::array<double, 2> values;
    };

    const FrictionFace<2> &face;
    std::vector<Share> shares; ///< of the points
    std::vector<double> areas; ///< of the face, weighted with a hat [mm^2]
  };
} // namespace sprag
