// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/condensed_basis.h"

#include "bar.h"
#include "mpi_environment.h"
#include "scene/scene.h"
#include "support/lever_in_time.h"
#include "support/temporary_folder.h"

#include <chrono>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

using namespace sprag;

namespace
{
  using Vector = dealii::Vector<double>;

  BasisSettings make_settings(const unsigned int modes, const std::string &cache = {})
  {
    return { modes, bar_spring, bar_inertia(1e-3, 1e-7), cache, {} };
  }

  InterfaceForces forces_on(const InterfaceLayout &layout)
  {
    InterfaceForces forces;
    forces.dofs = { 2, 5, 6, layout.rotation() };
    if (layout.sprung)
      forces.dofs.push_back(layout.support());
    forces.values.reinit(static_cast<unsigned int>(forces.dofs.size()));
    for (unsigned int i = 0; i < forces.values.size(); ++i)
      forces.values[i] = std::cos(1. + i);
    return forces;
  }

  /// Returns the interface displacements after steps under growing forces.
  template <class Structure>
  Vector stepped(Structure &structure)
  {
    Motion motion = structure.rest();
    structure.use_step(generalised_alpha(0.8, 2e-5));
    for (unsigned int i = 0; i < 5; ++i)
    {
      auto forces = forces_on(structure.layout());
      forces.values *= 1. + i;
      structure.free_displacements(motion, all_dofs(structure.layout().size()));
      motion = structure.advance(motion, forces, {});
    }
    return structure.positions(motion);
  }

  /// Springs, dashpots and friction on two nodes of the face, a part of which follows the slip of the first late.
  LinearisedForces contact_on(const InterfaceLayout &layout)
  {
    LinearisedForces forces;
    forces.dofs = { 12, 13, 14, 15, layout.rotation() };
    for (auto *const matrix :
         { &forces.pressure, &forces.friction, &forces.pressure_rate, &forces.friction_rate, &forces.inertia })
      matrix->reinit(5, 5);
    for (unsigned int a = 0; a < 4; ++a)
    {
      forces.pressure(a, a)      = -800.;
      forces.pressure_rate(a, a) = -1e-3;
      for (unsigned int b = 0; b < 5; ++b)
      {
        forces.friction(a, b)      = 160. * std::cos(1. + a * b);
        forces.friction_rate(a, b) = 1e-4 * std::cos(2. + a * b);
      }
    }
    FrictionDelay delay{ 2e-5, Vector(5), Vector(5), Vector(5) };
    delay.force[0]             = -1.;
    delay.stiffness_row[1]     = -580.;
    delay.rate_row[0]          = 0.01;
    forces.friction(0, 1)      = 580.;
    forces.friction_rate(0, 0) = -0.01;
    forces.delays              = { delay };
    return forces;
  }

  std::string only_file(const std::string &folder)
  {
    std::string result;
    for (const auto &entry : std::filesystem::directory_iterator(folder))
    {
      EXPECT_TRUE(result.empty()) << "more than one file";
      result = entry.path().string();
    }
    return result;
  }
} // namespace

TEST(CondensedBasis, WithAllModesIsTheFiniteElements)
{
  const MeshedBar bar({});
  const unsigned int all = TotalCoordinates(*bar).size();
  const auto basis       = make_basis(*bar, make_settings(all));
  ASSERT_EQ(basis.stiffness.size(), all);
  for (const bool sprung : { false, true })
  {
    auto whole = sparse_structure(*bar, bar_inertia(1e-3, 1e-7), all, damped_dynamics(sprung));
    ModalStructure condensed(modal_data(basis, damped_dynamics(sprung)));
    const auto expected = stepped(whole);
    Vector difference   = stepped(condensed);
    difference -= expected;
    EXPECT_LE(difference.linfty_norm(), 1e-8 * expected.linfty_norm()) << sprung;

    const auto contact    = contact_on(whole.layout());
    const auto vibrations = whole.vibrations(contact, 8), others = condensed.vibrations(contact, 20);
    ASSERT_GE(vibrations.size(), 8u);
    for (const auto &mode : vibrations)
    {
      double nearest = 1e300;
      for (const auto &other : others)
        nearest = std::min(nearest, std::abs(other.eigenvalue - mode.eigenvalue));
      EXPECT_LT(nearest, 1e-8 * std::abs(mode.eigenvalue)) << sprung << mode.eigenvalue;
    }

    whole.use_statics();
    EXPECT_LE(basis.face_compliance.linfty_norm(), 1e-9 * whole.compliance().blocks().front().matrix->linfty_norm());
  }
}

