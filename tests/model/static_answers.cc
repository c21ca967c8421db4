// SPDX-License-Identifier: GPL-3.0-only
#include "model/static_answers.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Vector = dealii::Vector<double>;

  constexpr unsigned int n = 30;

  /// Symmetric, dominated by its diagonal.
  dealii::FullMatrix<double> compliance()
  {
    dealii::FullMatrix<double> result(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        result(i, j) = std::cos(0.3 * i) * std::cos(0.3 * j) + (i == j ? 2. : 0.);
    return result;
  }

  /// On the ports from `first` on.
  Vector forces_from(const unsigned int first, const double phase)
  {
    Vector result(n);
    for (unsigned int i = first; i < first + 12; ++i)
      result[i] = 1. + std::sin(phase + i);
    return result;
  }

  double form_of(const Vector &forces)
  {
    Vector moved(n);
    compliance().vmult(moved, forces);
    return moved * forces;
  }
} // namespace

// Displacements are asked for of fewer ports and of more, of forces that come back: always those of the whole product.
TEST(StaticAnswers, AreThoseOfTheWholeProductWhateverWasAskedBefore)
{
  const auto matrix = compliance();
  StaticAnswers answers;
  const std::vector<PortSelection> selections = { { 3, 4, 5, 20 }, all_ports(n + 2), { 4, 5 }, { 29, 31 } };
  for (unsigned int i = 0; i < 24; ++i)
  {
    const auto forces    = forces_from(i % 5, 0.1 * (i % 5));
    const auto &selected = selections[i % selections.size()];
    Vector expected(n), found(n + 2);
    matrix.vmult(expected, forces);
    found = 7.;
    answers.add_displacements(matrix, forces, 0.5, selected, found);
    for (const unsigned int port : selected)
      EXPECT_NEAR(found[port], 7. + (port < n ? 0.5 * expected[port] : 0.), 1e-13) << i << ", port " << port;
  }
}

// The work of a step and the energy at its end, whether the answers are known or not.
TEST(StaticAnswers, FormsAreTheSameWhetherAnswersAreKept)
{
  const auto matrix = compliance();
  const auto from = forces_from(2, 0.), to = forces_from(4, 0.02);
  Vector change = to;
  change -= from;
  StaticAnswers fresh, kept;
  Vector room(n);
  kept.add_displacements(matrix, from, 1., all_ports(n), room);
  for (StaticAnswers *answers : { &fresh, &kept })
  {
    EXPECT_NEAR(answers->form_of_change(matrix, from, to), form_of(change), 1e-12 * form_of(to));
    EXPECT_NEAR(answers->form(matrix, to), form_of(to), 1e-13 * form_of(to));
    EXPECT_NEAR(answers->form(matrix, from), form_of(from), 1e-13 * form_of(from));
  }
  EXPECT_EQ(fresh.form(matrix, Vector()), 0.);
  EXPECT_EQ(fresh.form_of_change(matrix, Vector(), Vector()), 0.);
}

// Ports that an answer did not ask for are found all the same.
TEST(StaticAnswers, AKeptAnswerOfFewPortsServesNoMore)
{
  const auto matrix = compliance();
  const auto from = forces_from(2, 0.), to = forces_from(4, 0.02);
  Vector change = to;
  change -= from;
  StaticAnswers answers;
  Vector room(n);
  answers.add_displacements(matrix, from, 1., { 2, 3, 4 }, room);
  EXPECT_NEAR(answers.form_of_change(matrix, from, to), form_of(change), 1e-12 * form_of(to));
}
