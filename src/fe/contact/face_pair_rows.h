// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/face_pair.h"

namespace sprag
{
  /// Derivatives of a facet's means by the coordinates of its element.
  struct FacetRows
  {
    dealii::Vector<double> gap;
    dealii::Vector<double> arc;
    dealii::Vector<double> stretch;

    /// Row of the slip: mean of stretch times (d arc - R d theta). The cylinder's material runs through its mesh as the axes
    /// turn. Minus this times the friction are forces, equal and opposite on both faces with their moments.
    dealii::Vector<double> slip;
  };

  /// `radius` R [mm]: how far the cylinder's surface runs in its axes as they turn by 1; 0 for a body that turns with them.
  void find_rows(const ElementFacets &element_facets, const Facet &facet, const PairConfiguration &at,
                 const PairCoordinates &coordinates, double radius, FacetRows &rows);

  /// change . d(rows.gap)/dq . change, and so for rows.slip.
  struct FacetBends
  {
    double gap  = 0.;
    double slip = 0.;
  };

  FacetBends bends(const ElementFacets &element_facets, const Facet &facet, const PairConfiguration &at,
                   const PairCoordinates &coordinates, double radius, const dealii::Vector<double> &change);

  /// Adds normal * d(rows.gap)/dq + tangential * d(rows.slip)/dq; the second is unsymmetric by the change of the stretch, and
  /// leaves out what kinks between the cylinder's edges times the gap are.
  void add_curvature(const ElementFacets &element_facets, const Facet &facet, const PairConfiguration &at,
                     const PairCoordinates &coordinates, double radius, double normal, double tangential,
                     dealii::FullMatrix<double> &matrix);

  /// Adds factor * row column^T; rows have few entries.
  void add_product(double factor, const dealii::Vector<double> &row, const dealii::Vector<double> &column,
                   dealii::FullMatrix<double> &matrix);
} // namespace sprag
