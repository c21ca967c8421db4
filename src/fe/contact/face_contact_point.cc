// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/face_contact_point.h"
#include "laws/friction_law.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  FaceConfiguration configuration(const FaceProperties &properties, const dealii::Vector<double> &displacements, const double x)
  {
    const double inclination = properties.rest_inclination + displacements[properties.layout.rotation()];
    const double relative    = x - (properties.layout.sprung ? displacements[properties.layout.support()] : 0.);
    return { &displacements, inclination, relative, properties.centre(relative, inclination) };
  }

  StepContactLaw contact_law(const ContactPenalties &penalties, const FrictionLaw &friction)
  {
    StepContactLaw result;
    result.normal = { penalties.normal, 1. };
    result.slip   = slip_law(friction, penalties.tangential);
    return result;
  }

  StepTerms step_terms(const FaceProperties &properties, const InterfaceStep &step, const std::optional<StaticTerms> &statics)
  {
    const auto friction = statics ? statics->friction : step_friction(properties.friction, step.to.v);
    StepTerms result{ contact_law(properties.penalties, friction), step.to.surface - step.from.surface };
    result.law.weights = step.weights;
    if (statics)
    {
      result.law.balance    = ForceBalance::end;
      result.law.mode       = statics->mode;
      result.law.weights.dt = statics->duration;
      result.terms          = *statics;
    }
    return result;
  }

  template <int dim>
  SlipShift slip_shift(const FaceElements<dim> &face, const unsigned int point, const double slope, const double travel,
                       const double stiffness, const std::vector<ContactHistory> &history,
                       const std::function<double(unsigned int)> &slip_at_begin)
  {
    const auto &line = face.lines[face.point_lines[point]];
    const auto xi_at = [&](const unsigned int q) { return face.points[q].position[0]; };
    const double xi  = xi_at(point) - travel;
    if (travel == 0. || line.size() < 2 || xi < xi_at(line.front()) || xi > xi_at(line.back()))
      return {};
    const auto after     = std::upper_bound(line.begin() + 1, line.end() - 1, xi,
                                            [&](const double value, const unsigned int q) { return value < xi_at(q); });
    const unsigned int a = *(after - 1), b = *after;
    const double share        = (xi - xi_at(a)) / (xi_at(b) - xi_at(a));
    const auto between        = [share](const double first, const double last) { return (1. - share) * first + share * last; };
    const auto point_traction = [&](const unsigned int q)
    {
      const auto found = find_history(history, q);
      return found != history.end() && found->point == q ? found->traction[0] : 0.;
    };
    const double slip      = slip_at_begin(point) - between(slip_at_begin(a), slip_at_begin(b)) - travel * slope;
    const double unwinding = between(point_traction(a), point_traction(b)) - point_traction(point);
    return { slip, unwinding / stiffness, -travel };
  }

  template SlipShift slip_shift<2>(const FaceElements<2> &, unsigned int, double, double, double,
                                   const std::vector<ContactHistory> &, const std::function<double(unsigned int)> &);
  template SlipShift slip_shift<3>(const FaceElements<3> &, unsigned int, double, double, double,
                                   const std::vector<ContactHistory> &, const std::function<double(unsigned int)> &);
} // namespace sprag
