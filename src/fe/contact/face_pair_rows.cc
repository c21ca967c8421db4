// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/face_pair_rows.h"

#include <algorithm>

namespace sprag
{
  using dealii::FullMatrix;
  using dealii::outer_product;
  using dealii::Tensor;
  using dealii::Vector;

  namespace
  {
    // With e = y - c from the cylinder's centre to the lever, X(zeta) the cylinder's edge about its centre, e - X = gap n. A form
    // gives, in a variation of the coordinates, a number from
    //   w = (de - dX, two entries; dX', two; n . dX''), all of them at fixed zeta.
    constexpr unsigned int n_forms = 5;
    using Form                     = Tensor<1, n_forms>;
    using Bilinear                 = Tensor<2, n_forms>;

    Form apart(const Tensor<1, 2> &a)
    {
      return Form({ a[0], a[1], 0., 0., 0. });
    }

    Form slope(const Tensor<1, 2> &a)
    {
      return Form({ 0., 0., a[0], a[1], 0. });
    }

    Bilinear both(const Form &a, const Form &b)
    {
      return outer_product(a, b) + outer_product(b, a);
    }

    /// First variations at a Gauss point.
    struct Forms
    {
      explicit Forms(const PairPoint &p)
          : tau(apart(p.tangent))
          , gap(apart(p.normal))
          , along(slope(p.tangent))
          , across(slope(p.normal))
          , stiffness(p.speed * p.speed - p.gap * p.bend_across)
          , place((p.speed * tau + p.gap * across) / stiffness)
          , slip(p.speed * place)
          , speed(along + p.bend_along * place)
          , stretch(speed / p.arc_speed - (p.speed * p.arc_bend / (p.arc_speed * p.arc_speed)) * place)
      {
        bend[4] = 1.;
      }

      Form tau;         ///< t . (de - dX)
      Form gap;         ///< n . (de - dX)
      Form along;       ///< t . dX'
      Form across;      ///< n . dX'
      Form bend;        ///< n . dX''
      double stiffness; ///< D = |X'|^2 - gap n . X'': from (e - X) . X' = 0, D dzeta = |X'| tau + gap across
      Form place;       ///< dzeta
      Form slip;        ///< |X'| dzeta
      Form speed;       ///< d|X'|
      Form stretch;
    };

    /// d(gap form) = -1/D (n.X'' tau^2 + 2 |X'| tau across + gap across^2).
    Bilinear gap_curvature(const PairPoint &p, const Forms &f)
    {
      return (-1. / f.stiffness) * (p.bend_across * outer_product(f.tau, f.tau) + p.speed * both(f.tau, f.across) +
                                    p.gap * outer_product(f.across, f.across));
    }

    /// D d(dzeta) = 2 (along tau + across gap) + 2 (t.X'' tau + n.X'' gap + gap bend - 2 |X'| along) dzeta - 3 |X'| t.X''
    /// dzeta^2.
    Bilinear place_curvature(const PairPoint &p, const Forms &f)
    {
      const Form with_place = p.bend_along * f.tau + p.bend_across * f.gap + p.gap * f.bend - 2. * p.speed * f.along;
      return (1. / f.stiffness) * (both(f.along, f.tau) + both(f.across, f.gap) + both(with_place, f.place) -
                                   3. * p.speed * p.bend_along * outer_product(f.place, f.place));
    }

    /// d(|X'| dzeta), the derivative by the second index.
    Bilinear slip_gradient(const PairPoint &p, const Forms &f)
    {
      return p.speed * place_curvature(p, f) + outer_product(f.place, f.speed);
    }

    /// The coordinates of an element as a Gauss point sees them.
    class View
    {
    public:
      View(const PairConfiguration &at, const PairCoordinates &coordinates_)
          : coordinates(coordinates_)
          , by_theta({ -at.at.centre.eta, at.at.centre.xi })
          , by_x(at.drive)
          , twice_theta({ at.at.centre.xi, at.at.centre.eta })
          , theta_x({ at.drive[1], -at.drive[0] })
      {
      }

      void add(const PairPoint &p, const Form &form, const double factor, Vector<double> &row) const
      {
        Local values;
        spread(p, form, values);
        const auto at = indices(p);
        for (unsigned int i = 0; i < n_local; ++i)
          row[at[i]] += factor * values[i];
      }

      /// Adds a bilinear form by the columns of its entries, of which a coordinate sees some.
      void add(const PairPoint &p, const Bilinear &form, FullMatrix<double> &matrix) const
      {
        std::array<Local, n_forms> columns;
        for (unsigned int k = 0; k < n_forms; ++k)
        {
          Form column;
          for (unsigned int i = 0; i < n_forms; ++i)
            column[i] = form[i][k];
          spread(p, column, columns[k]);
        }
        const auto at = indices(p);
        for (unsigned int i = 0; i < n_local; ++i)
        {
          Form row;
          for (unsigned int k = 0; k < n_forms; ++k)
            row[k] = columns[k][i];
          Local spread_row;
          spread(p, row, spread_row);
          double *const target = &matrix(at[i], 0);
          for (unsigned int j = 0; j < n_local; ++j)
            target[at[j]] += spread_row[j];
        }
      }

