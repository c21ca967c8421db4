// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/lever_interface.h"

namespace sprag
{
  using namespace dealii;

  LeverInterface::LeverInterface(const ElasticBody<2> &body, const InertialMatrices &matrices, const bool sprung)
      : numbering{ static_cast<unsigned int>(surface_dofs(body).size()), sprung,
                   static_cast<unsigned int>(body.sensors().size()) }
      , n_lever(matrices.coordinates.size())
      , arms(numbering.surface)
  {
    for (const unsigned int dof : surface_dofs(body))
    {
      arms[static_cast<unsigned int>(coordinates.size())] = matrices.coordinates.arm(dof);
      coordinates.push_back(matrices.coordinates.mover(dof).coordinate);
    }
    for (const auto &sensor : body.sensors())
      sensors.push_back(matrices.coordinates.row(sensor));
    if (sprung)
      momentum = { { matrices.momentum[1], matrices.momentum[0] } };
  }

  Vector<double> LeverInterface::displacements(const Vector<double> &q) const
  {
    Vector<double> result(numbering.size());
    const double rotation = q[n_lever - 1];
    for (unsigned int i = 0; i < numbering.surface; ++i)
      result[i] = q[coordinates[i]] - rotation * arms[i];
    for (unsigned int s = 0; s < numbering.sensors; ++s)
      for (const auto &[i, weight] : sensors[s])
        result[numbering.sensor(s)] += weight * q[i];
    result[numbering.rotation()] = rotation;
    if (numbering.sprung)
    {
      const unsigned int momentum_dofs[] = { numbering.momentum_eta(), numbering.momentum_xi() };
      for (unsigned int d = 0; d < 2; ++d)
        for (unsigned int i = 0; i < n_lever; ++i)
          result[momentum_dofs[d]] += momentum[d][i] * q[i];
      result[numbering.support()] = q[n_lever];
    }
    return result;
  }

  void LeverInterface::add_force(const unsigned int dof, const double force, Vector<double> &forces) const
  {
    if (dof < numbering.surface)
    {
      forces[coordinates[dof]] += force;
      forces[n_lever - 1] -= arms[dof] * force;
    }
    else if (dof < numbering.rotation())
      for (const auto &[i, weight] : sensors[dof - numbering.surface])
        forces[i] += weight * force;
    else if (dof == numbering.rotation())
      forces[n_lever - 1] += force;
    else if (dof == numbering.support())
      forces[n_lever] += force;
    else
      for (unsigned int i = 0; i < n_lever; ++i)
        forces[i] += momentum[dof - numbering.momentum_eta()][i] * force;
  }

  std::vector<unsigned int> LeverInterface::face_coordinates() const
  {
    std::vector<unsigned int> result = coordinates;
    result.push_back(n_lever - 1);
    return result;
  }

  void LeverInterface::transform(FullMatrix<double> &compliance) const
  {
    const unsigned int rotation = numbering.surface;
    for (unsigned int j = 0; j <= rotation; ++j)
      for (unsigned int i = 0; i < rotation; ++i)
        compliance(i, j) -= arms[i] * compliance(rotation, j);
    for (unsigned int i = 0; i <= rotation; ++i)
      for (unsigned int j = 0; j < rotation; ++j)
        compliance(i, j) -= arms[j] * compliance(i, rotation);
  }
} // namespace sprag
