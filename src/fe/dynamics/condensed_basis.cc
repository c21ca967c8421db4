// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/condensed_basis.h"

#include "base/fingerprint.h"
#include "fe/dynamics/basis_file.h"
#include "model/step/state_archive.h"

#include <deal.II/base/timer.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    void add_mesh(const Triangulation<2> &triangulation, Fingerprint &key)
    {
      for (const auto &vertex : triangulation.get_vertices())
        for (unsigned int d = 0; d < 2; ++d)
          key.add(vertex[d]);
      for (const auto &cell : triangulation.active_cell_iterators())
      {
        key.add(cell->material_id());
        for (const unsigned int v : cell->vertex_indices())
          key.add(cell->vertex_index(v));
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            key.add(face->boundary_id());
      }
    }

    std::string make_key(const ElasticBody<2> &body, const BasisSettings &settings)
    {
      auto [modes, spring_stiffness, inertia, cache, origin] = settings;
      auto properties                                        = body.body_properties();
      auto program                                           = program_fingerprint();
      Archive content;
      content(program, origin, properties.degree, properties.plane, properties.width, properties.widths, properties.planes,
              properties.constants, inertia.densities, inertia.tip_mass, inertia.moment_of_inertia, inertia.source, inertia.hub,
              inertia.leaf.mass, inertia.leaf.inertia, inertia.leaf.momentum, inertia.leaf.modes, spring_stiffness, modes);
      for (auto &[type, middle, length, stiffness] : properties.connectors)
        content(type, middle, length, stiffness);
      Fingerprint key;
      key.add(content.bytes());
      add_mesh(body.dofs().get_triangulation(), key);
      return key.text();
    }

    /// Compliance of the surface with the hub held [mm/N].
    FullMatrix<double> surface_compliance(const ElasticBody<2> &body, const std::vector<unsigned int> &surface)
    {
      PETScWrappers::SparseMatrix stiffness;
      Vector<double> forces(body.n_dofs());
      body.reinit(stiffness);
      body.assemble(Vector<double>(body.n_dofs()), stiffness, forces);
      return inverse(Mumps().factorise_with_schur_complement(stiffness, surface), true);
    }
  } // namespace

  void serialise(Archive &archive, CondensedBasis &basis)
  {
    archive(basis.stiffness, basis.displacements, basis.rotation, static_cast<MassSums &>(basis), basis.shapes,
            basis.layer_stiffness, basis.face_compliance, basis.layout, basis.cpu_seconds);
  }

  Response make_response(const ElasticBody<2> &body)
  {
    return make_response(body.factorised());
  }

  CondensedBasis basis_on(const InterfaceLayout &layout, const LeverModes &modes, const std::vector<unsigned int> &surface,
                          const FullMatrix<double> &face_matrix, const SensorForces &sensors, const unsigned int surface_begin,
                          const std::array<double, 2> &slope_compliances, const double spring_stiffness)
  {
    const auto m = static_cast<unsigned int>(modes.stiffness.size()), n = layout.rotation() + 1;
    CondensedBasis result;
    result.layout                   = layout;
    result.stiffness                = modes.stiffness;
    result.layer_stiffness          = modes.layer_stiffness;
    static_cast<MassSums &>(result) = modes;

    auto &shapes = result.shapes;
    shapes.reinit(layout.dofs_per_lever(), m);
    for (unsigned int j = 0; j < m; ++j)
    {
      for (unsigned int i = 0; i < layout.surface; ++i)
        shapes(i, j) = modes.displacements[j][surface[i]];
      const auto compressions = sensors.compressions(modes.displacements[j]);
      for (unsigned int i = 0; i < layout.sensors; ++i)
        shapes(layout.sensor(i), j) = compressions[i];
      shapes(layout.rotation(), j)     = modes.rotation[j];
      shapes(layout.momentum_eta(), j) = modes.momentum[j][1];
      shapes(layout.momentum_xi(), j)  = modes.momentum[j][0];
    }

    // The static compliance less that of the modes.
    auto &compliance = result.face_compliance;
    compliance.reinit(n, n);
    compliance.fill(face_matrix);
    sensors.add_compliance(layout, surface_begin, compliance);
    for (unsigned int i = 0; i < layout.slopes; ++i)
      compliance(layout.slope(i), layout.slope(i)) = slope_compliances[i];
    compliance(layout.rotation(), layout.rotation()) = 1. / spring_stiffness;
    FullMatrix<double> at_interface(n, m), scaled(n, m);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < m; ++j)
      {
        at_interface(i, j) = shapes(i, j);
        scaled(i, j)       = -shapes(i, j) / modes.stiffness[j];
      }
    scaled.mTmult(compliance, at_interface, true);
    compliance.symmetrize();
    return result;
  }

  CondensedBasis make_basis(const ElasticBody<2> &body, const BasisSettings &settings)
  {
    const Timer timer;
    const auto response = make_response(body);
    const auto surface  = surface_dofs(body);
    auto modes          = lever_modes(body, response, settings.inertia, settings.spring_stiffness, settings.modes);
    const SensorForces sensors(body, response);
    const InterfaceLayout layout{ static_cast<unsigned int>(surface.size()), true, sensors.number() };
    auto basis = basis_on(layout, modes, surface, surface_compliance(body, surface), sensors, 0, {}, settings.spring_stiffness);
    basis.displacements = std::move(modes.displacements);
    basis.rotation      = std::move(modes.rotation);
    basis.cpu_seconds   = timer.cpu_time();
    return basis;
  }

  namespace
  {
    /// Returns the basis of bytes from the cache; none where its sizes are not those of the body. The checksum of a file does not
    /// tell who wrote it.
    std::optional<CondensedBasis> stored_basis(std::string bytes, const ElasticBody<2> &body)
    {
      CondensedBasis basis;
      Archive archive(std::move(bytes));
      archive(basis);
      const auto has_size = [](const FullMatrix<double> &matrix, const std::size_t rows, const std::size_t columns)
      { return matrix.m() == rows && matrix.n() == columns; };
      const auto m = basis.stiffness.size(), n = std::size_t(basis.layout.rotation()) + 1;
      const auto is_whole = [&](const Vector<double> &mode) { return mode.size() == body.n_dofs(); };
      const bool fits     = archive.at_end() && basis.layout.surface == surface_dofs(body).size() && basis.layout.levers == 1 &&
                        has_size(basis.shapes, basis.layout.dofs_per_lever(), m) && has_size(basis.layer_stiffness, m, m) &&
                        has_size(basis.face_compliance, n, n) && basis.rotation.size() == m && basis.displacements.size() == m &&
                        std::all_of(basis.displacements.begin(), basis.displacements.end(), is_whole);
      return fits ? std::optional(std::move(basis)) : std::nullopt;
    }
  } // namespace

  CondensedBasis condensed_basis(const ElasticBody<2> &body, const BasisSettings &settings)
  {
    const std::string folder = cache_folder(settings.cache);
    const std::string key    = make_key(body, settings);
    remove_abandoned(folder);
    if (auto bytes = load_basis(folder, key))
      if (auto stored = stored_basis(std::move(*bytes), body))
      {
        stored->from_cache = true;
        return *std::move(stored);
      }
    CondensedBasis basis = make_basis(body, settings);
    Archive archive;
    archive(basis);
    const std::string trouble = store_basis(folder, key, archive.bytes());
    if (!trouble.empty())
      basis.message = "the condensed basis was not stored in '" + folder + "': " + trouble;
    return basis;
  }

  CondensedBasis truncated(CondensedBasis basis, const unsigned int modes)
  {
    const auto all = static_cast<unsigned int>(basis.stiffness.size());
    if (modes >= all)
      return basis;
    for (unsigned int i = 0; i < basis.face_compliance.m(); ++i)
      for (unsigned int k = 0; k < basis.face_compliance.n(); ++k)
        for (unsigned int j = modes; j < all; ++j)
          basis.face_compliance(i, k) += basis.shapes(i, j) * basis.shapes(k, j) / basis.stiffness[j];
    basis.stiffness.resize(modes);
    const auto corner = [](const FullMatrix<double> &matrix, const std::size_t rows, const std::size_t columns)
    {
      FullMatrix<double> result(rows, columns);
      if (!matrix.empty() && !result.empty())
        result.fill(matrix);
      return result;
    };
    basis.shapes          = corner(basis.shapes, basis.shapes.m(), modes);
    basis.layer_stiffness = corner(basis.layer_stiffness, modes, modes);
    basis.displacements.resize(std::min<std::size_t>(modes, basis.displacements.size()));
    basis.rotation.resize(basis.displacements.size());
    return basis;
  }

  ModalData modal_data(const CondensedBasis &basis, const LeverDynamics &constants)
  {
    const auto n_lever   = static_cast<unsigned int>(basis.stiffness.size());
    const unsigned int n = n_lever + (constants.sprung ? 1 : 0);
    ModalData data;
    data.layout          = basis.layout;
    data.layout.sprung   = constants.sprung;
    data.stiffness       = basis.stiffness;
    data.face_compliance = basis.face_compliance;
    data.shapes.reinit(data.layout.size(), n);
    for (unsigned int i = 0; i < std::min(data.layout.size(), static_cast<unsigned int>(basis.shapes.m())); ++i)
      for (unsigned int j = 0; j < n_lever; ++j)
        data.shapes(i, j) = basis.shapes(i, j);

    data.layer_stiffness.reinit(n, n);
    if (n_lever > 0)
      data.layer_stiffness.fill(basis.layer_stiffness);
    add_damping_and_support(constants, data);
    return data;
  }

  Vector<double> condensed_displacement(const AffineConstraints<double> &held, const ModeShapes &modes,
                                        const std::vector<unsigned int> &surface, const Response &response, const Motion &motion)
  {
    // Rows and columns: dofs of the surface, of the sensors and the cylinder's axis, which are not loaded or move no mode, and
    // last the hub's rotation.
    const auto &forces  = motion.face_force;
    const bool has_face = forces.size() > 0;
    std::vector<double> loads(modes.displacements.front().size(), 0.);
    for (unsigned int dof = 0; dof < surface.size() && has_face; ++dof)
      if (!held.is_constrained(surface[dof]))
        loads[surface[dof]] = forces[dof];
    loads = response(std::move(loads));
    Vector<double> result(loads.begin(), loads.end());
    for (unsigned int j = 0; j < modes.stiffness.size(); ++j)
    {
      double work = has_face ? forces[forces.size() - 1] * modes.rotation[j] : 0.;
      for (unsigned int dof = 0; dof < surface.size() && has_face; ++dof)
        work += forces[dof] * modes.displacements[j][surface[dof]];
      result.add(motion.coordinates.position[j] - work / modes.stiffness[j], modes.displacements[j]);
    }
    return result;
  }
} // namespace sprag
