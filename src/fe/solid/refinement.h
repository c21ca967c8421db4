// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/solid/stiffness_product.h"

#include <functional>

namespace sprag
{
  /// Refines what factors of single precision find: the same factors answer what is left unbalanced, until that is small. It
  /// takes two solves to get to 1e-9 of the largest displacement, some more for bodies that are badly conditioned.
  ///
  /// Such factors miss 1e-6 of displacements, but 0.1 of the softest motions of a long lever, bending and twisting. A Galerkin
  /// projection on these motions, a few, finds their share of each step (deflation).
  class Refinement
  {
  public:
    /// Solves with the factors for some columns, one after another.
    using RoughSolve = std::function<std::vector<float>(const std::vector<double> &)>;

    /// See StiffnessProduct; its columns have `size` displacements.
    Refinement(const StiffnessSource &source, const std::vector<int> &number_in_part, const std::vector<Connector> &connectors,
               RoughSolve solve);

    /// Finds the softest motions from what the factors miss of the answers to some loads. Returns false where solutions take more
    /// than a few steps even so.
    bool find_soft_motions(const std::vector<double> &loads);

    /// Returns the solutions for some loads, whose rough ones are the `step`. Throws AnalysisError where they are not reached.
    std::vector<double> refined(std::vector<double> loads, std::vector<float> step) const;

  private:
    void add_soft_motion(const float *step);
    void find_missed();
    void begin_softly(const std::vector<double> &loads, std::vector<float> &step) const;
    void take_soft_part(const std::vector<double> &left, std::vector<float> &step) const;
    void add_motions(const std::vector<double> &motions, const std::vector<double> &amounts, std::vector<float> &step) const;
    unsigned int improve(std::vector<float> step, std::vector<double> &left, std::vector<double> &result) const;

    const unsigned int n;
    const StiffnessProduct stiffness;
    const RoughSolve solve;
    std::vector<double> soft;           ///< motions with twice the energy 1 [N mm], one after another
    std::vector<double> forces_of_soft; ///< stiffness times these
    std::vector<double> missed;         ///< what the factors miss of the motions
  };
} // namespace sprag
