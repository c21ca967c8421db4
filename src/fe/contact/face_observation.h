// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/elastic_body.h"
#include "fe/contact/face_evaluation.h"
#include "results/columns.h"
#include "results/result_file.h"

namespace sprag
{
  /// A friction face in a plane as results show it.
  class FaceView
  {
  public:
    /// The face must outlive this. `layer_thickness` [mm], 0 without a layer, tells what counts as indentation: the deflection of
    /// the face at the centre of pressure over that aside of the contact.
    FaceView(const FrictionFace<2> &face_, const double layer_thickness_)
        : face(face_)
        , layer_thickness(layer_thickness_)
    {
    }

    /// Fills the columns that follow from tractions and positions on the face.
    void observe(const FaceEvaluation &found, Row &row) const;

    /// Fills those of them that are sums over the points under pressure.
    void observe_resultants(const FaceEvaluation &found, Row &row) const;

    FacePoints points() const;

    FaceState state(const FaceEvaluation &found, const DrivePoint &drive) const;

  private:
    const FrictionFace<2> &face;
    const double layer_thickness;
  };
} // namespace sprag