      /// Returns the variation that a change of the coordinates is at the point.
      Form seen(const PairPoint &p, const Vector<double> &change) const
      {
        const auto at = indices(p);
        Tensor<1, 2> moved, slope_change, bend_change;
        for (unsigned int d = 0; d < 2; ++d)
        {
          moved[d] = by_theta[d] * change[at[theta_place]] + by_x[d] * change[at[theta_place + 1]];
          for (unsigned int a = 0; a < n_nodes; ++a)
          {
            const double cylinder_change = change[at[2 * (n_nodes + a) + d]];
            moved[d] += p.lever[a] * change[at[2 * a + d]] - p.cylinder.values[a] * cylinder_change;
            slope_change[d] += p.cylinder.slopes[a] * cylinder_change;
            bend_change[d] += p.cylinder.bends[a] * cylinder_change;
          }
        }
        return Form({ moved[0], moved[1], slope_change[0], slope_change[1], p.normal * bend_change });
      }

      /// change . d^2 e . change
      Tensor<1, 2> second(const Vector<double> &change) const
      {
        const double theta = change[coordinates.theta()];
        return theta * (theta * twice_theta + 2. * change[coordinates.x()] * theta_x);
      }

      /// Adds the movement of a cut along the lever's edge: from (y - X) . T = 0 at the vertex X, T the mean tangent there.
      void add_movement(const PairCut &cut, const double factor, Vector<double> &row) const
      {
        for (const auto *const side : { &cut.left, &cut.right })
          add(*side, apart(side->tangent) + (side->gap / side->speed) * slope(side->normal), -0.5 * factor / cut.speed, row);
      }

      /// Adds direction . d^2 e; theta and x move the centre.
      void add_second(const Tensor<1, 2> &direction, FullMatrix<double> &matrix) const
      {
        const unsigned int theta = coordinates.theta();
        matrix(theta, theta) += direction * twice_theta;
        matrix(theta, coordinates.x()) += direction * theta_x;
        matrix(coordinates.x(), theta) += direction * theta_x;
      }

    private:
      // Coordinates that a point sees: nodes of its two edges, theta, x. Edges of two nodes have a third one without any share;
      // numbers known in advance make loops fast.
      static constexpr unsigned int n_nodes     = 3;
      static constexpr unsigned int theta_place = 4 * n_nodes;
      static constexpr unsigned int n_local     = theta_place + 2;
      using Local                               = std::array<double, n_local>;

      std::array<unsigned int, n_local> indices(const PairPoint &p) const
      {
        std::array<unsigned int, n_local> result;
        result.fill(coordinates.theta());
        for (unsigned int i = 0; i < 2 * coordinates.n_lever; ++i)
          result[i] = i;
        const unsigned int first = 2 * (coordinates.n_lever + p.edge * coordinates.degree - coordinates.first);
        for (unsigned int i = 0; i < 2 * (coordinates.degree + 1); ++i)
          result[2 * n_nodes + i] = first + i;
        result[theta_place + 1] = coordinates.x();
        return result;
      }

      /// Writes a form over those coordinates.
      void spread(const PairPoint &p, const Form &form, Local &result) const
      {
        for (unsigned int a = 0; a < n_nodes; ++a)
          for (unsigned int d = 0; d < 2; ++d)
          {
            result[2 * a + d] = p.lever[a] * form[d];
            result[2 * (n_nodes + a) + d] =
                p.cylinder.slopes[a] * form[2 + d] - p.cylinder.values[a] * form[d] + p.cylinder.bends[a] * p.normal[d] * form[4];
          }
        result[theta_place]     = by_theta * Tensor<1, 2>({ form[0], form[1] });
        result[theta_place + 1] = by_x * Tensor<1, 2>({ form[0], form[1] });
      }

      const PairCoordinates &coordinates;
      const Tensor<1, 2> by_theta; ///< de/dtheta = -dc/dtheta
      const Tensor<1, 2> by_x;
      const Tensor<1, 2> twice_theta;
      const Tensor<1, 2> theta_x;
    };

    /// Slip over a cut by what its sides' places on the cylinder differ by.
    double cut_slip(const PairCut &cut)
    {
      return 0.5 * (cut.left.stretch() + cut.right.stretch()) * (cut.left.arc - cut.right.arc);
    }

    /// Derivatives at a cut: what the rows of both sides differ by goes over from one to the other as the cut moves.
    struct CutRows
    {
      CutRows(const View &view, const PairCut &cut, const unsigned int size, const double factor)
          : movement(size)
          , gap_jump(size)
          , slip_jump(size)
      {
        view.add_movement(cut, factor * cut.width, movement);
        for (const auto &[side, sign] : { std::pair{ &cut.left, 1. }, { &cut.right, -1. } })
        {
          const Forms forms(*side);
          view.add(*side, forms.gap, sign, gap_jump);
          view.add(*side, forms.slip, sign, slip_jump);
        }
      }

      Vector<double> movement;
      Vector<double> gap_jump;
      Vector<double> slip_jump; ///< the axes' turn apart
    };
  } // namespace

