// SPDX-License-Identifier: GPL-3.0-only
#include "fe/solid/shared_factors.h"

#include "base/errors.h"

#include <cstring>
#include <utility>

namespace sprag
{
  namespace
  {
    // Jobs and settings of MUMPS by their numbers in its users' guide.
    constexpr int initialise = -1, terminate = -2, analyse = 1, decompose = 2, back_substitute = 3;

    constexpr int memory_relaxation = 30; ///< per cent
    constexpr int together          = 64; ///< right-hand sides: more gain little

    std::string reason_of(const int status)
    {
      if (status == -13 || status == -9)
        return "): there is not enough memory";
      return status == -90 ? "): the factors could not be written or read" : ")";
    }
  } // namespace

  SharedFactors::SharedFactors(const MPI_Comm ranks, const std::string &folder)
  {
    std::memset(&mumps, 0, sizeof mumps);
    mumps.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(ranks));
    mumps.par          = 1;
    mumps.sym          = 1;
    call(initialise, "set-up");
    const auto set = [this](const int setting, const int value) { mumps.icntl[setting - 1] = value; };
    for (const int output : { 1, 2, 3 })
      set(output, -1);
    set(4, 0);
    set(5, 0);
    set(7, 4); // PORD, which is best for long bodies
    set(14, memory_relaxation);
    set(15, -3); // ordered by nodes
    set(18, 3);  // entries where they are
    set(22, folder.empty() ? 0 : 1);
    set(27, together);
    set(28, 1);
    std::strncpy(mumps.ooc_tmpdir, folder.c_str(), sizeof mumps.ooc_tmpdir - 1);
    std::strncpy(mumps.ooc_prefix, "factors", sizeof mumps.ooc_prefix - 1);
  }

  SharedFactors::~SharedFactors()
  {
    mumps.job = terminate;
    dmumps_c(&mumps);
  }

  void SharedFactors::call(const int job, const char *what) const
  {
    mumps.job = job;
    dmumps_c(&mumps);
    const int status = mumps.infog[0];
    if (status < 0)
      throw AnalysisError(std::string("the direct solver failed in ") + what + " (MUMPS INFOG(1) = " + std::to_string(status) +
                          ", INFOG(2) = " + std::to_string(mumps.infog[1]) + reason_of(status));
  }

  void SharedFactors::factorise(SymmetricEntries entries)
  {
    n             = entries.size;
    mumps.n       = static_cast<MUMPS_INT>(n);
    mumps.nnz_loc = static_cast<MUMPS_INT8>(entries.row.size());
    mumps.irn_loc = entries.row.data();
    mumps.jcn_loc = entries.column.data();
    mumps.a_loc   = entries.value.data();
    call(analyse, "analysis");
    call(decompose, "factorisation");
    mumps.irn_loc = mumps.jcn_loc = nullptr;
    mumps.a_loc                   = nullptr;
  }

  void SharedFactors::solve(std::vector<double> &columns) const
  {
    mumps.icntl[20 - 1] = 0;
    mumps.rhs           = columns.data();
    mumps.lrhs          = static_cast<MUMPS_INT>(n);
    mumps.nrhs          = static_cast<MUMPS_INT>(columns.size() / n);
    call(back_substitute, "back-substitution");
  }

  std::vector<double> SharedFactors::solve(const SparseColumns &columns) const
  {
    auto begin = columns.begin, row = columns.row;
    auto values = columns.value;
    std::vector<double> result(static_cast<std::size_t>(n) * columns.size());
    mumps.icntl[20 - 1] = 1;
    mumps.nz_rhs        = static_cast<MUMPS_INT>(row.size());
    mumps.irhs_ptr      = begin.data();
    mumps.irhs_sparse   = row.data();
    mumps.rhs_sparse    = values.data();
    mumps.rhs           = result.data();
    mumps.lrhs          = static_cast<MUMPS_INT>(n);
    mumps.nrhs          = columns.size();
    call(back_substitute, "back-substitution");
    return result;
  }

  void SharedFactors::take_part() const
  {
    call(back_substitute, "back-substitution");
  }
} // namespace sprag
