#include "fe/full_stiffness.h"

namespace sprag
{
  using namespace dealii;

  FullStiffness::FullStiffness(const ElasticBody<2> &body_)
      : body(body_)
  {
    body.reinit(matrix, 1);
  }

  unsigned int FullStiffness::n_coordinates() const
  {
    return body.n_dofs() + 1;
  }

  Vector<double> FullStiffness::face_displacement(const Vector<double> &coordinates) const
  {
    const auto n_nodes = static_cast<unsigned int>(body.face_nodes().size());
    Vector<double> result(2 * n_nodes);
    for (unsigned int i = 0; i < n_nodes; ++i)
      for (unsigned int d = 0; d < 2; ++d)
        result[2 * i + d] = coordinates[body.face_nodes()[i].dofs[d]];
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
    residual[rotation] += contact.resultant().moment;
    for (std::size_t a = 0; a < contact.active().size(); ++a)
    {
      const auto &node = contact.nodes()[contact.active()[a]];
      for (unsigned int d = 0; d < 2; ++d)
        residual[node.dofs[d]] += node.weight * contact.responses()[a].force[d];
    }
    const double arm = body.face_nodes().back().position[0];
    return std::sqrt(residual.norm_sqr() + (1. / (arm * arm) - 1.) * residual[rotation] * residual[rotation]);
  }

  Vector<double> FullStiffness::correction(const FaceContact &contact, const HubSpring &spring)
  {
    const unsigned int rotation = body.n_dofs();
    matrix.add(rotation, rotation, spring.stiffness);
    for (std::size_t a = 0; a < contact.active().size(); ++a)
    {
      const auto &node                       = contact.nodes()[contact.active()[a]];
      const auto tangent                     = node.weight * contact.responses()[a].tangent;
      const std::array<unsigned int, 3> dofs = { { node.dofs[0], node.dofs[1], rotation } };
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          matrix.add(dofs[i], dofs[j], -tangent[i][j]);
    }
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
