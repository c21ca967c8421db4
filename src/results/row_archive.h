// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"
#include "results/columns.h"
#include "results/result_file.h"

namespace sprag
{
  void serialise(Archive &archive, Row &row);
  void serialise(Archive &archive, FaceState &face);
} // namespace sprag
