// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/sixteen.h"
#include "model/port_compliance.h"

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

namespace sprag
{
  /// Solves (1 - A G) f = r on some of the ports, A = df/dz, in single precision. Where a contact slides its forces follow the
  /// gaps and hardly anything else: few columns of A matter, the heavy ones H. By them alone
  ///   f = r + A_H s,   S s = (G r)_H,   S = 1 - (G A)_HH.
  /// That preconditions a method of minimal residuals (GCR: Eisenstat, Elman and Schultz 1983), which finds in a few repetitions
  /// what the other columns do. Where most columns matter all are heavy. Inside, forces are measured by what they move:
  /// otherwise the moment of a hub would hide forces on a face, and round-off of the one drown the others.
  class ReducedFactors
  {
  public:
    /// Throws an exception of deal.II where S is singular.
    ReducedFactors(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
                   const dealii::FullMatrix<double> &tangent);

    /// Adds f to forces, up to `left` of the size of r where that can be had.
    void add_solution(const dealii::Vector<double> &r, double left, dealii::Vector<double> &forces) const;

    /// Adds A z, in double precision.
    void add_forces(const dealii::Vector<double> &displacements, dealii::Vector<double> &forces) const;

    /// The sizes of forces and of displacements as they are measured here.
    double size(const dealii::Vector<double> &forces) const;
    double movement(const dealii::Vector<double> &displacements) const;

    /// The size of G f, in single precision.
    double movement_by(const dealii::Vector<double> &forces) const;

  private:
    using Places = std::vector<unsigned int>; ///< among the ports, increasing

    /// What is not 0 of some columns of the tangent, three rows at once: those of a node are alike in where they are not 0.
    struct Entries
    {
      /// Of the rows, and one that is 0.
      template <class Number>
      struct alignas(4 * sizeof(Number)) Four
      {
        Number values __attribute__((vector_size(4 * sizeof(Number))));
      };

      std::vector<std::size_t> begin{ 0 }; ///< of three rows, and beyond the last ones
      std::vector<unsigned int> column;
      std::vector<Four<double>> value;
      std::vector<Four<float>> rounded;

      void resize(std::size_t number);
    };

    unsigned int n;
    std::vector<double> units; ///< root of the compliance of each port
    RowsOfSixteen compliance;  ///< in these, as all that follows
    Places heavy, light;
    Entries of_heavy, of_light;              ///< columns of the tangent
    dealii::LAPACKFullMatrix<float> reduced; ///< factors of S

    void sort_columns(const dealii::FullMatrix<double> &tangent);
    void fill(const dealii::FullMatrix<double> &tangent);
    void reduce();
    dealii::Vector<float> displacements_at(const Places &places, const RowsOfSixteen &forces) const;
    void add_forces(float factor, const Places &places, const Entries &entries, const dealii::Vector<float> &displacements,
                    RowsOfSixteen &forces) const;
  };
} // namespace sprag
