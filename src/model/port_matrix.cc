// SPDX-License-Identifier: GPL-3.0-only
#include "model/port_matrix.h"

#include "model/port_forces.h"

namespace sprag
{
  using namespace dealii;

  namespace
  {
    FullMatrix<double> part(const FullMatrix<double> &matrix, const std::vector<unsigned int> &rows,
                            const std::vector<unsigned int> &columns)
    {
      if (rows.empty() || columns.empty())
        return FullMatrix<double>();
      FullMatrix<double> result(rows.size(), columns.size());
      result.extract_submatrix_from(matrix, rows, columns);
      return result;
    }

    std::vector<unsigned int> some_of(const std::vector<unsigned int> &ports, const std::vector<unsigned int> &places)
    {
      std::vector<unsigned int> result;
      for (const unsigned int place : places)
        result.push_back(ports[place]);
      return result;
    }
  } // namespace

  PortMatrix::PortMatrix(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
                         const FullMatrix<double> &tangent)
  {
    for (const auto &block : compliance.blocks())
    {
      const auto [first, last] = block.places_among(ports);
      for (unsigned int place = first; place < last; ++place)
        (block.matrix->m() == 1 ? border : inner).push_back(place);
    }
    if (!inner.empty())
      of_inner.emplace(compliance, some_of(ports, inner), PartOfTangent{ tangent, inner });
    if (!border.empty())
      make_border(compliance, ports, tangent);
  }

  void PortMatrix::make_border(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
                               const FullMatrix<double> &tangent)
  {
    const auto n = static_cast<unsigned int>(border.size()), n_inner = static_cast<unsigned int>(inner.size());
    const auto inner_ports = some_of(ports, inner);
    below                  = part(tangent, border, inner);
    aside.reinit(n_inner, n_inner > 0 ? n : 0);
    of_border.reinit(n);
    for (unsigned int b = 0; b < n; ++b)
    {
      const double own = compliance(ports[border[b]], ports[border[b]]);
      for (unsigned int i = 0; i < n_inner; ++i)
        below(b, i) *= -own;
      for (unsigned int c = 0; c < n; ++c)
        of_border(b, c) = (b == c ? 1. : 0.) - own * tangent(border[b], border[c]);
    }
    for (unsigned int b = 0; b < n && n_inner > 0; ++b)
    {
      Vector<double> forces(n_inner), displacements(compliance.size()), column(n_inner);
      for (unsigned int i = 0; i < n_inner; ++i)
        forces[i] = tangent(inner[i], border[b]);
      add_response(compliance, inner_ports, forces, inner_ports, displacements);
      for (unsigned int i = 0; i < n_inner; ++i)
        column[i] = -displacements[inner_ports[i]];
      of_inner->solve(column);
      for (unsigned int i = 0; i < n_inner; ++i)
        aside(i, b) = column[i];
      for (unsigned int c = 0; c < n; ++c)
        for (unsigned int i = 0; i < n_inner; ++i)
          of_border(c, b) -= below(c, i) * column[i];
    }
    of_border.compute_lu_factorization();
  }

  void PortMatrix::solve(Vector<double> &values) const
  {
    const auto n = static_cast<unsigned int>(border.size()), n_inner = static_cast<unsigned int>(inner.size());
    Vector<double> of_inside(n_inner), of_edge(n);
    for (unsigned int i = 0; i < n_inner; ++i)
      of_inside[i] = values[inner[i]];
    for (unsigned int b = 0; b < n; ++b)
      of_edge[b] = values[border[b]];
    if (n_inner > 0)
      of_inner->solve(of_inside);
    if (n > 0)
    {
      for (unsigned int b = 0; b < n; ++b)
        for (unsigned int i = 0; i < n_inner; ++i)
          of_edge[b] -= below(b, i) * of_inside[i];
      of_border.solve(of_edge);
      for (unsigned int i = 0; i < n_inner; ++i)
        for (unsigned int b = 0; b < n; ++b)
          of_inside[i] -= aside(i, b) * of_edge[b];
    }
    for (unsigned int i = 0; i < n_inner; ++i)
      values[inner[i]] = of_inside[i];
    for (unsigned int b = 0; b < n; ++b)
      values[border[b]] = of_edge[b];
  }

  double PortMatrix::determinant() const
  {
    return (of_inner ? of_inner->determinant() : 1.) * (border.empty() ? 1. : of_border.determinant());
  }

} // namespace sprag
