// SPDX-License-Identifier: GPL-3.0-only
#include "fe/body/effective_bending.h"

#include "base/errors.h"
#include "base/least_squares.h"
#include "fe/body/end_face.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// A unit force along eta, spread evenly over the faces.
    Vector<double> unit_load(const ElasticBody<2> &body, const CellFaces<2> &faces)
    {
      const auto &fe      = body.dofs().get_fe();
      const double length = total_measure<2>(faces);
      FEFaceValues<2> values(body.cell_mapping(), fe, QGauss<1>(fe.degree + 1), update_values | update_JxW_values);
      Vector<double> load(body.n_dofs());
      for (const auto &[cell, f] : faces)
      {
        values.reinit(cell, f);
        const auto dofs = cell_dofs(cell);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (fe.system_to_component_index(i).first == 1 && !body.is_held(static_cast<unsigned int>(dofs[i])))
            for (const unsigned int q : values.quadrature_point_indices())
              load[dofs[i]] += values.shape_value(i, q) * values.JxW(q) / length;
      }
      return load;
    }
  } // namespace

  EffectiveBending effective_bending(const ElasticBody<2> &body, const double from, const double to)
  {
    const auto faces = end_face(body.dofs());
    if (faces.empty())
      throw InputError("the mesh has no straight end face across the lever, at which its bending could be told");
    Vector<double> displacement;
    body.factorised()->solve(unit_load(body, faces), displacement);

    const double L = faces.front().first->face(faces.front().second)->center()[0];
    std::vector<double> across_shape, across, along_shape, along;
    double e = 0.;
    for (const auto &node : body.friction_face().nodes)
      if (const double xi = node.position[0]; xi >= from && xi <= to)
      {
        e = node.position[1];
        across_shape.push_back(xi * xi * (3. * L - xi) / 6.);
        across.push_back(displacement[node.dofs[1]]);
        along_shape.push_back(xi * (2. * L - xi) / 2.);
        along.push_back(displacement[node.dofs[0]]);
      }
    const auto bent   = fitted_factor(across_shape, across);
    const auto turned = fitted_factor(along_shape, along);
    return { 1. / bent.factor, e + turned.factor / bent.factor, bent.error };
  }
} // namespace sprag
