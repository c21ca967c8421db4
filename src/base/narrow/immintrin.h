// SPDX-License-Identifier: GPL-3.0-only
// Stands before the compiler's header of this name. TBB includes it for _mm_pause() alone, and would bring all of AVX-512 into
// every file: a fifth of the text of deal.II's headers.
#pragma once
#include <xmmintrin.h>
