// SPDX-License-Identifier: GPL-3.0-only
#include "model/structure/beam.h"

#include "model/structure/lever_frame.h"
#include "scene/device.h"
#include "scene/lever_inertia.h"

#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Rotation of the pivot, then deflection and slope of nodes 1, 2, ... in axes that turn with it, node 0 being pinned; last
    /// the vibrations of a leaf spring with the hub held.
    struct BeamMatrices
    {
      LAPACKFullMatrix<double> stiffness;
      LAPACKFullMatrix<double> mass;
      Vector<double> momentum; ///< mass product with a unit deflection along eta everywhere
    };

    /// Coordinate of the slope (i = 1) or deflection (i = 0) of a node; -1 for the pinned one.
    int coordinate(const unsigned int node, const unsigned int i)
    {
      if (node == 0)
        return i == 1 ? 0 : -1;
      return static_cast<int>(2 * node - 1 + i);
    }

    void add_element(const unsigned int element, const double h, const double bending, const double rho, BeamMatrices &m)
    {
      const double k[4][4] = { { 12., 6. * h, -12., 6. * h },
                               { 6. * h, 4. * h * h, -6. * h, 2. * h * h },
                               { -12., -6. * h, 12., -6. * h },
                               { 6. * h, 2. * h * h, -6. * h, 4. * h * h } };
      const double c[4][4] = { { 156., 22. * h, 54., -13. * h },
                               { 22. * h, 4. * h * h, 13. * h, -3. * h * h },
                               { 54., 13. * h, 156., -22. * h },
                               { -13. * h, -3. * h * h, -22. * h, 4. * h * h } };
      const double p[4]    = { 0.5 * h, h * h / 12., 0.5 * h, -h * h / 12. };
      for (unsigned int a = 0; a < 4; ++a)
        if (const int i = coordinate(element + a / 2, a % 2); i >= 0)
        {
          m.momentum[static_cast<unsigned int>(i)] += rho * p[a];
          for (unsigned int b = 0; b < 4; ++b)
            if (const int j = coordinate(element + b / 2, b % 2); j >= 0)
            {
              m.stiffness(static_cast<unsigned int>(i), static_cast<unsigned int>(j)) += bending / (h * h * h) * k[a][b];
              m.mass(static_cast<unsigned int>(i), static_cast<unsigned int>(j)) += rho * h / 420. * c[a][b];
            }
        }
    }

    /// From deflections and slopes in axes at rest. A rotation does not bend the beam: between it and the others there is no
    /// stiffness, and not the remnants of differences either, which would drown the spring of a stiff lever.
    void use_turning_axes(const BeamMesh &mesh, const double spring_stiffness, BeamMatrices &m)
    {
      const unsigned int n = m.mass.m();
      Vector<double> turn(n);
      turn[0] = 1.;
      for (unsigned int node = 1; node <= mesh.elements; ++node)
      {
        turn[2 * node - 1] = node * mesh.element_length();
        turn[2 * node]     = 1.;
      }
      Vector<double> weighted(n);
      m.mass.vmult(weighted, turn);
      m.momentum[0]     = m.momentum * turn;
      m.mass(0, 0)      = weighted * turn;
      m.stiffness(0, 0) = spring_stiffness;
      for (unsigned int i = 1; i < n; ++i)
      {
        m.mass(i, 0) = m.mass(0, i) = weighted[i];
        m.stiffness(i, 0) = m.stiffness(0, i) = 0.;
      }
    }

    /// Inertia of what turns with the hub, and the leaf spring's own vibrations in the last coordinates.
    void attach_hub(const Device &device, const unsigned int first, BeamMatrices &m)
    {
      const auto &leaf = device.spring.behaviour;
      m.mass(0, 0) += device.lever.hub_inertia + leaf.inertia;
      for (unsigned int i = 0; i < leaf.modes.size(); ++i)
      {
        const unsigned int a = first + i;
        m.mass(a, 0) = m.mass(0, a) = leaf.modes[i].participation;
        m.mass(a, a)                = 1.;
        m.stiffness(a, a)           = leaf.modes[i].stiffness;
      }
    }

    BeamMatrices make_matrices(const Device &device, const BeamMesh &mesh)
    {
      const Lever &lever   = device.lever;
      const unsigned int n = 1 + mesh.n_dofs() + static_cast<unsigned int>(device.spring.behaviour.modes.size());
      const double rho     = mass_per_length(device);
      const double e_a     = neutral_axis_offset(device);
      const double modulus = device.analysis.plane == PlaneState::stress
                                 ? lever.young_modulus
                                 : lever.young_modulus / (1. - lever.poisson_ratio * lever.poisson_ratio);
      const double bending = modulus * lever.width * std::pow(lever.depth, 3) / 12.;

      BeamMatrices m{ LAPACKFullMatrix<double>(n), LAPACKFullMatrix<double>(n), Vector<double>(n) };
      m.stiffness = 0.;
      m.mass      = 0.;
      if (mesh.elements == 0)
      {
        m.mass(0, 0)      = moment_of_inertia(device) - lever.hub_inertia - device.spring.behaviour.inertia;
        m.momentum[0]     = 0.5 * rho * lever.length * lever.length + lever.tip_mass * lever.length;
        m.stiffness(0, 0) = device.spring.stiffness;
        attach_hub(device, 1, m);
        return m;
      }
      for (unsigned int element = 0; element < mesh.elements; ++element)
        add_element(element, mesh.element_length(), bending, rho, m);
      const auto tip = static_cast<unsigned int>(coordinate(mesh.elements, 0));
      m.mass(0, 0) += (rho * lever.length + lever.tip_mass) * e_a * e_a;
      m.mass(tip, tip) += lever.tip_mass;
      m.momentum[tip] += lever.tip_mass;
      attach_hub(device, 1 + mesh.n_dofs(), m);
      use_turning_axes(mesh, device.spring.stiffness, m);
      return m;
    }

    struct Modes
    {
      std::vector<double> stiffness;
      FullMatrix<double> shapes; ///< a column a mode, mass 1
    };

    double product(const LAPACKFullMatrix<double> &matrix, const Vector<double> &a, const Vector<double> &b)
    {
      Vector<double> weighted(a.size());
      matrix.vmult(weighted, b);
      return a * weighted;
    }

    /// The first mode by inverse iteration from its approximation, which has the round-off of the highest one. Returns its
    /// stiffness.
    double refine_first_mode(const BeamMatrices &m, Vector<double> &mode)
    {
      constexpr unsigned int most_iterations = 30;
      auto factor                            = m.stiffness;
      factor.set_property(LAPACKSupport::symmetric);
      factor.compute_cholesky_factorization();
      double stiffness = 0.;
      double before    = -1.;
      Vector<double> next(mode.size());
      for (unsigned int i = 0; i < most_iterations && stiffness != before; ++i)
      {
        before = stiffness;
        m.mass.vmult(next, mode);
        factor.solve(next);
        mode = next;
        mode /= next.linfty_norm();
        stiffness = product(m.stiffness, mode, mode) / product(m.mass, mode, mode);
      }
      return stiffness;
    }

    Modes solve_modes(const BeamMatrices &m)
    {
      const unsigned int n = m.mass.m();
      std::vector<Vector<double>> vectors(n);
      auto stiffness = m.stiffness;
      auto mass      = m.mass;
      stiffness.compute_generalized_eigenvalues_symmetric(mass, vectors);
      Modes modes;
      modes.shapes.reinit(n, n);
      for (unsigned int i = 0; i < n; ++i)
      {
        modes.stiffness.push_back(i == 0 ? refine_first_mode(m, vectors[0]) : stiffness.eigenvalue(i).real());
        if (i > 0)
          vectors[i].add(-product(m.mass, vectors[0], vectors[i]), vectors[0]);
        vectors[i] /= std::sqrt(product(m.mass, vectors[i], vectors[i]));
        for (unsigned int a = 0; a < n; ++a)
          modes.shapes(a, i) = vectors[i][a];
      }
      return modes;
    }

    double lever_mass(const Device &device)
    {
      return mass_per_length(device) * device.lever.length + device.lever.tip_mass;
    }

    /// Momentum of the leaf spring along xi (0) or eta (1) in a mode of the lever.
    double leaf_momentum(const Device &device, const BeamMesh &mesh, const FullMatrix<double> &modes, const unsigned int mode,
                         const unsigned int axis)
    {
      const auto &leaf = device.spring.behaviour;
      double sum       = leaf.momentum[axis] * modes(0, mode);
      for (unsigned int i = 0; i < leaf.modes.size(); ++i)
        sum += leaf.modes[i].momentum[axis] * modes(1 + mesh.n_dofs() + i, mode);
      return sum;
    }

    /// Rows: deflections and slopes in lever axes, rotation, momentum.
    void set_shapes(const Device &device, const BeamMesh &mesh, const BeamMatrices &m, const FullMatrix<double> &modes,
                    ModalData &data)
    {
      for (unsigned int i = 0; i < modes.n(); ++i)
      {
        const double rotation = modes(0, i);
        for (unsigned int a = 0; a < mesh.n_dofs(); ++a)
          data.shapes(a, i) = modes(1 + a, i);
        data.shapes(data.layout.rotation(), i) = rotation;
        if (!data.layout.sprung)
          continue;
        for (unsigned int a = 0; a < modes.m(); ++a)
          data.shapes(data.layout.momentum_eta(), i) += m.momentum[a] * modes(a, i);
        data.shapes(data.layout.momentum_eta(), i) += leaf_momentum(device, mesh, modes, i, 1);
        data.shapes(data.layout.momentum_xi(), i) =
            leaf_momentum(device, mesh, modes, i, 0) - neutral_axis_offset(device) * lever_mass(device) * rotation;
      }
    }

  } // namespace

  double carried_mass(const Device &device)
  {
    return lever_mass(device) + device.spring.behaviour.mass;
  }

  ModalData beam_modes(const Device &device, const BeamMesh &mesh)
  {
    const auto matrices  = make_matrices(device, mesh);
    const auto modes     = solve_modes(matrices);
    const auto constants = make_lever_dynamics(device, 0., carried_mass(device));
    ModalData data;
    data.layout    = { mesh.n_dofs(), constants.sprung };
    data.stiffness = modes.stiffness;
    data.shapes.reinit(data.layout.size(), modes.shapes.n() + (constants.sprung ? 1 : 0));
    set_shapes(device, mesh, matrices, modes.shapes, data);
    add_damping_and_support(constants, data);
    return data;
  }
} // namespace sprag
