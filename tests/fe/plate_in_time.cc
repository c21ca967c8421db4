// SPDX-License-Identifier: GPL-3.0-only
#include "fe/algebra/compressed_rows.h"
#include "fe/dynamics/condensed_basis.h"
#include "fe/dynamics/sparse_structure.h"
#include "model/structure/modal_structure.h"
#include "mpi_environment.h"
#include "plate.h"
#include "scene/scene.h"
#include "support/lever_in_time.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Vector = dealii::Vector<double>;

  /// On some nodes of the friction face, growing.
  InterfaceForces step_forces(const unsigned int step)
  {
    InterfaceForces forces;
    forces.dofs   = { 10, 11, 24, 25 };
    forces.values = Vector(4);
    for (unsigned int i = 0; i < 4; ++i)
      forces.values[i] = (1. + step) * std::cos(0.4 + i);
    return forces;
  }

  template <class Structure, class Look>
  void march(Structure &structure, const Look &look)
  {
    const auto weights = generalised_alpha(0.8, 2e-5);
    structure.use_step(weights);
    Motion motion = structure.rest();
    for (unsigned int step = 0; step < 12; ++step)
    {
      const auto forces = step_forces(step);
      structure.free_displacements(motion, all_dofs(structure.layout().size()));
      const auto before = motion;
      motion            = structure.advance(motion, forces, {});
      look(before, motion, forces, weights);
    }
  }

  /// Row whose product with total coordinates is the momentum of plate and layer along eta.
  Vector plate_momentum(const ElasticBody<2> &body, const LeverInertia &inertia)
  {
    const TotalCoordinates coordinates(body);
    Vector row(coordinates.size());
    const auto &fe = body.dofs().get_fe();
    dealii::FEValues<2> values(fe, dealii::QGauss<2>(3), dealii::update_values | dealii::update_JxW_values);
    std::vector<dealii::types::global_dof_index> dofs(fe.n_dofs_per_cell());
    for (const auto &cell : body.dofs().active_cell_iterators())
      if (cell->material_id() != material_id::lever)
      {
        values.reinit(cell);
        cell->get_dof_indices(dofs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (fe.system_to_component_index(i).first == 1)
            for (const unsigned int q : values.quadrature_point_indices())
              row[coordinates.mover(static_cast<unsigned int>(dofs[i])).coordinate] += inertia.densities.at(cell->material_id()) *
                                                                                       body.body_properties().width *
                                                                                       values.shape_value(i, q) * values.JxW(q);
      }
    return row;
  }

  double sensor_sum(const PlateOnBar &scene, const Vector &displacements, const InterfaceLayout &layout)
  {
    double sum = 0.;
    for (unsigned int i = 0; i < layout.sensors; ++i)
      sum += scene.sensor_stiffness * displacements[layout.sensor(i)];
    return sum;
  }
} // namespace

TEST(PlateInTime, ContactLessSensorsIsThePlatesInertia)
{
  const PlateOnBar scene;
  const MeshedPlate plate(scene);
  auto structure     = sparse_structure(*plate, plate_inertia(), 4, undamped_dynamics(false));
  const auto &layout = structure.layout();
  ASSERT_EQ(layout.sensors, 2u);
  const auto momentum = plate_momentum(*plate, plate_inertia());
  double largest      = 0.;
  march(structure,
        [&](const Motion &before, const Motion &after, const InterfaceForces &forces, const StepWeights &w)
        {
          // Forces and accelerations of a step of the generalised-alpha method are weighted means of its ends.
          const double sensors = (1. - w.alpha_f) * sensor_sum(scene, structure.positions(after), layout) +
                                 w.alpha_f * sensor_sum(scene, structure.positions(before), layout);
          const double inertia = (1. - w.alpha_m) * (momentum * after.coordinates.acceleration) +
                                 w.alpha_m * (momentum * before.coordinates.acceleration);
          const double contact = forces.values[1] + forces.values[3];
          EXPECT_NEAR(contact - sensors, inertia, 1e-8 * std::abs(contact));
          largest = std::max(largest, std::abs(inertia / contact));
        });
  EXPECT_GT(largest, 0.05);
}

TEST(PlateInTime, CondensedSensorsAreThoseOfTheFiniteElements)
{
  const PlateOnBar scene;
  const MeshedPlate plate(scene);
  const unsigned int all = TotalCoordinates(*plate).size();
  for (const bool sprung : { false, true })
  {
    auto whole         = sparse_structure(*plate, plate_inertia(), 4, undamped_dynamics(sprung));
    const auto layout  = whole.layout();
    const auto sensors = [&](auto &structure)
    {
      std::vector<double> history;
      march(structure, [&](const Motion &, const Motion &after, const InterfaceForces &, const StepWeights &)
            { history.push_back(sensor_sum(scene, structure.positions(after), layout)); });
      return history;
    };
    const auto expected = sensors(whole);
    const auto error    = [&](const unsigned int modes)
    {
      const auto basis = make_basis(*plate, { modes, bar_spring, plate_inertia(), {}, {} });
      ModalStructure condensed(modal_data(basis, undamped_dynamics(sprung)));
      EXPECT_EQ(condensed.layout().sensors, 2u);
      EXPECT_EQ(condensed.layout().rotation(), layout.rotation());
      const auto found = sensors(condensed);
      double largest   = 0.;
      for (std::size_t i = 0; i < found.size(); ++i)
        largest = std::max(largest, std::abs(found[i] - expected[i]) / std::abs(expected.back()));
      return largest;
    };
    EXPECT_LT(error(all), 1e-8) << sprung;
    // Modes left out answer at once, as in statics.
    EXPECT_LT(error(20), 2e-2) << sprung;
    EXPECT_LT(error(80), 2e-3) << sprung;
  }
}