// Both begin with the velocities of the first mode.
TEST(CondensedBasis, ItsLocalErrorIsThatOfTheFiniteElements)
{
  const MeshedBar bar({});
  const auto inertia = bar_inertia(1e-3, 1e-7);
  const auto modes   = modes_on_spring(*bar, inertia, 3);
  auto whole         = sparse_structure(*bar, inertia, 3, undamped_dynamics(false));
  ModalStructure condensed(modal_data(make_basis(*bar, make_settings(3)), undamped_dynamics(false)));
  const auto local_error = [](auto &structure, const Vector &velocity)
  {
    structure.use_step(generalised_alpha(1., 1e-4));
    Motion begin               = structure.rest();
    begin.coordinates.velocity = velocity;
    structure.free_displacements(begin, all_dofs(structure.layout().size()));
    return structure.local_error(begin, structure.advance(begin, InterfaceForces(), {}));
  };
  Vector first(condensed.rest().coordinates.position.size());
  first[0]            = 1.;
  const auto expected = local_error(condensed, first);
  Vector difference = local_error(whole, TotalCoordinates(*bar).total(modes.displacements[0], modes.leaf[0], modes.rotation[0]));
  difference -= expected;
  EXPECT_LE(difference.linfty_norm(), 1e-6 * expected.linfty_norm());
}

TEST(CondensedBasis, IsFoundAgain)
{
  const TemporaryFolder folder;
  const MeshedBar bar({});
  const auto made  = condensed_basis(*bar, make_settings(3, folder.path));
  const auto found = condensed_basis(*bar, make_settings(3, folder.path));
  EXPECT_FALSE(made.from_cache);
  EXPECT_EQ(made.message, "");
  EXPECT_TRUE(found.from_cache);
  EXPECT_EQ(found.stiffness, made.stiffness);
  EXPECT_TRUE(found.shapes == made.shapes);
  EXPECT_TRUE(found.layer_stiffness == made.layer_stiffness);
  EXPECT_TRUE(found.face_compliance == made.face_compliance);
  EXPECT_TRUE(found.displacements == made.displacements);
  EXPECT_EQ(found.rotation, made.rotation);
  EXPECT_EQ(found.density_factor, made.density_factor);
  EXPECT_EQ(found.total_mass, made.total_mass);
  only_file(folder.path);
}

TEST(CondensedBasis, OfOtherLeversIsAnother)
{
  const TemporaryFolder folder;
  condensed_basis(*MeshedBar({}), make_settings(3, folder.path));
  EXPECT_FALSE(condensed_basis(*MeshedBar({}), make_settings(4, folder.path)).from_cache);
  EXPECT_FALSE(condensed_basis(*MeshedBar({}, 0.2), make_settings(3, folder.path)).from_cache);
  Bar longer;
  longer.length *= 1.01;
  EXPECT_FALSE(condensed_basis(*MeshedBar(longer), make_settings(3, folder.path)).from_cache);
  auto heavier = make_settings(3, folder.path);
  heavier.inertia.moment_of_inertia *= 1.01;
  EXPECT_FALSE(condensed_basis(*MeshedBar({}), heavier).from_cache);
  auto with_tip = make_settings(3, folder.path);
  with_tip.inertia.tip_mass *= 1.01;
  EXPECT_FALSE(condensed_basis(*MeshedBar({}), with_tip).from_cache);
  auto softer = make_settings(3, folder.path);
  softer.spring_stiffness *= 0.99;
  EXPECT_FALSE(condensed_basis(*MeshedBar({}), softer).from_cache);
  EXPECT_TRUE(condensed_basis(*MeshedBar({}), make_settings(3, folder.path)).from_cache);
}

// A killed process leaves an old file that nobody keeps locked. One that is locked or young is another process's at work.
TEST(CondensedBasis, LeftoversOfKilledProcessesAreRemoved)
{
  const TemporaryFolder folder;
  const auto old     = std::filesystem::file_time_type::clock::now() - std::chrono::minutes(1);
  const auto written = [&](const std::string &name, const bool is_old)
  {
    const std::filesystem::path path = folder.write(name, "half a basis");
    if (is_old)
      std::filesystem::last_write_time(path, old);
    return path;
  };
  const auto left                                 = written("basis-0123456789abcdef.bin.4711", true);
  const std::vector<std::filesystem::path> others = { written("basis-0123456789abcdef.bin.4712", false),
                                                      written("basis-0123456789abcdef.bin", true), written("mine.bin.1", true) };
  const auto at_work                              = written("basis-fedcba9876543210.bin.4713", true);
  const int writer                                = ::open(at_work.c_str(), O_RDWR);
  ASSERT_EQ(::flock(writer, LOCK_EX), 0);
  EXPECT_EQ(condensed_basis(*MeshedBar({}), make_settings(3, folder.path)).message, "");
  EXPECT_FALSE(std::filesystem::exists(left));
  EXPECT_TRUE(std::filesystem::exists(at_work));
  for (const auto &path : others)
    EXPECT_TRUE(std::filesystem::exists(path)) << path;
  ::close(writer);
  EXPECT_TRUE(condensed_basis(*MeshedBar({}), make_settings(3, folder.path)).from_cache);
  EXPECT_FALSE(std::filesystem::exists(at_work));
}

TEST(CondensedBasis, WithoutACacheFolderIsMadeAndSaysSo)
{
  const TemporaryFolder folder;
  const auto file  = folder.write("file", "in the way");
  const auto basis = condensed_basis(*MeshedBar({}), make_settings(3, file));
  EXPECT_FALSE(basis.from_cache);
  EXPECT_NE(basis.message.find(file), std::string::npos);
  EXPECT_EQ(basis.stiffness.size(), 3u);
}
