#include "fe/finite_statics.h"

#include "base/errors.h"

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
    find_pattern();
    reduced_tangent.reinit(pattern);
  }

  void FiniteStatics::find_pattern()
  {
    const Rows rows(tangent);
    pattern.reinit(n, n);
    for (PetscInt row = 0; row < rows.n; ++row)
      for (PetscInt a = rows.begin[row]; a < rows.begin[row + 1]; ++a)
        if (coordinate_of[row] != held && coordinate_of[rows.column[a]] != held)
          pattern.add(coordinate_of[row], coordinate_of[rows.column[a]]);

    Matrix reduced;
    reduced.reinit(pattern);
    const Rows reduced_rows(reduced);
    targets.assign(static_cast<std::size_t>(rows.begin[rows.n]), nowhere);
    for (PetscInt row = 0; row < rows.n; ++row)
      for (PetscInt a = rows.begin[row]; a < rows.begin[row + 1]; ++a)
      {
        const unsigned int i = coordinate_of[row];
        const unsigned int j = coordinate_of[rows.column[a]];
        if (i == held || j == held)
          continue;
        const auto *const begin = reduced_rows.column + reduced_rows.begin[i];
        const auto *const end   = reduced_rows.column + reduced_rows.begin[i + 1];
        targets[a] = static_cast<std::size_t>(std::lower_bound(begin, end, static_cast<PetscInt>(j)) - reduced_rows.column);
      }
  }

  unsigned int FiniteStatics::n_coordinates() const
  {
    return n;
  }

  void FiniteStatics::reduce(const Matrix &of_body, Matrix &reduced) const
  {
    if (reduced.m() != n)
      reduced.reinit(pattern);
    reduced = 0.;
    const Values from(of_body);
    const Values to(reduced);
    for (std::size_t a = 0; a < targets.size(); ++a)
      if (targets[a] != nowhere)
        to[targets[a]] += from[a];
  }

  Vector<double> FiniteStatics::collect(const Vector<double> &of_body) const
  {
    Vector<double> result(n);
    for (unsigned int dof = 0; dof < coordinate_of.size(); ++dof)
      if (coordinate_of[dof] != held)
        result[coordinate_of[dof]] += of_body[dof];
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
    reduce(tangent, reduced_tangent);
    factors.factorise(reduced_tangent);
  }

  void FiniteStatics::balance(Vector<double> &displacement, const Vector<double> &loads)
  {
    Vector<double> correction(n);
    for (unsigned int i = 0; i < most_iterations; ++i)
    {
      linearise(displacement);
      Vector<double> unbalanced = loads;
      unbalanced -= internal;
      const auto residual = collect(unbalanced);
      const double size   = internal.l2_norm() + loads.l2_norm();
      if (!std::isfinite(size))
        break;
      if (residual.l2_norm() <= tolerance * size)
        return;
      factors.solve(residual, correction);
      displacement += expand(correction);
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
    Vector<double> coordinates(n);
    factors.solve(collect(loads), coordinates);
    result += expand(coordinates);
    return result;
  }

  const Matrix &FiniteStatics::stiffness() const
  {
    return reduced_tangent;
  }
} // namespace sprag
