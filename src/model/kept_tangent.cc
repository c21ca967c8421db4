#include "model/kept_tangent.h"

#include "base/lanes.h"
#include "model/state_archive.h"

#include <algorithm>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Sixteen numbers in single precision that are computed with at once, see Lanes.
    struct alignas(64) Sixteen
    {
      static constexpr unsigned int n = 16;

      float values __attribute__((vector_size(4 * n))) = {};
    };

    /// Rows of numbers in single precision.
    struct Rows
    {
      Rows(const unsigned int n_rows, const unsigned int n_columns)
          : stride((n_columns + Sixteen::n - 1) / Sixteen::n)
          , values(static_cast<std::size_t>(n_rows) * stride)
      {
      }

      Sixteen *operator[](const unsigned int row)
      {
        return &values[static_cast<std::size_t>(row) * stride];
      }

      float &operator()(const unsigned int row, const unsigned int column)
      {
        return reinterpret_cast<float *>((*this)[row])[column];
      }

      unsigned int stride;
      std::vector<Sixteen> values;
    };

    /// Subtracts the product of a matrix, most of which is 0, with rows from others.
    SPRAG_FOR_ANY_PROCESSOR void subtract_product(const FullMatrix<double> &sparse, Rows &rows, Rows &result)
    {
      for (unsigned int i = 0; i < sparse.m(); ++i)
        for (unsigned int k = 0; k < sparse.n(); ++k)
          if (const auto factor = static_cast<float>(sparse(i, k)); factor != 0.f)
          {
            const Sixteen *const from = rows[k];
            Sixteen *const to         = result[i];
            for (unsigned int j = 0; j < rows.stride; ++j)
              to[j].values -= factor * from[j].values;
          }
    }

    Rows compliance_among(const std::vector<unsigned int> &ports, const PortCompliance &compliance)
    {
      const auto n = static_cast<unsigned int>(ports.size());
      Rows result(n, n);
      for (const auto &block : compliance.blocks())
      {
        const auto [first, last] = block.places_among(ports);
        for (unsigned int k = first; k < last; ++k)
        {
          const double *const row = &(*block.matrix)(ports[k] - block.begin, 0);
          for (unsigned int j = first; j < last; ++j)
            result(k, j) = static_cast<float>(row[ports[j] - block.begin]);
        }
      }
      return result;
    }

    /// The transpose of 1 - A G.
    std::unique_ptr<LAPACKFullMatrix<float>> transposed_matrix(const KeptTangent &kept, const PortCompliance &compliance)
    {
      const auto n = static_cast<unsigned int>(kept.ports.size());
      auto rows    = compliance_among(kept.ports, compliance);
      Rows product(n, n);
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
