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

  void serialise(Archive &archive, Kinematic &coordinates)
  {
    auto &[position, velocity, acceleration] = coordinates;
    archive(position, velocity, acceleration);
  }

  void serialise(Archive &archive, DofLoads &loads)
  {
    auto &[dofs, values] = loads;
    archive(dofs, values);
  }

  void serialise(Archive &archive, InterfaceForces &forces)
  {
    auto &[dofs, values, tangent, has_tangent] = forces;
    archive(dofs, values, tangent, has_tangent);
  }

  void serialise(Archive &archive, Motion &motion)
  {
    auto &[drive, coordinates, face_force, contact, forces, tangent] = motion;
    archive(drive, coordinates, face_force, contact, forces, tangent);
  }

  void serialise(Archive &archive, State &state)
  {
    auto &[drive, coordinates, contact, forces] = state;
    archive(drive, coordinates, contact, forces);
  }
} // namespace sprag
