// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/port_forces.h"

#include <list>

namespace sprag
{
  /// Places of the entries that are not 0.
  std::vector<unsigned int> filled_places(const dealii::Vector<double> &sparse);

  /// f^T G f with a symmetric matrix, of which the rows and columns of forces that are not 0 are read; 0 where there are none.
  double quadratic_form(const dealii::FullMatrix<double> &symmetric, const dealii::Vector<double> &forces);

  /// Displacements G f of the first ports of a structure by static forces on them, of the last few f: where a step begins they
  /// are asked for more than once, and again for its works and energies. The compliance G is always the same. Forces may be
  /// empty, which move nothing.
  class StaticAnswers
  {
  public:
    /// Adds a share of G f to displacements of ports, of those that are selected.
    void add_displacements(const dealii::FullMatrix<double> &compliance, const dealii::Vector<double> &forces, double share,
                           const PortSelection &selected, dealii::Vector<double> &displacements);

    /// f^T G f.
    double form(const dealii::FullMatrix<double> &compliance, const dealii::Vector<double> &forces);

    /// The same of a change of forces. Where the answer to the first is known, that to the last is found for the same ports.
    double form_of_change(const dealii::FullMatrix<double> &compliance, const dealii::Vector<double> &from,
                          const dealii::Vector<double> &to);

  private:
    struct Answer
    {
      dealii::Vector<double> forces;
      PortSelection ports;
      dealii::Vector<double> displacements; ///< those of other ports mean nothing
    };

    const Answer &answer(const dealii::FullMatrix<double> &compliance, const dealii::Vector<double> &forces,
                         const PortSelection &selected);

    /// Returns one that knows these ports; null without.
    const Answer *kept(const dealii::Vector<double> &forces, const PortSelection &ports);

    std::list<Answer> answers; ///< that used last first
  };
} // namespace sprag
