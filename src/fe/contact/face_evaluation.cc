// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/face_evaluation.h"

#include "base/errors.h"
#include "base/text.h"

namespace sprag
{
  template <int dim>
  void FaceEvaluation<dim>::begin(const dealii::Vector<double> &ports, const double at_x, const double of_duration)
  {
    displacement = ports;
    x            = at_x;
    duration     = of_duration;
    within_reach = true;
    sums         = {};
    points.clear();
  }

  template <int dim>
  std::string FaceEvaluation<dim>::objection() const
  {
    if (!sums.beyond_face)
      return {};
    return dim == 2 ? "the contact reaches the end of the cylinder's face"
                    : "the contact reaches the end of the friction face, or of the part of it that is looked at";
  }

  template <int dim>
  std::vector<PointMemory<dim - 1>> FaceEvaluation<dim>::memory() const
  {
    if (sums.beyond_face)
      throw AnalysisError(dim == 3 ? objection()
                                   : "the contact reaches the end of the part of the elastic cylinder's surface that is meshed "
                                     "to touch the lever, at x = " +
                                         rounded_text(x) +
                                         " mm: the cylinder yields or the lever bends too much. Try a larger Cylinder/Young "
                                         "modulus or a rigid cylinder.");
    std::vector<PointMemory<dim - 1>> result;
    for (const auto &point : points)
      if (point.pressure > 0.)
        result.push_back(point.memory);
    return result;
  }

  template struct FaceEvaluation<2>;
  template struct FaceEvaluation<3>;
} // namespace sprag
