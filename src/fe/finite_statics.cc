#include "fe/finite_statics.h"

#include "base/errors.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;
  using Matrix = PETScWrappers::SparseMatrix;

  namespace
  {
    /// Of the unbalanced over all forces: some hundred times what round-off leaves of a body that bends by several times its
    /// thickness.
    constexpr double tolerance = 1e-9;

    constexpr unsigned int most_iterations = 20;

    constexpr auto nowhere = std::numeric_limits<std::size_t>::max();

    /// Row beginnings and columns of a sequential matrix, in the order of its values.
    class Rows
    {
    public:
      explicit Rows(const Matrix &matrix_)
          : matrix(matrix_)
      {
        PetscBool found = PETSC_FALSE;
        if (MatGetRowIJ(matrix, 0, PETSC_FALSE, PETSC_FALSE, &n, &begin, &column, &found) != 0 || found == PETSC_FALSE)
          throw AnalysisError("the rows of a matrix cannot be read");
      }
      Rows(const Rows &)            = delete;
      Rows &operator=(const Rows &) = delete;
      ~Rows()
      {
        PetscBool found = PETSC_FALSE;
        MatRestoreRowIJ(matrix, 0, PETSC_FALSE, PETSC_FALSE, &n, &begin, &column, &found);
      }

      PetscInt n             = 0;
      const PetscInt *begin  = nullptr;
      const PetscInt *column = nullptr;

    private:
      const Mat matrix;
    };

    /// Entries of a sequential matrix.
    class Values
    {
    public:
      explicit Values(const Matrix &matrix_)
          : matrix(matrix_)
      {
        if (MatSeqAIJGetArray(matrix, &entries) != 0)
          throw AnalysisError("the entries of a matrix cannot be read");
      }
      Values(const Values &)            = delete;
      Values &operator=(const Values &) = delete;
      ~Values()
      {
        MatSeqAIJRestoreArray(matrix, &entries);
      }

      PetscScalar &operator[](const std::size_t i) const
      {
        return entries[i];
      }

    private:
      const Mat matrix;
      PetscScalar *entries = nullptr;
    };
  } // namespace

  FiniteStatics::FiniteStatics(const ElasticBody<2> &body_, std::vector<unsigned int> coordinate_of_)
      : body(body_)
      , coordinate_of(std::move(coordinate_of_))
      , internal(body.n_dofs())
  {
    for (const unsigned int coordinate : coordinate_of)
      if (coordinate != held)
        n = std::max(n, coordinate + 1);
    body.reinit(tangent, 0);
    arrange_band();
  }

  void FiniteStatics::arrange_band()
  {
    const Rows rows(tangent);
    DynamicSparsityPattern pattern(n, n);
    const auto for_all_entries = [&](const auto &act, const std::vector<unsigned int> &index_of)
    {
      for (PetscInt row = 0; row < rows.n; ++row)
        for (PetscInt a = rows.begin[row]; a < rows.begin[row + 1]; ++a)
          if (index_of[row] != held && index_of[rows.column[a]] != held)
            act(a, index_of[row], index_of[rows.column[a]]);
    };
    for_all_entries([&](PetscInt, const unsigned int i, const unsigned int j) { pattern.add(i, j); }, coordinate_of);

    std::vector<DynamicSparsityPattern::size_type> places(n);
    SparsityTools::reorder_Cuthill_McKee(pattern, places);
    place_of.assign(coordinate_of.size(), held);
    for (unsigned int dof = 0; dof < coordinate_of.size(); ++dof)
      if (coordinate_of[dof] != held)
        place_of[dof] = static_cast<unsigned int>(places[coordinate_of[dof]]);

    unsigned int width = 0;
    for_all_entries([&](PetscInt, const unsigned int i, const unsigned int j) { width = std::max(width, std::max(i, j) - i); },
                    place_of);
    band = BandFactors(n, width);
    targets.assign(static_cast<std::size_t>(rows.begin[rows.n]), nowhere);
    for_all_entries(
        [&](const PetscInt a, const unsigned int i, const unsigned int j)
        {
          if (i <= j)
            targets[a] = band.position(i, j);
        },
        place_of);
  }

  unsigned int FiniteStatics::n_coordinates() const
  {
    return n;
  }

  void FiniteStatics::reduce(const Matrix &of_body, Matrix &reduced) const
  {
    const Rows rows(of_body);
    const Values values(of_body);
    DynamicSparsityPattern pattern(n, n);
    for (const bool fill : { false, true })
    {
      if (fill)
        reduced.reinit(pattern);
      for (PetscInt row = 0; row < rows.n; ++row)
        for (PetscInt a = rows.begin[row]; a < rows.begin[row + 1]; ++a)
        {
          const unsigned int i = coordinate_of[row];
          const unsigned int j = coordinate_of[rows.column[a]];
          if (i != held && j != held && fill)
            reduced.add(i, j, values[a]);
          else if (i != held && j != held)
            pattern.add(i, j);
        }
    }
    reduced.compress(VectorOperation::add);
  }

  double FiniteStatics::norm_on_coordinates(const Vector<double> &forces) const
  {
    Vector<double> sums(n);
    for (unsigned int dof = 0; dof < coordinate_of.size(); ++dof)
      if (coordinate_of[dof] != held)
        sums[coordinate_of[dof]] += forces[dof];
    return sums.l2_norm();
  }

  Vector<double> FiniteStatics::solve(const Vector<double> &forces) const
  {
    Vector<double> placed(n);
    for (unsigned int dof = 0; dof < place_of.size(); ++dof)
      if (place_of[dof] != held)
        placed[place_of[dof]] += forces[dof];
    band.solve(placed);
    Vector<double> result(body.n_dofs());
    for (unsigned int dof = 0; dof < place_of.size(); ++dof)
      if (place_of[dof] != held)
        result[dof] = placed[place_of[dof]];
    return result;
  }

  Vector<double> FiniteStatics::expand(const Vector<double> &coordinates) const
  {
    Vector<double> result(body.n_dofs());
    for (unsigned int dof = 0; dof < coordinate_of.size(); ++dof)
      if (coordinate_of[dof] != held)
        result[dof] = coordinates[coordinate_of[dof]];
    return result;
  }

  void FiniteStatics::linearise(const Vector<double> &displacement)
  {
    tangent  = 0.;
    internal = 0.;
    body.assemble(displacement, tangent, internal);
    auto &entries = band.entries();
    std::fill(entries.begin(), entries.end(), 0.);
    const Values values(tangent);
    for (std::size_t a = 0; a < targets.size(); ++a)
      if (targets[a] != nowhere)
        entries[targets[a]] += values[a];
    negative_pivots = band.factorise();
  }

  void FiniteStatics::balance(Vector<double> &displacement, const Vector<double> &loads)
  {
    for (unsigned int i = 0; i < most_iterations; ++i)
    {
      linearise(displacement);
      Vector<double> unbalanced = loads;
      unbalanced -= internal;
      const double size = internal.l2_norm() + loads.l2_norm();
      if (!std::isfinite(size))
        break;
      if (norm_on_coordinates(unbalanced) <= tolerance * size)
        return;
      displacement += solve(unbalanced);
    }
    throw AnalysisError("Newton's method found no equilibrium of a body at finite strain in " + std::to_string(most_iterations) +
                        " iterations");
  }

  const Vector<double> &FiniteStatics::forces() const
  {
    return internal;
  }

  Vector<double> FiniteStatics::stiffness_product(const Vector<double> &displacement) const
  {
    const Rows rows(tangent);
    const Values values(tangent);
    Vector<double> result(body.n_dofs());
    for (PetscInt row = 0; row < rows.n; ++row)
      for (PetscInt a = rows.begin[row]; a < rows.begin[row + 1]; ++a)
        result[row] += values[a] * displacement[rows.column[a]];
    return result;
  }

  Vector<double> FiniteStatics::response(const Vector<double> &of_held, const Vector<double> &of_loads) const
  {
    Vector<double> result(body.n_dofs());
    for (unsigned int dof = 0; dof < coordinate_of.size(); ++dof)
      if (coordinate_of[dof] == held)
        result[dof] = of_held[dof];
    Vector<double> loads = of_loads;
    loads -= stiffness_product(result);
    result += solve(loads);
    return result;
  }

  bool FiniteStatics::is_stable() const
  {
    return negative_pivots == 0;
  }

  const Matrix &FiniteStatics::stiffness() const
  {
    return tangent;
  }
} // namespace sprag
