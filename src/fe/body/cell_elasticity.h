// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/body_properties.h"

#include <deal.II/base/point.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <memory>
#include <vector>

namespace sprag
{
  /// The polynomial constant + slope . (x - centre).
  template <int dim>
  struct LinearPolynomial
  {
    dealii::Point<dim> centre;
    double constant = 0.;
    dealii::Tensor<1, dim> slope;

    double operator()(const dealii::Point<dim> &point) const
    {
      return constant + slope * (point - centre);
    }
  };

  /// Polynomials in the coordinates x of the cell as it lies (those of the reference cell lose an order where cells are
  /// distorted: Arnold, Boffi and Falk 2002), of degree 0 or 1, orthonormal in the integral over the cell.
  template <int dim>
  class DilatationSpace
  {
  public:
    /// Enters the cell of `values`, which has points and weights.
    void reinit(const dealii::FEValues<dim> &values, unsigned int degree);

    unsigned int size() const
    {
      return static_cast<unsigned int>(functions.size());
    }

    /// Returns the value of a function at a point of the FEValues.
    double value(const unsigned int function, const unsigned int point) const
    {
      return at_points[function][point];
    }

    /// Returns the sum of the functions by `factors`.
    LinearPolynomial<dim> combined(const std::vector<double> &factors) const;

  private:
    std::vector<LinearPolynomial<dim>> functions;
    std::vector<std::vector<double>> at_points;
  };

  /// Returns whether cells of a material would lock: in plane strain, linear or neo-Hookean, nu > 0.4 (lambda > 4 mu).
  bool is_nearly_incompressible(const BodyProperties &properties, dealii::types::material_id id);

  /// Elastic energy, forces and stiffness of one cell of a body after the other.
  ///
  /// The energy is the integral of w(F) + lambda/2 theta^2, with the dilatation theta = tr eps (linear) or ln J (neo-Hookean) and
  /// the rest w(F) of the material's energy. In cells that is_nearly_incompressible() names, theta is projected
  /// onto the polynomials of degree p - 1, cell by cell: the mixed elements Q1-P0 (mean dilatation) and Q2-P1 of displacement and
  /// pressure p = lambda theta with the pressure eliminated, which do not lock as lambda grows (Simo, Taylor and Pister 1985;
  /// Boffi, Brezzi and Fortin, Mixed Finite Element Methods, 2013, section 8.6). Unknowns and couplings are those of the
  /// displacements; the stiffness is symmetric.
  template <int dim>
  class CellElasticity
  {
  public:
    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

    /// Keeps references to all that it is given.
    CellElasticity(const dealii::Mapping<dim> &mapping, const dealii::FiniteElement<dim> &fe, const BodyProperties &properties);
    ~CellElasticity();

    /// Enters a cell, not of the hub, with the displacements of its degrees of freedom.
    void reinit(const Cell &cell, const dealii::Vector<double> &displacement);

    /// Writes stiffness and internal forces [N] of the cell over what was there. Throws AnalysisError where an element turned
    /// inside out.
    void assemble(dealii::FullMatrix<double> &stiffness, dealii::Vector<double> &forces) const;

    /// Writes the internal forces alone.
    void find_forces(dealii::Vector<double> &forces) const;

    /// Returns the elastic energy of the cell [mJ].
    double energy() const;

    /// Returns the projected dilatation; it is there in nearly incompressible cells alone.
    LinearPolynomial<dim> dilatation() const
    {
      return space.combined(projected);
    }

  private:
    void project();
    Stress<dim> stress_at(unsigned int q) const;

    const BodyProperties &properties;
    /// It is large to instantiate, so only the source sees it whole.
    std::unique_ptr<dealii::FEValues<dim>> values;
    Lame constants = {};
    double width   = 0.;
    bool projects  = false;
    std::vector<dealii::Tensor<2, dim>> displacement_gradients; ///< at each point
    DilatationSpace<dim> space;
    std::vector<double> projected;      ///< dilatation, on the functions of `space`
    dealii::FullMatrix<double> changes; ///< derivative of `projected` by each displacement
  };
} // namespace sprag
