// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/condensed_basis.h"
#include "fe/dynamics/sparse_structure.h"
#include "model/structure/modal_structure.h"
#include "mpi_environment.h"
#include "plate.h"
#include "scene/scene.h"
#include "support/lever_in_time.h"

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
    structure.use_step(generalised_alpha(0.8, 2e-5));
    Motion motion = structure.rest();
    for (unsigned int step = 0; step < 12; ++step)
    {
      const auto forces = step_forces(step);
      structure.free_displacements(motion, all_dofs(structure.layout().size()));
      motion = structure.advance(motion, forces, {});
      look(motion);
    }
  }

  double sensor_sum(const PlateOnBar &scene, const Vector &displacements, const InterfaceLayout &layout)
  {
    double sum = 0.;
    for (unsigned int i = 0; i < layout.sensors; ++i)
      sum += scene.sensor_stiffness * displacements[layout.sensor(i)];
    return sum;
  }
} // namespace

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
      march(structure, [&](const Motion &after) { history.push_back(sensor_sum(scene, structure.positions(after), layout)); });
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
