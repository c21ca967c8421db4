// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/algebra/mumps.h"
#include "fe/body/elastic_body.h"

namespace sprag
{
  /// Returns this rank's entries of the stiffness of a part of a body without load, with unit entries for held degrees of
  /// freedom. A part is given by a number for each degree of freedom, from 0, -1 where it is not of the part; no numbers stand
  /// for the whole body. To be called by all ranks.
  MatrixEntries assemble_stiffness(const ElasticBody<3> &body, const std::vector<int> &number_in_part);
} // namespace sprag
