#include "base/neighbour.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <unistd.h>

namespace sprag
{
  namespace
  {
    /// OpenBLAS of Debian 12 (0.3.21) takes newer processors for old ones without AVX-512, which makes it half as fast. Later
    /// versions choose as here. What is set already is kept.
    void let_blas_use_avx512()
    {
#if defined(__x86_64__)
      if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512bw") &&
          __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
        ::setenv("OPENBLAS_CORETYPE", "SKYLAKEX", 0);
#endif
    }
  } // namespace

  void become_neighbour(const std::string &name, char **arguments)
  {
    const auto program = std::filesystem::read_symlink("/proc/self/exe").replace_filename(name);
    let_blas_use_avx512();
    ::execv(program.c_str(), arguments);
    throw std::runtime_error(program.string() + " cannot be run: " + std::strerror(errno));
  }
} // namespace sprag
