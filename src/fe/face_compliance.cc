#include "fe/face_compliance.h"

#include <deal.II/lac/lapack_full_matrix.h>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    std::vector<unsigned int> face_dofs(const ElasticBody<2> &body)
    {
      std::vector<unsigned int> result;
      for (const auto &node : body.friction_face().nodes)
        result.insert(result.end(), node.dofs.begin(), node.dofs.end());
      return result;
    }
  } // namespace

  FaceCompliance::FaceCompliance(const ElasticBody<2> &body_)
      : body(body_)
  {
    PETScWrappers::SparseMatrix stiffness;
    Vector<double> forces(body.n_dofs());
    body.reinit(stiffness, 0);
    body.assemble(Vector<double>(body.n_dofs()), stiffness, forces);
    const auto condensed = factors.factorise_with_schur_complement(stiffness, face_dofs(body));
    LAPACKFullMatrix<double> schur(n_coordinates() - 1);
    schur = condensed;
    schur.set_property(LAPACKSupport::symmetric);
    schur.invert();
    compliance.reinit(schur.m(), schur.n());
    compliance = schur;
    mismatch.reinit(n_coordinates());
  }

  unsigned int FaceCompliance::n_coordinates() const
  {
    return 2 * static_cast<unsigned int>(body.friction_face().nodes.size()) + 1;
  }

  Vector<double> FaceCompliance::face_displacement(const Vector<double> &coordinates) const
  {
    return Vector<double>(coordinates.begin(), coordinates.end() - 1);
  }

  void FaceCompliance::add_response(const std::vector<unsigned int> &nodes, const Vector<double> &loads,
                                    Vector<double> &displacement) const
  {
    for (unsigned int a = 0; a < 2 * nodes.size(); ++a)
    {
      const unsigned int loaded = 2 * nodes[a / 2] + a % 2;
      for (unsigned int i = 0; i + 1 < displacement.size(); ++i)
        displacement[i] += compliance(loaded, i) * loads[a];
    }
  }

  double FaceCompliance::unbalance(const Vector<double> &coordinates, const FaceContact &contact, const HubSpring &spring)
  {
    const auto &forces          = contact.forces();
    const unsigned int rotation = n_coordinates() - 1;
    mismatch                    = coordinates;
    mismatch *= -1.;
    add_response(forces.nodes, forces.values, mismatch);
    mismatch[rotation] = forces.values[forces.values.size() - 1] / spring.stiffness - (coordinates[rotation] - spring.rest);
    return std::sqrt(mismatch.norm_sqr() + (spring.arm * spring.arm - 1.) * mismatch[rotation] * mismatch[rotation]);
  }

  Vector<double> FaceCompliance::correction(const FaceContact &contact, const HubSpring &spring) const
  {
    const auto &forces          = contact.forces();
    const auto n_loaded         = 2 * static_cast<unsigned int>(forces.nodes.size());
    const unsigned int rotation = n_coordinates() - 1;
    const auto index            = [&](const unsigned int i) { return 2 * forces.nodes[i / 2] + i % 2; };

    // (1 - C df/du) du - C df/dtheta dtheta = C f - u on the loaded nodes; (1 - dm/dtheta / k) dtheta - dm/du / k du = rest.
    FullMatrix<double> loaded_compliance(n_loaded + 1, n_loaded + 1);
    for (unsigned int i = 0; i < n_loaded; ++i)
      for (unsigned int j = 0; j < n_loaded; ++j)
        loaded_compliance(i, j) = compliance(index(i), index(j));
    loaded_compliance(n_loaded, n_loaded) = 1. / spring.stiffness;
    FullMatrix<double> product(n_loaded + 1, n_loaded + 1);
    loaded_compliance.mmult(product, forces.tangent);

    LAPACKFullMatrix<double> matrix(n_loaded + 1);
    Vector<double> change(n_loaded + 1);
    for (unsigned int i = 0; i <= n_loaded; ++i)
    {
      for (unsigned int j = 0; j <= n_loaded; ++j)
        matrix(i, j) = (i == j ? 1. : 0.) - product(i, j);
      change[i] = mismatch[i < n_loaded ? index(i) : rotation];
    }
    matrix.compute_lu_factorization();
    matrix.solve(change);

    Vector<double> loads(n_loaded + 1);
    forces.tangent.vmult(loads, change);
    Vector<double> result = mismatch;
    result[rotation]      = change[n_loaded];
    add_response(forces.nodes, loads, result);
    return result;
  }

  Vector<double> FaceCompliance::body_displacement(const Vector<double> &, const FaceContact &contact) const
  {
    const auto &forces = contact.forces();
    Vector<double> loads(body.n_dofs());
    for (unsigned int i = 0; i < 2 * forces.nodes.size(); ++i)
      loads[body.friction_face().nodes[forces.nodes[i / 2]].dofs[i % 2]] = forces.values[i];
    Vector<double> result;
    factors.solve(loads, result);
    return result;
  }
} // namespace sprag
