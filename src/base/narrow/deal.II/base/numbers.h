// SPDX-License-Identifier: GPL-3.0-only
// Stands before deal.II's header of this name and leaves out ADOL-C, Sacado and Trilinos, which sprag does not use. They are a
// quarter of what a file with deal.II compiles. No class of deal.II has other members for it: they appear in overloads and in
// functions of their own.
#undef DEAL_II_WITH_ADOLC
#undef DEAL_II_TRILINOS_WITH_SACADO
#undef DEAL_II_WITH_TRILINOS
#include_next <deal.II/base/numbers.h>