  void find_rows(const ElementFacets &element_facets, const Facet &facet, const PairConfiguration &at,
                 const PairCoordinates &coordinates, const double radius, FacetRows &rows)
  {
    for (auto *const row : { &rows.gap, &rows.arc, &rows.stretch, &rows.slip })
    {
      row->grow_or_shrink(coordinates.size());
      std::fill(row->begin(), row->end(), 0.);
    }
    const View view(at, coordinates);
    for (unsigned int q = facet.begin; q < facet.end; ++q)
    {
      const auto &p      = element_facets.points[q];
      const double share = p.weight / facet.weight;
      const Forms forms(p);
      view.add(p, forms.gap, share, rows.gap);
      view.add(p, forms.place, share * p.arc_speed, rows.arc);
      view.add(p, forms.stretch, share, rows.stretch);
      view.add(p, forms.slip, share, rows.slip);
      rows.slip[coordinates.theta()] -= share * p.stretch() * radius;
    }
    for (unsigned int c = facet.first_cut; c < facet.last_cut; ++c)
    {
      const auto &cut = element_facets.cuts[c];
      Vector<double> movement(coordinates.size());
      view.add_movement(cut, cut.width / facet.weight, movement);
      rows.arc.add(cut.left.arc - cut.right.arc, movement);
      rows.stretch.add(cut.left.stretch() - cut.right.stretch(), movement);
      rows.slip.add(cut_slip(cut), movement);
    }
  }

  FacetBends bends(const ElementFacets &element_facets, const Facet &facet, const PairConfiguration &at,
                   const PairCoordinates &coordinates, const double radius, const Vector<double> &change)
  {
    const View view(at, coordinates);
    const auto second = view.second(change);
    FacetBends result;
    for (unsigned int q = facet.begin; q < facet.end; ++q)
    {
      const auto &p      = element_facets.points[q];
      const double share = p.weight / facet.weight;
      const Forms forms(p);
      const Form seen = view.seen(p, change);
      result.gap += share * (seen * (gap_curvature(p, forms) * seen) + p.normal * second);
      result.slip +=
          share * (seen * (slip_gradient(p, forms) * seen) + p.speed * p.speed / forms.stiffness * (p.tangent * second) -
                   change[coordinates.theta()] * radius * (forms.stretch * seen));
    }
    for (unsigned int c = facet.first_cut; c < facet.last_cut; ++c)
    {
      const auto &cut = element_facets.cuts[c];
      const CutRows rows(view, cut, coordinates.size(), 1. / facet.weight);
      const double moved = rows.movement * change;
      const double turn  = radius * (cut.left.stretch() - cut.right.stretch()) * change[coordinates.theta()];
      result.gap += moved * (rows.gap_jump * change);
      result.slip += moved * (2. * (rows.slip_jump * change) - turn);
    }
    return result;
  }

  void add_curvature(const ElementFacets &element_facets, const Facet &facet, const PairConfiguration &at,
                     const PairCoordinates &coordinates, const double radius, const double normal, const double tangential,
                     FullMatrix<double> &matrix)
  {
    const View view(at, coordinates);
    Vector<double> by_stretch(coordinates.size());
    for (unsigned int q = facet.begin; q < facet.end; ++q)
    {
      const auto &p      = element_facets.points[q];
      const double share = p.weight / facet.weight;
      const Forms forms(p);
      view.add(p, share * (normal * gap_curvature(p, forms) + tangential * slip_gradient(p, forms)), matrix);
      view.add_second(share * (normal * p.normal + tangential * (p.speed * p.speed / forms.stiffness) * p.tangent), matrix);
      view.add(p, forms.stretch, -share * tangential * radius, by_stretch);
    }
    for (unsigned int j = 0; j < by_stretch.size(); ++j)
      matrix(coordinates.theta(), j) += by_stretch[j];
    for (unsigned int c = facet.first_cut; c < facet.last_cut; ++c)
    {
      const auto &cut = element_facets.cuts[c];
      CutRows rows(view, cut, coordinates.size(), 1. / facet.weight);
      for (unsigned int i = 0; i < coordinates.size(); ++i)
        for (unsigned int j = 0; j < coordinates.size(); ++j)
          matrix(i, j) += normal * rows.gap_jump[i] * rows.movement[j] +
                          tangential * (rows.slip_jump[i] * rows.movement[j] + rows.movement[i] * rows.slip_jump[j]);
      rows.movement *= tangential * radius * (cut.left.stretch() - cut.right.stretch());
      for (unsigned int j = 0; j < coordinates.size(); ++j)
        matrix(coordinates.theta(), j) -= rows.movement[j];
    }
  }

  void add_product(const double factor, const Vector<double> &row, const Vector<double> &column, FullMatrix<double> &matrix)
  {
    if (factor == 0.)
      return;
    for (unsigned int i = 0; i < row.size(); ++i)
      if (const double share = factor * row[i]; share != 0.)
        for (unsigned int j = 0; j < column.size(); ++j)
          matrix(i, j) += share * column[j];
  }
} // namespace sprag
