// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/face_evaluation.h"
#include "fe/contact/face_parts.h"
#include "fe/contact/pressure_recovery.h"
#include "results/columns.h"
#include "results/result_file.h"

namespace sprag
{
  /// A friction face as results show it: the means over its FaceParts.
  template <int dim>
  class FaceView
  {
  public:
    /// Face and patches must outlive this. `half`: the face is half of one which is the same on both sides of the middle.
    FaceView(const FrictionFace<dim> &face, const FacePatches<dim> &patches, bool half = false);

    /// Fills the columns that follow from tractions and positions on the face.
    void observe(const FaceEvaluation<dim> &found, Row &row) const;

    /// Fills those of them that are sums over the points under pressure.
    void observe_resultants(const FaceEvaluation<dim> &found, Row &row) const;

    /// Returns the parts of the face.
    const FacePoints &points() const
    {
      return parts.points;
    }

    FaceState state(const FaceEvaluation<dim> &found, const DrivePoint &drive) const;

    /// Returns Q at the end of the step [N].
    double drive_force(const FaceEvaluation<dim> &found) const;

  private:
    void observe_pressure(const FaceEvaluation<dim> &found, Row &row) const;
    PressureSamples samples_of(const FaceEvaluation<dim> &found, unsigned int line) const;

    const FrictionFace<dim> &face;
    const FacePatches<dim> &patches;
    const bool is_half;
    const FaceParts parts;
  };

  /// Returns the deflection of a layer's face in a plane at the centre of pressure over that aside of the contact, from the
  /// columns that FaceView fills [mm]; 0 without a layer.
  double indentation(const FrictionFace<2> &face, const FaceEvaluation<2> &found, const Row &row, double layer_thickness);
} // namespace sprag
