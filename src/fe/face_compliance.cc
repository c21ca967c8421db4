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
      for (const auto &node : body.face_nodes())
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
    return 2 * static_cast<unsigned int>(body.face_nodes().size()) + 1;
  }

  Vector<double> FaceCompliance::face_displacement(const Vector<double> &coordinates) const
  {
    return Vector<double>(coordinates.begin(), coordinates.end() - 1);
  }

  double FaceCompliance::unbalance(const Vector<double> &coordinates, const FaceContact &contact, const HubSpring &spring)
  {
    const unsigned int rotation = n_coordinates() - 1;
    mismatch                    = coordinates;
    mismatch *= -1.;
    for (std::size_t a = 0; a < contact.active().size(); ++a)
    {
      const unsigned int node = contact.active()[a];
      const auto load         = contact.nodes()[node].weight * contact.responses()[a].force;
      for (unsigned int d = 0; d < 2; ++d)
        for (unsigned int i = 0; i < rotation; ++i)
          mismatch[i] += compliance(2 * node + d, i) * load[d];
    }
    mismatch[rotation] = contact.resultant().moment / spring.stiffness - (coordinates[rotation] - spring.rest);

    const double arm = body.face_nodes().back().position[0];
    return std::sqrt(mismatch.norm_sqr() + (arm * arm - 1.) * mismatch[rotation] * mismatch[rotation]);
  }

  Vector<double> FaceCompliance::correction(const FaceContact &contact, const HubSpring &spring) const
  {
    const auto &active          = contact.active();
    const unsigned int n_active = 2 * static_cast<unsigned int>(active.size());
    const unsigned int rotation = n_coordinates() - 1;
    const auto row              = [&](const unsigned int i) { return 2 * active[i / 2] + i % 2; };

    // (1 - C df/du) du - C df/dtheta dtheta = C f - u on the active nodes; (1 - dm/dtheta / k) dtheta - dm/du / k du = rest.
    LAPACKFullMatrix<double> matrix(n_active + 1);
    Vector<double> solution(n_active + 1);
    for (unsigned int a = 0; a < active.size(); ++a)
    {
      const auto tangent = contact.nodes()[active[a]].weight * contact.responses()[a].tangent;
      for (unsigned int i = 0; i < n_active; ++i)
      {
        const double from_along  = compliance(row(i), 2 * active[a]);
        const double from_across = compliance(row(i), 2 * active[a] + 1);
        for (unsigned int d = 0; d < 2; ++d)
          matrix(i, 2 * a + d) = -(from_along * tangent[0][d] + from_across * tangent[1][d]);
        matrix(i, n_active) -= from_along * tangent[0][2] + from_across * tangent[1][2];
      }
      for (unsigned int d = 0; d < 2; ++d)
        matrix(n_active, 2 * a + d) = -tangent[2][d] / spring.stiffness;
      matrix(n_active, n_active) -= tangent[2][2] / spring.stiffness;
    }
    for (unsigned int i = 0; i <= n_active; ++i)
    {
      matrix(i, i) += 1.;
      solution[i] = mismatch[i < n_active ? row(i) : rotation];
    }
    matrix.compute_lu_factorization();
    matrix.solve(solution);

    Vector<double> result = mismatch;
    result[rotation]      = solution[n_active];
    for (unsigned int a = 0; a < active.size(); ++a)
    {
      const auto tangent = contact.nodes()[active[a]].weight * contact.responses()[a].tangent;
      const Tensor<1, 3> change({ solution[2 * a], solution[2 * a + 1], solution[n_active] });
      const auto load = tangent * change;
      for (unsigned int d = 0; d < 2; ++d)
        for (unsigned int i = 0; i < rotation; ++i)
          result[i] += compliance(2 * active[a] + d, i) * load[d];
    }
    return result;
  }

  Vector<double> FaceCompliance::body_displacement(const Vector<double> &, const FaceContact &contact) const
  {
    Vector<double> loads(body.n_dofs());
    for (std::size_t a = 0; a < contact.active().size(); ++a)
    {
      const auto &node = contact.nodes()[contact.active()[a]];
      for (unsigned int d = 0; d < 2; ++d)
        loads[node.dofs[d]] = node.weight * contact.responses()[a].force[d];
    }
    Vector<double> result;
    factors.solve(loads, result);
    return result;
  }
} // namespace sprag
