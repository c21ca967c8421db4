#pragma once

#include "fe/face_contact.h"

namespace sprag
{
  /// A contact along a friction face as it is observed.
  struct FaceView
  {
    const ElasticBody<2> &body;
    const std::vector<FaceContact::PointState> &points; ///< near the obstacle, increasing
    const dealii::Vector<double> &nodal_displacement;   ///< two entries a face node, others may follow
    double duration;                                    ///< of the step; 0: no slip speed [s]
    double penetration;                                 ///< [mm]
  };

  FaceView view(const FaceContact &contact);

  /// Fills the columns that follow from tractions and positions on the friction face. `layer_thickness` [mm], 0 without a layer,
  /// tells what counts as indentation: the deflection of the face at the centre of pressure over that aside of the contact.
  void observe_face(const FaceView &contact, double layer_thickness, Row &row);

  FacePoints face_points(const ElasticBody<2> &body);

  FaceState face_state(const FaceView &contact, const DrivePoint &drive);
} // namespace sprag
