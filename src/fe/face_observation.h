#pragma once

#include "fe/face_contact.h"

namespace sprag
{
  /// Fills the columns that follow from tractions and positions on the friction face. `layer_thickness` [mm], 0 without a layer,
  /// tells what counts as indentation: the deflection of the face at the centre of pressure over that aside of the contact.
  void observe_face(const FaceContact &contact, double layer_thickness, Row &row);

  FacePoints face_points(const ElasticBody<2> &body);

  FaceState face_state(const FaceContact &contact, const DrivePoint &drive);
} // namespace sprag
