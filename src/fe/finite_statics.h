#pragma once

#include "fe/elastic_body.h"
#include "fe/mumps.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <limits>
#include <vector>

namespace sprag
{
  /// Statics of a body at finite strain by Newton's method. A degree of freedom of the body is held at a given displacement, or
  /// follows a coordinate, alone or together with others. The body itself must hold none.
  class FiniteStatics
  {
  public:
    /// In place of a coordinate.
    static constexpr unsigned int held = std::numeric_limits<unsigned int>::max();

    /// `coordinate_of` each degree of freedom: 0, 1, ... without gaps, or `held`.
    FiniteStatics(const ElasticBody<2> &body, std::vector<unsigned int> coordinate_of);

    unsigned int n_coordinates() const;

    /// Brings `displacement` of all degrees of freedom into equilibrium with dead `loads` [N] on them, the held ones as they are
    /// given. Those that share a coordinate must begin alike. Throws AnalysisError where the iteration finds none.
    void balance(dealii::Vector<double> &displacement, const dealii::Vector<double> &loads);

    // Of all degrees of freedom at the displacement last balanced.

    /// Internal forces [N]; those of held ones are what holds them.
    const dealii::Vector<double> &forces() const;

    /// How displacements change with those of held ones (others in `of_held` count for nothing) and with the loads.
    dealii::Vector<double> response(const dealii::Vector<double> &of_held, const dealii::Vector<double> &of_loads) const;

    /// Tangent stiffness times a displacement.
    dealii::Vector<double> stiffness_product(const dealii::Vector<double> &displacement) const;

    /// On the coordinates.
    const dealii::PETScWrappers::SparseMatrix &stiffness() const;

    /// A matrix of the body, of the pattern that the body gives, on the coordinates.
    void reduce(const dealii::PETScWrappers::SparseMatrix &of_body, dealii::PETScWrappers::SparseMatrix &reduced) const;

    /// Displacement of all degrees of freedom, 0 where held, from the coordinates.
    dealii::Vector<double> expand(const dealii::Vector<double> &coordinates) const;

  private:
    void find_pattern();
    void linearise(const dealii::Vector<double> &displacement);
    dealii::Vector<double> collect(const dealii::Vector<double> &of_body) const;

    const ElasticBody<2> &body;
    const std::vector<unsigned int> coordinate_of;
    unsigned int n = 0;
    dealii::DynamicSparsityPattern pattern;
    std::vector<std::size_t> targets; ///< entry of the reduced matrix, or none, to which one of the body's is added
    dealii::PETScWrappers::SparseMatrix tangent;
    dealii::PETScWrappers::SparseMatrix reduced_tangent;
    dealii::Vector<double> internal;
    Mumps factors;
  };
} // namespace sprag
