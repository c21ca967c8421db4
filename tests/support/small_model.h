// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/step/model.h"

namespace sprag
{
  /// A model without a body and a face, whose coordinates are lengths of the order of 1 mm and which objects to nothing.
  class SmallModel : public Model
  {
  public:
    double movement(const dealii::Vector<double> &correction) const override
    {
      return correction.linfty_norm();
    }

    double length_scale() const override
    {
      return 1.;
    }

    double penetration(const Evaluation &) const override
    {
      return 0.;
    }

    std::string check_validity(const State &, const Evaluation &) const override
    {
      return {};
    }

    FacePoints face_points() const override
    {
      return {};
    }

    FaceState face_state(const State &, const Evaluation &) const override
    {
      return {};
    }

    void serialise_history(Archive & /*archive*/) override
    {
    }
  };
} // namespace sprag
