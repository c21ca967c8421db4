// SPDX-License-Identifier: GPL-3.0-only
#include "model/step/state_archive.h"

#include "model/step/stored_jacobian.h"

#include <algorithm>

namespace sprag
{
  void serialise(Archive &archive, dealii::Vector<double> &vector)
  {
    std::vector<double> values(vector.begin(), vector.end());
    archive(values);
    if (!archive.reads())
      return;
    vector.reinit(static_cast<unsigned int>(values.size()), true);
    std::copy(values.begin(), values.end(), vector.begin());
  }

  void serialise(Archive &archive, dealii::FullMatrix<double> &matrix)
  {
    std::size_t rows = matrix.m(), columns = matrix.n();
    archive(rows, columns);
    if (archive.reads())
      matrix.reinit(rows, columns);
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j)
        archive(matrix(i, j));
  }

  SPRAG_SERIALISE(Kinematic, position, velocity, acceleration)

  SPRAG_SERIALISE(DofLoads, dofs, values)

  void serialise(Archive &archive, InterfaceForces &forces)
  {
    archive(forces.dofs, forces.values, forces.tangent, forces.has_tangent);
  }

  SPRAG_SERIALISE(Motion, drive, coordinates, face_force, contact, forces, tangent)

  SPRAG_SERIALISE(State, drive, coordinates, contact, forces)
} // namespace sprag
