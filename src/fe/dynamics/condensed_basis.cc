// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/condensed_basis.h"

#include "base/fingerprint.h"
#include "fe/dynamics/basis_file.h"

#include <deal.II/base/timer.h>

#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Version of the content of stored files and of the numbers in them.
    constexpr double format_version = 4.;

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

    void add_leaf(const LeafBehaviour &leaf, Fingerprint &key)
    {
      for (const double value : { leaf.mass, leaf.inertia, leaf.momentum[0], leaf.momentum[1] })
        key.add(value);
      for (const auto &mode : leaf.modes)
        for (const double value : { mode.stiffness, mode.participation, mode.momentum[0], mode.momentum[1] })
          key.add(value);
    }

    std::string key_of(const ElasticBody<2> &body, const BasisSettings &settings)
    {
      Fingerprint key;
      key.add(format_version);
      key.add(program_fingerprint());
      key.add(settings.origin);
      const auto &properties = body.body_properties();
      key.add(properties.degree);
      key.add(static_cast<double>(properties.plane));
      key.add(properties.width);
      for (const auto &[material, width] : properties.widths)
      {
        key.add(material);
        key.add(width);
      }
      for (const auto &[material, plane] : properties.planes)
      {
        key.add(material);
        key.add(static_cast<double>(plane));
      }
      for (const auto &connector : properties.connectors)
      {
        key.add(static_cast<double>(connector.type));
        key.add(connector.middle);
        key.add(connector.length);
        key.add(connector.stiffness);
      }
      for (const auto &[material, constants] : properties.constants)
      {
        key.add(material);
        key.add(constants.young_modulus);
        key.add(constants.poisson_ratio);
      }
      for (const auto &[material, density] : settings.inertia.densities)
      {
        key.add(material);
        key.add(density);
      }
      key.add(settings.inertia.tip_mass);
      key.add(settings.inertia.moment_of_inertia);
      key.add(static_cast<double>(settings.inertia.source));
      key.add(settings.inertia.hub);
      add_leaf(settings.inertia.leaf, key);
      key.add(settings.spring_stiffness);
      key.add(settings.modes);
      add_mesh(body.dofs().get_triangulation(), key);
      return key.text();
    }

    std::vector<double> flat(const FullMatrix<double> &matrix)
    {
      std::vector<double> result;
      result.reserve(matrix.m() * matrix.n());
      for (unsigned int i = 0; i < matrix.m(); ++i)
        result.insert(result.end(), &matrix(i, 0), &matrix(i, 0) + matrix.n());
      return result;
    }

    std::vector<double> upper_triangle(const FullMatrix<double> &matrix)
    {
      std::vector<double> result;
      for (unsigned int i = 0; i < matrix.m(); ++i)
        result.insert(result.end(), &matrix(i, i), &matrix(i, 0) + matrix.n());
      return result;
    }

    /// False if the sizes do not fit.
    bool unpack(const std::vector<double> &values, const unsigned int rows, const unsigned int columns,
                FullMatrix<double> &matrix)
    {
      if (values.size() != std::size_t(rows) * columns)
        return false;
      matrix.reinit(rows, columns);
      matrix.fill(values.data());
      return true;
    }

    bool unpack_symmetric(const std::vector<double> &values, const unsigned int n, FullMatrix<double> &matrix)
    {
      if (values.size() != std::size_t(n) * (n + 1) / 2)
        return false;
      matrix.reinit(n, n);
      auto value = values.begin();
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = i; j < n; ++j)
          matrix(i, j) = matrix(j, i) = *value++;
      return true;
    }

    StoredArrays arrays_of(const CondensedBasis &basis)
    {
      return { { "stiffness", basis.stiffness },
               { "shapes", flat(basis.shapes) },
               { "layer_stiffness", flat(basis.layer_stiffness) },
               { "face_compliance", upper_triangle(basis.face_compliance) },
               { "coordinate_shapes", flat(basis.coordinate_shapes) },
               { "scalars", { basis.density_factor, basis.lever_mass, basis.moment_of_inertia, basis.cpu_seconds } } };
    }

    std::optional<CondensedBasis> basis_of(StoredArrays arrays, const unsigned int n_face, const unsigned int n_coordinates)
    {
      CondensedBasis basis;
      basis.stiffness     = arrays["stiffness"];
      const auto m        = static_cast<unsigned int>(basis.stiffness.size());
      const auto &scalars = arrays["scalars"];
      if (m == 0 || scalars.size() != 4 || !unpack(arrays["shapes"], n_face + 2, m, basis.shapes) ||
          !unpack(arrays["layer_stiffness"], m, m, basis.layer_stiffness) ||
          !unpack_symmetric(arrays["face_compliance"], n_face, basis.face_compliance) ||
          !unpack(arrays["coordinate_shapes"], m, n_coordinates, basis.coordinate_shapes))
        return {};
      basis.density_factor    = scalars[0];
      basis.lever_mass        = scalars[1];
      basis.moment_of_inertia = scalars[2];
      basis.cpu_seconds       = scalars[3];
      basis.from_cache        = true;
      return basis;
    }

    void set_modes(const FreeModes &modes, const InertialMatrices &matrices, const LeverPorts &ports, CondensedBasis &basis)
    {
      const auto m         = static_cast<unsigned int>(modes.shapes.size());
      const unsigned int n = matrices.coordinates.size();
      const CompressedRows layer(matrices.layer_stiffness);
      basis.stiffness = modes.stiffness;
      basis.shapes.reinit(ports.layout().support(), m);
      basis.layer_stiffness.reinit(m, m);
      basis.coordinate_shapes.reinit(m, n);
      for (unsigned int j = 0; j < m; ++j)
      {
        Vector<double> with_support(ports.n_coordinates());
        Vector<double> layer_forces(n);
        std::copy(modes.shapes[j].begin(), modes.shapes[j].end(), with_support.begin());
        std::copy(modes.shapes[j].begin(), modes.shapes[j].end(), &basis.coordinate_shapes(j, 0));
        const auto displacements = ports.displacements(with_support);
        for (unsigned int i = 0; i < basis.shapes.m(); ++i)
          basis.shapes(i, j) = displacements[i];
        layer.multiply<1>({ { &modes.shapes[j] } }, { { &layer_forces } });
        for (unsigned int i = 0; i < m; ++i)
          basis.layer_stiffness(i, j) = modes.shapes[i] * layer_forces;
      }
    }

    /// Static compliance less that of the modes kept.
    void set_face_compliance(const InertialMatrices &matrices, const LeverPorts &ports, const double spring_stiffness,
                             CondensedBasis &basis)
    {
      const ModalDamping none;
      const EffectiveSystem statics(matrices, ports, none, { 0., 1., 0., spring_stiffness }, 0.);
      const auto whole     = statics.port_compliance();
      const unsigned int n = ports.layout().rotation() + 1;
      const auto m         = static_cast<unsigned int>(basis.stiffness.size());
      FullMatrix<double> at_face(n, m), scaled(n, m);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < m; ++j)
        {
          at_face(i, j) = basis.shapes(i, j);
          scaled(i, j)  = basis.shapes(i, j) / basis.stiffness[j];
        }
      basis.face_compliance.reinit(n, n);
      scaled.mTmult(basis.face_compliance, at_face);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = i; j < n; ++j)
        {
          const double of_modes       = 0.5 * (basis.face_compliance(i, j) + basis.face_compliance(j, i));
          basis.face_compliance(i, j) = basis.face_compliance(j, i) = whole(i, j) - of_modes;
        }
    }
  } // namespace

  CondensedBasis make_basis(const ElasticBody<2> &body, const BasisSettings &settings)
  {
    const Timer timer;
    CondensedBasis basis;
    const InertialMatrices matrices(body, settings.inertia);
    const LeverPorts ports(body, matrices, true);
    PETScWrappers::SparseMatrix stiffness;
    matrices.sum({ 0., 1., 0., settings.spring_stiffness }, stiffness);
    set_modes(free_modes(stiffness, matrices.mass, settings.modes), matrices, ports, basis);
    set_face_compliance(matrices, ports, settings.spring_stiffness, basis);
    basis.density_factor    = matrices.density_factor;
    basis.lever_mass        = matrices.total_mass;
    basis.moment_of_inertia = matrices.moment_of_inertia;
    basis.sensors           = ports.layout().sensors;
    basis.cpu_seconds       = timer.cpu_time();
    return basis;
  }

  CondensedBasis condensed_basis(const ElasticBody<2> &body, const BasisSettings &settings)
  {
    const std::string folder = cache_folder(settings.cache);
    const std::string key    = key_of(body, settings);
    remove_abandoned(folder);
    if (auto stored = load_arrays(folder, key))
    {
      const auto n_attached = static_cast<unsigned int>(settings.inertia.leaf.modes.size());
      const auto n_sensors  = static_cast<unsigned int>(body.sensors().size());
      const auto n_face     = number_of_surface_ports(body) + n_sensors + 1;
      if (auto basis = basis_of(std::move(*stored), n_face, TotalCoordinates(body, n_attached).size()))
      {
        basis->sensors = n_sensors;
        return *basis;
      }
    }
    CondensedBasis basis      = make_basis(body, settings);
    const std::string trouble = store_arrays(folder, key, arrays_of(basis));
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
    basis.shapes            = corner(basis.shapes, basis.shapes.m(), modes);
    basis.layer_stiffness   = corner(basis.layer_stiffness, modes, modes);
    basis.coordinate_shapes = corner(basis.coordinate_shapes, modes, basis.coordinate_shapes.n());
    return basis;
  }

  ModalData modal_data(const CondensedBasis &basis, const LeverDynamics &constants)
  {
    const auto n_lever   = static_cast<unsigned int>(basis.stiffness.size());
    const unsigned int n = n_lever + (constants.sprung ? 1 : 0);
    ModalData data;
    data.ports.sensors    = basis.sensors;
    data.ports.slopes     = basis.slopes;
    data.ports.surface    = static_cast<unsigned int>(basis.face_compliance.m()) - 1 - basis.sensors - basis.slopes;
    data.ports.sprung     = constants.sprung;
    data.stiffness        = basis.stiffness;
    data.face_compliance  = basis.face_compliance;
    data.relaxation       = constants.relaxation;
    data.spring_stiffness = constants.spring_stiffness;
    data.shapes.reinit(data.ports.size(), n);
    for (unsigned int i = 0; i < std::min(data.ports.size(), static_cast<unsigned int>(basis.shapes.m())); ++i)
      for (unsigned int j = 0; j < n_lever; ++j)
        data.shapes(i, j) = basis.shapes(i, j);

    // The spring's share of the modes' stiffness is not damped.
    data.damping.reinit(n, n);
    const unsigned int hub = data.ports.rotation();
    for (unsigned int i = 0; i < n_lever; ++i)
    {
      for (unsigned int j = 0; j < n_lever; ++j)
        data.damping(i, j) = constants.relaxation * basis.layer_stiffness(i, j) - constants.stiffness_damping *
                                                                                      constants.spring_stiffness *
                                                                                      basis.shapes(hub, i) * basis.shapes(hub, j);
      data.damping(i, i) += constants.mass_damping + constants.stiffness_damping * basis.stiffness[i] +
                            (i == 0 ? 0. : 2. * constants.modal_damping * std::sqrt(basis.stiffness[i]));
    }
    if (constants.sprung)
    {
      data.support = n_lever;
      data.stiffness.push_back(constants.support_stiffness / constants.support_mass);
      data.damping(n_lever, n_lever)             = constants.support_damping / constants.support_mass;
      data.shapes(data.ports.support(), n_lever) = 1. / std::sqrt(constants.support_mass);
    }
    return data;
  }

  CondensedDisplacement::CondensedDisplacement(const ElasticBody<2> &body, const BasisSettings &settings,
                                               const CondensedBasis &basis_)
      : basis(basis_)
      , matrices(body, settings.inertia)
      , ports(body, matrices, false)
  {
    PETScWrappers::SparseMatrix stiffness;
    matrices.sum({ 0., 1., 0., settings.spring_stiffness }, stiffness);
    factors.factorise(stiffness);
  }

  Vector<double> CondensedDisplacement::operator()(const Motion &motion) const
  {
    Vector<double> load(matrices.coordinates.size()), total;
    for (unsigned int port = 0; port < motion.face_force.size(); ++port)
      if (motion.face_force[port] != 0.)
        ports.add_force(port, motion.face_force[port], load);
    factors.solve(load, total);
    for (unsigned int i = 0; i < basis.stiffness.size(); ++i)
    {
      double force = 0.;
      for (unsigned int port = 0; port < motion.face_force.size(); ++port)
        force += basis.shapes(port, i) * motion.face_force[port];
      const double amount = motion.coordinates.position[i] - force / basis.stiffness[i];
      for (unsigned int a = 0; a < total.size(); ++a)
        total[a] += amount * basis.coordinate_shapes(i, a);
    }
    return matrices.coordinates.elastic_displacement(total);
  }
} // namespace sprag
