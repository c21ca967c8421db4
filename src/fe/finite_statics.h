#pragma once

#include "fe/band_factors.h"
#include "fe/elastic_body.h"

#include <limits>
#include <vector>

namespace sprag
{
  /// Statics of a body at finite strain by Newton's method. A degree of freedom of the body is held at a given displacement, or
  /// follows a coordinate, alone or together with others. The body itself must hold none, and be slender: the tangent is
  /// factorised as a band.
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

    /// Whether the equilibrium last balanced is stable.
    bool is_stable() const;

    /// The tangent stiffness of the body, without regard to what holds it.
    const dealii::PETScWrappers::SparseMatrix &stiffness() const;

    /// A matrix of the body, on the coordinates.
    void reduce(const dealii::PETScWrappers::SparseMatrix &of_body, dealii::PETScWrappers::SparseMatrix &reduced) const;

    /// Displacement of all degrees of freedom, 0 where held, from the coordinates.
    dealii::Vector<double> expand(const dealii::Vector<double> &coordinates) const;

  private:
    void arrange_band();
    void linearise(const dealii::Vector<double> &displacement);
    double norm_on_coordinates(const dealii::Vector<double> &forces) const;
    dealii::Vector<double> solve(const dealii::Vector<double> &forces) const;

    const ElasticBody<2> &body;
    const std::vector<unsigned int> coordinate_of;
    unsigned int n = 0;
    dealii::PETScWrappers::SparseMatrix tangent;
    std::vector<unsigned int> place_of; ///< in the band, of each degree of freedom, or `held`
    std::vector<std::size_t> targets;   ///< entry of the band, or none, to which one of the tangent is added
    dealii::Vector<double> internal;
    BandFactors band;
    unsigned int negative_pivots = 0;
  };
} // namespace sprag
