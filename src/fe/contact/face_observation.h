#pragma once

#include "fe/body/elastic_body.h"
#include "fe/contact/face_evaluation.h"
#include "results/columns.h"
#include "results/result_file.h"

namespace sprag
{
  /// Fills the columns that follow from tractions and positions on the friction face. `layer_thickness` [mm], 0 without a layer,
  /// tells what counts as indentation: the deflection of the face at the centre of pressure over that aside of the contact.
  void observe_face(const ElasticBody<2> &body, const FaceEvaluation &found, double layer_thickness, Row &row);

  /// Fills those of them that are sums over the points under pressure.
  void observe_resultants(const ElasticBody<2> &body, const FaceEvaluation &found, Row &row);

  FacePoints face_points(const ElasticBody<2> &body);

  FaceState face_state(const ElasticBody<2> &body, const FaceEvaluation &found, const DrivePoint &drive);
} // namespace sprag
