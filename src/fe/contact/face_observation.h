#pragma once

#include "fe/body/elastic_body.h"
#include "fe/contact/face_contact_point.h"
#include "results/columns.h"
#include "results/result_file.h"

namespace sprag
{
  /// A contact along a friction face as it is observed.
  struct FaceView
  {
    const ElasticBody<2> &body;
    const std::vector<FacePointState<2>> &points;     ///< near the obstacle, increasing
    const dealii::Vector<double> &nodal_displacement; ///< two entries a face node, others may follow
    double duration;                                  ///< of the step; 0: no slip speed [s]
    double penetration;                               ///< [mm]
  };

  /// Fills the columns that follow from tractions and positions on the friction face. `layer_thickness` [mm], 0 without a layer,
  /// tells what counts as indentation: the deflection of the face at the centre of pressure over that aside of the contact.
  void observe_face(const FaceView &contact, double layer_thickness, Row &row);

  /// Those of them that are sums over the points under pressure.
  void observe_resultants(const FaceView &contact, Row &row);

  FacePoints face_points(const ElasticBody<2> &body);

  FaceState face_state(const FaceView &contact, const DrivePoint &drive);
} // namespace sprag
