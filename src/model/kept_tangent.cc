#include "model/kept_tangent.h"

#include "base/lanes.h"
#include "model/state_archive.h"

#include <algorithm>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Sets rows to minus the product of a matrix, most of which is 0, with others. The three rows of a node are alike in where
    /// they are not 0.
    SPRAG_FOR_ANY_PROCESSOR void subtract_product(const FullMatrix<double> &sparse, const RowsOfSixteen &rows,
                                                  RowsOfSixteen &result)
    {
      constexpr unsigned int n_alike = 3, n_together = 4; // whose sums stay in registers
      const auto n = static_cast<unsigned int>(sparse.n()), m = static_cast<unsigned int>(sparse.m());
      std::vector<std::array<float, n_alike>> factors(n);
      std::vector<unsigned int> columns(n);
      for (unsigned int i = 0; i < m; i += n_alike)
      {
        const double *const of_rows[n_alike] = { &sparse(i, 0), &sparse(std::min(i + 1, m - 1), 0),
                                                 &sparse(std::min(i + 2, m - 1), 0) };
        unsigned int filled                  = 0;
        for (unsigned int k = 0; k < n; ++k)
        {
          columns[filled] = k;
          for (unsigned int a = 0; a < n_alike; ++a)
            factors[filled][a] = static_cast<float>(of_rows[a][k]);
          filled += of_rows[0][k] != 0. || of_rows[1][k] != 0. || of_rows[2][k] != 0. ? 1 : 0;
        }
        for (std::size_t j = 0; j < rows.groups(); j += n_together)
        {
          Sixteen sums[n_alike][n_together];
          for (unsigned int f = 0; f < filled; ++f)
            for (unsigned int t = 0; t < n_together; ++t)
              for (unsigned int a = 0; a < n_alike; ++a)
                sums[a][t].values -= factors[f][a] * rows[columns[f]][j + t].values;
          for (unsigned int a = 0; a < n_alike && i + a < m; ++a)
            std::copy_n(sums[a], n_together, result[i + a] + j);
        }
      }
    }

    /// The transpose of 1 - A G.
    std::unique_ptr<LAPACKFullMatrix<float>> transposed_matrix(const KeptTangent &kept, const PortCompliance &compliance)
    {
      const auto n    = static_cast<unsigned int>(kept.ports.size());
      const auto rows = rows_among(kept.ports, compliance);
      RowsOfSixteen product(n, n);
      subtract_product(kept.matrix, rows, product);
      auto result = std::make_unique<LAPACKFullMatrix<float>>(n);
      for (unsigned int i = 0; i < n; ++i)
      {
        std::copy_n(&product(i, 0), n, &(*result)(0, i));
        (*result)(i, i) += 1.f;
      }
      return result;
    }
  } // namespace

  void visit(Archive &archive, std::shared_ptr<const KeptTangent> &kept)
  {
    bool there = kept != nullptr;
    archive(there);
    KeptTangent tangent;
    if (there && !archive.reads())
      tangent = *kept;
    archive(tangent.ports, tangent.matrix);
    if (archive.reads())
      kept = there ? std::make_shared<const KeptTangent>(std::move(tangent)) : nullptr;
  }

  bool KeptFactors::use(std::shared_ptr<const KeptTangent> kept, const PortCompliance &compliance, const StepWeights &weights)
  {
    constexpr std::size_t most = 3; // of the accepted step, and of those tried before and after it was halved
    const auto found           = std::find_if(known.begin(), known.end(),
                                              [&](const Factors &factors) {
                                      return factors.of == kept && factors.dt == weights.dt && factors.alpha_f == weights.alpha_f;
                                    });
    if (found != known.end())
    {
      std::rotate(found, found + 1, known.end());
      return true;
    }
    try
    {
      auto matrix = transposed_matrix(*kept, compliance);
      if (!kept->ports.empty())
        matrix->compute_lu_factorization();
      if (known.size() >= most)
        known.erase(known.begin());
      known.push_back({ std::move(kept), weights.dt, weights.alpha_f, std::move(matrix) });
      return true;
    }
    catch (const ExceptionBase &)
    {
      return false;
    }
  }

  const std::vector<unsigned int> &KeptFactors::ports() const
  {
    return known.back().of->ports;
  }

  void KeptFactors::solve(Vector<float> &forces) const
  {
    if (!ports().empty())
      known.back().matrix->solve(forces, true);
  }
} // namespace sprag
