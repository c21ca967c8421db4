// SPDX-License-Identifier: GPL-3.0-only
#include "fe/algebra/nested_dissection.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace sprag
{
  namespace
  {
    constexpr std::ptrdiff_t fewest_nodes = 12;   ///< a set of so few nodes is not halved further
    constexpr double same_place           = 1e-6; ///< unknowns closer than this belong to one node [mm]

    /// Orders unknowns by recursive halving: nodes that couple two halves are eliminated after both. Each set is cut across the
    /// axis that needs fewer such nodes.
    class Dissection
    {
    public:
      Dissection(const MatrixRows &matrix_, const std::vector<dealii::Point<2>> &places_)
          : matrix(matrix_)
          , places(places_)
      {
        for (unsigned int i = 0; i < places.size(); ++i)
        {
          if (i == 0 || places[i].distance(places[i - 1]) > same_place)
            first_unknown.push_back(i);
          node.push_back(static_cast<unsigned int>(first_unknown.size()) - 1);
        }
        nodes.resize(first_unknown.size());
        marks.resize(nodes.size());
        std::iota(nodes.begin(), nodes.end(), 0u);
        dissect(nodes.begin(), nodes.end());
      }

      std::vector<int> order() const
      {
        std::vector<int> result(places.size());
        int place = 0;
        for (const unsigned int i : nodes)
          for (unsigned int unknown = first_unknown[i]; unknown < places.size() && node[unknown] == i; ++unknown)
            result[unknown] = ++place;
        return result;
      }

    private:
      using Iterator = std::vector<unsigned int>::iterator;

      /// A cut of a set of nodes at a coordinate, and the number of nodes behind it that are coupled with those before it.
      struct Cut
      {
        unsigned int axis      = 0;
        double at              = 0.;
        std::ptrdiff_t coupled = std::numeric_limits<std::ptrdiff_t>::max();
      };

      void dissect(const Iterator begin, const Iterator end)
      {
        if (end - begin <= fewest_nodes)
          return;
        Cut best;
        for (const unsigned int axis : { 0u, 1u })
        {
          std::vector<double> coordinates(end - begin);
          std::transform(begin, end, coordinates.begin(), [&](const unsigned int i) { return coordinate(i, axis); });
          const auto middle = coordinates.begin() + (end - begin) / 2;
          std::nth_element(coordinates.begin(), middle, coordinates.end());
          // Corners of cells and their middle nodes lie in turn: cuts before and behind the next line of nodes are tried.
          double at = *middle;
          for (unsigned int i = 0; i < 2; ++i)
          {
            double next = std::numeric_limits<double>::max();
            for (auto c = middle; c != coordinates.end(); ++c)
              if (*c > at + same_place)
                next = std::min(next, *c);
            if (next == std::numeric_limits<double>::max())
              break;
            at                 = next;
            const auto coupled = count_coupled(begin, end, axis, at);
            if (coupled < best.coupled)
              best = { axis, at, coupled };
          }
        }
        if (best.coupled == std::numeric_limits<std::ptrdiff_t>::max())
          return;
        mark_before(begin, end, best.axis, best.at);
        const auto cut      = std::stable_partition(begin, end, [&](const unsigned int i) { return marks[i] == mark; });
        const auto coupling = std::stable_partition(cut, end, [&](const unsigned int i) { return !is_coupled(i); });
        dissect(begin, cut);
        dissect(cut, coupling);
      }

      double coordinate(const unsigned int i, const unsigned int axis) const
      {
        return places[first_unknown[i]][axis];
      }

      void mark_before(const Iterator begin, const Iterator end, const unsigned int axis, const double at)
      {
        ++mark;
        for (auto i = begin; i != end; ++i)
          if (coordinate(*i, axis) < at - same_place)
            marks[*i] = mark;
      }

      std::ptrdiff_t count_coupled(const Iterator begin, const Iterator end, const unsigned int axis, const double at)
      {
        mark_before(begin, end, axis, at);
        return std::count_if(begin, end, [&](const unsigned int i) { return marks[i] != mark && is_coupled(i); });
      }

      /// Returns whether a node is coupled with a marked one.
      bool is_coupled(const unsigned int i) const
      {
        const unsigned int unknown = first_unknown[i];
        return std::any_of(matrix.column + matrix.begin[unknown], matrix.column + matrix.begin[unknown + 1],
                           [&](const PetscInt j) { return marks[node[j]] == mark; });
      }

      const MatrixRows &matrix;
      const std::vector<dealii::Point<2>> &places;
      std::vector<unsigned int> first_unknown; ///< of each node, whose unknowns follow one another
      std::vector<unsigned int> node;          ///< of each unknown
      std::vector<unsigned int> nodes;         ///< in the order of elimination
      std::vector<unsigned int> marks;         ///< of the nodes: the last mark each was given
      unsigned int mark = 0;                   ///< the current one; nodes with an older one count as unmarked
    };
  } // namespace

  std::vector<int> nested_dissection(const MatrixRows &matrix, const std::vector<dealii::Point<2>> &places)
  {
    return Dissection(matrix, places).order();
  }
} // namespace sprag
