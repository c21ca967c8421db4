// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/solid/face_parts.h"
#include "fe/solid/surface_contact.h"
#include "results/columns.h"
#include "results/result_file.h"

namespace sprag
{
  /// A friction face as results show it: the means over its FaceParts.
  class SurfaceView
  {
  public:
    /// Face and contact must outlive this. `half`: the face is half of one which is the same on both sides of the middle.
    SurfaceView(const FrictionFace<3> &face, const SurfaceContact &contact, bool half);

    /// Fills the columns that follow from tractions and positions on the face.
    void observe(const SurfaceEvaluation &found, Row &row) const;

    /// Fills those of them that are sums over the points under pressure.
    void observe_resultants(const SurfaceEvaluation &found, Row &row) const;

    FacePoints points() const;

    FaceState state(const SurfaceEvaluation &found, const DrivePoint &drive) const;

  private:
    void observe_pressure(const SurfaceEvaluation &found, Row &row) const;

    const FrictionFace<3> &face;
    const SurfaceContact &contact;
    const bool is_half;
    const FaceParts parts;
    std::vector<unsigned int> line_of_point; ///< points with the same zeta
  };
} // namespace sprag
