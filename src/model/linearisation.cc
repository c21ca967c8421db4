#include "model/linearisation.h"

namespace sprag
{
  namespace
  {
    dealii::FullMatrix<double> sum(const dealii::FullMatrix<double> &a, const dealii::FullMatrix<double> &b)
    {
      dealii::FullMatrix<double> result = a;
      result.add(1., b);
      return result;
    }
  } // namespace

  dealii::FullMatrix<double> PortPerturbation::stiffness() const
  {
    return sum(pressure, friction);
  }

  dealii::FullMatrix<double> PortPerturbation::damping() const
  {
    return sum(pressure_rate, friction_rate);
  }
} // namespace sprag
