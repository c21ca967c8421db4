// SPDX-License-Identifier: GPL-3.0-only
#include "model/static_answers.h"

#include "model/block_product.h"

#include <algorithm>

namespace sprag
{
  using namespace dealii;

  std::vector<unsigned int> filled_places(const Vector<double> &sparse)
  {
    std::vector<unsigned int> result;
    const auto *const end = sparse.end();
    for (const auto *value = sparse.begin(); value != end; ++value)
      if (*value != 0.)
        result.push_back(static_cast<unsigned int>(value - sparse.begin()));
    return result;
  }

  double quadratic_form(const FullMatrix<double> &symmetric, const Vector<double> &forces)
  {
    const auto filled = filled_places(forces);
    const auto ranges = ranges_of(filled.begin(), filled.end());
    Vector<double> product(forces.size());
    for (const auto &rows : ranges)
      for (const auto &columns : ranges)
        add_block_product(symmetric, rows, columns, forces.begin() + columns.begin, product.begin() + rows.begin);
    return product.size() > 0 ? product * forces : 0.;
  }

  const StaticAnswers::Answer *StaticAnswers::kept(const Vector<double> &forces, const PortSelection &ports)
  {
    const auto is_it = [&](const Answer &answer)
    { return answer.forces == forces && std::includes(answer.ports.begin(), answer.ports.end(), ports.begin(), ports.end()); };
    const auto found = std::find_if(answers.begin(), answers.end(), is_it);
    if (found == answers.end())
      return nullptr;
    answers.splice(answers.begin(), answers, found);
    return &answers.front();
  }

  const StaticAnswers::Answer &StaticAnswers::answer(const FullMatrix<double> &compliance, const Vector<double> &forces,
                                                     const PortSelection &selected)
  {
    PortSelection ports(selected.begin(), std::lower_bound(selected.begin(), selected.end(), forces.size()));
    if (const auto *const known = kept(forces, ports))
      return *known;
    Answer found{ forces, std::move(ports), Vector<double>(forces.size()) };
    const auto rows   = ranges_of(found.ports.begin(), found.ports.end());
    const auto loaded = filled_places(forces);
    for (const auto &columns : ranges_of(loaded.begin(), loaded.end()))
      for (const auto &row : rows)
        add_block_product(compliance, row, columns, forces.begin() + columns.begin, found.displacements.begin() + row.begin);
    constexpr std::size_t most = 3; // where a step begins, where it ends, and one that was tried in vain
    if (answers.size() == most)
      answers.pop_back();
    return answers.emplace_front(std::move(found));
  }

  void StaticAnswers::add_displacements(const FullMatrix<double> &compliance, const Vector<double> &forces, const double share,
                                        const PortSelection &selected, Vector<double> &displacements)
  {
    if (forces.size() == 0)
      return;
    const auto &found = answer(compliance, forces, selected);
    for (const unsigned int port : selected)
    {
      if (port >= forces.size())
        break;
      displacements[port] += share * found.displacements[port];
    }
  }

  double StaticAnswers::form(const FullMatrix<double> &compliance, const Vector<double> &forces)
  {
    const auto filled       = filled_places(forces);
    const auto *const known = kept(forces, filled);
    if (known == nullptr)
      return quadratic_form(compliance, forces);
    double result = 0.;
    for (const unsigned int i : filled)
      result += forces[i] * known->displacements[i];
    return result;
  }

  double StaticAnswers::form_of_change(const FullMatrix<double> &compliance, const Vector<double> &from, const Vector<double> &to)
  {
    Vector<double> change = to;
    if (change.size() > 0)
      change -= from;
    const auto filled       = filled_places(change);
    const auto *const begin = kept(from, filled);
    if (begin == nullptr)
      return quadratic_form(compliance, change);
    const auto &end = answer(compliance, to, begin->ports);
    double result   = 0.;
    for (const unsigned int i : filled)
      result += change[i] * (end.displacements[i] - begin->displacements[i]);
    return result;
  }
} // namespace sprag
