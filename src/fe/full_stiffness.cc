#include "fe/full_stiffness.h"

namespace sprag
{
  using namespace dealii;

  FullStiffness::FullStiffness(const ElasticBody<2> &body_)
      : body(body_)
  {
    body.reinit(matrix, 1);
  }

  unsigned int FullStiffness::index_of(const ContactForces &forces, const unsigned int i) const
  {
    return i / 2 < forces.nodes.size() ? body.friction_face().nodes[forces.nodes[i / 2]].dofs[i % 2] : body.n_dofs();
  }

  unsigned int FullStiffness::n_coordinates() const
  {
    return body.n_dofs() + 1;
  }

  Vector<double> FullStiffness::face_displacement(const Vector<double> &coordinates) const
  {
    const auto n_nodes = static_cast<unsigned int>(body.friction_face().nodes.size());
    Vector<double> result(2 * n_nodes);
    for (unsigned int i = 0; i < n_nodes; ++i)
      for (unsigned int d = 0; d < 2; ++d)
        result[2 * i + d] = coordinates[body.friction_face().nodes[i].dofs[d]];
    return result;
  }

  double FullStiffness::unbalance(const Vector<double> &coordinates, const FaceContact &contact, const HubSpring &spring)
  {
    const unsigned int rotation = body.n_dofs();
    Vector<double> internal(n_coordinates());
    matrix = 0.;
    body.assemble(coordinates, matrix, internal);
    internal[rotation] = spring.stiffness * (coordinates[rotation] - spring.rest);

    residual.reinit(n_coordinates());
    residual -= internal;
    const auto &forces = contact.forces();
    for (unsigned int i = 0; i < forces.values.size(); ++i)
      residual[index_of(forces, i)] += forces.values[i];
    return std::sqrt(residual.norm_sqr() + (1. / (spring.arm * spring.arm) - 1.) * residual[rotation] * residual[rotation]);
  }

  Vector<double> FullStiffness::correction(const FaceContact &contact, const HubSpring &spring)
  {
    const unsigned int rotation = body.n_dofs();
    matrix.add(rotation, rotation, spring.stiffness);
    const auto &forces = contact.forces();
    for (unsigned int i = 0; i < forces.values.size(); ++i)
      for (unsigned int j = 0; j < forces.values.size(); ++j)
        if (forces.tangent(i, j) != 0.)
          matrix.add(index_of(forces, i), index_of(forces, j), -forces.tangent(i, j));
    matrix.compress(VectorOperation::add);
    factors.factorise(matrix);
    Vector<double> result;
    factors.solve(residual, result);
    return result;
  }

  Vector<double> FullStiffness::body_displacement(const Vector<double> &coordinates, const FaceContact &) const
  {
    return Vector<double>(coordinates.begin(), coordinates.end() - 1);
  }
} // namespace sprag
