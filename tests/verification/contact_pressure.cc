// SPDX-License-Identifier: GPL-3.0-only
#include "run_scene.h"
#include "scene/scene.h"
#include "support/made_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

using namespace sprag;

// Largest pressure and contact width of model A with mu 0.73 and the default mesh against hard contact on a fine one: penalties
// of 3200 and 9600 N/mm^3 on faces of 0.03125 mm, extrapolated to none. See tests/benchmarks/pressure.md.
// An elastic cylinder of aluminium changes them by less than 0.1 %.

namespace
{
  struct Reference
  {
    double way;              ///< of the cylinder
    double x;                ///< [mm]
    double largest_pressure; ///< [MPa]
    double width;            ///< [mm]
  };

  // Stick ends within a millimetre of the turn at 65 mm.
  const std::vector<Reference> references = { { 1., 13., 0.0672, 0.723 },  { 1., 26., 0.1059, 1.058 },
                                              { 1., 39., 0.1457, 1.355 },  { 1., 52., 0.1906, 1.646 },
                                              { 1., 65., 0.2448, 1.939 },  { -1., 13., 0.0828, 0.862 },
                                              { -1., 26., 0.1343, 1.273 }, { -1., 39., 0.1913, 1.643 },
                                              { -1., 52., 0.2604, 2.014 }, { -1., 64., 0.3417, 2.383 } };

  /// Both strokes of a lever, without recovery between.
  struct Strokes
  {
    std::vector<Row> rows;
    std::vector<FaceState> faces;
    std::vector<double> weights;
  };

  Strokes strokes(const Scene &scene, Model &model)
  {
    Strokes result;
    result.weights = model.face_points().weight;
    run_quasi_static(model, scene.drive, { scene.analysis.step, scene.analysis.minimum_step, scene.contact },
                     [&](const State &state, const Row &row, const Evaluation &found)
                     {
                       result.rows.push_back(row);
                       result.faces.push_back(model.face_state(state, found));
                     });
    return result;
  }

  /// Linear between the rows of a stroke.
  double at(const std::vector<Row> &rows, const Reference &place, const Column column)
  {
    const Row *below = nullptr, *above = nullptr;
    for (const Row &row : rows)
    {
      if (!(row[Column::v] * place.way > 0.) || !(row[Column::P] > 0.))
        continue;
      const double x = row[Column::x];
      if (x <= place.x + 1e-9 && (!below || x > (*below)[Column::x]))
        below = &row;
      if (x >= place.x - 1e-9 && (!above || x < (*above)[Column::x]))
        above = &row;
    }
    const double length = (*above)[Column::x] - (*below)[Column::x];
    const double share  = length > 0. ? (place.x - (*below)[Column::x]) / length : 0.;
    return (1. - share) * (*below)[column] + share * (*above)[column];
  }

  /// Near x = 0, where the contact is less than three faces of 0.25 mm wide, with the friction of cork on aluminium, by the
  /// augmented Lagrangian on faces of 0.03125 mm. Even faces of 0.25 mm are 3 to 5 % off.
  const std::vector<Reference> narrow = {
    { 1., 6., 0.04315, 0.484 },  { 1., 8., 0.05064, 0.561 },  { 1., 10., 0.05752, 0.631 },
    { -1., 6., 0.05221, 0.577 }, { -1., 8., 0.06153, 0.674 }, { -1., 10., 0.07021, 0.753 }
  };

  void expect_reference(const std::vector<Row> &rows, const std::vector<Reference> &places, const double error)
  {
    for (const auto &place : places)
    {
      EXPECT_NEAR(at(rows, place, Column::largest_pressure) / place.largest_pressure, 1., error) << place.way << " " << place.x;
      EXPECT_NEAR(at(rows, place, Column::contact_width) / place.width, 1., 0.03) << place.way << " " << place.x;
    }
  }

  double resultant(const std::vector<double> &weights, const std::vector<double> &values)
  {
    double sum = 0.;
    for (std::size_t q = 0; q < values.size(); ++q)
      sum += weights[q] * values[q];
    return sum;
  }

  /// It rises to one peak and falls from it.
  void expect_one_peak(const std::vector<double> &p, const double x)
  {
    const auto peak = std::max_element(p.begin(), p.end());
    EXPECT_TRUE(std::is_sorted(p.begin(), peak)) << "x " << x;
    EXPECT_TRUE(std::is_sorted(peak, p.end(), std::greater<>())) << "x " << x;
  }

  /// From x = 13 mm on, where the contact is three cells wide; its resultant and that of the friction are those of the points.
  void expect_smooth(const Strokes &found)
  {
    for (std::size_t i = 1; i < found.rows.size(); ++i)
    {
      const Row &row = found.rows[i];
      if (row[Column::x] < 12.9)
        continue;
      const auto &face = found.faces[i];
      expect_one_peak(face.pressure, row[Column::x]);
      EXPECT_NEAR(resultant(found.weights, face.pressure) / row[Column::normal_resultant], 1., 1e-9);
      EXPECT_NEAR(resultant(found.weights, face.traction), row[Column::friction_resultant], 1e-9 * row[Column::normal_resultant]);
    }
  }

  void expect_hard_contact(const Scene &scene)
  {
    const MadeMesh triangulation(scene);
    StaticLever<2> model(triangulation, lever_properties(scene));
    const auto found = strokes(scene, model);
    expect_reference(found.rows, references, 0.02);
    expect_smooth(found);
  }

  Scene on_rigid_cylinder()
  {
    return with_face_size(with_coulomb(model_a(), 0.73), 0.25);
  }

  Scene on_elastic_cylinder()
  {
    Scene scene                 = on_rigid_cylinder();
    scene.cylinder.type         = CylinderType::solid;
    scene.cylinder.inner_radius = 28.;
    return scene;
  }
} // namespace

TEST(ContactPressure, OfThePenaltyMeetsHardContact)
{
  expect_hard_contact(on_rigid_cylinder());
}

TEST(ContactPressure, OfTheAugmentedLagrangianMeetsHardContact)
{
  expect_hard_contact(with_augmented_lagrangian(on_rigid_cylinder()));
}

TEST(ContactPressure, OfTheAugmentedLagrangianOnAnElasticCylinderMeetsHardContact)
{
  expect_hard_contact(with_augmented_lagrangian(on_elastic_cylinder()));
}

TEST(ContactPressure, OfASecondLeverIsRecoveredToo)
{
  Scene scene                = on_rigid_cylinder();
  scene.pair.type            = PairType::full;
  scene.pair.cylinder_offset = 0.02;
  scene.drive                = Drive(DriveProfile::triangle, 0., 65., 112., 0.5);
  scene.analysis.step        = 6.5;
  const MadeMesh triangulation(scene);
  StaticLever<2> model(triangulation, scene);
  const auto found = strokes(scene, model);
  for (std::size_t i = 2; i < found.rows.size(); ++i)
  {
    const Row &row = found.rows[i];
    const auto &p  = found.faces[i].pressure_2;
    expect_one_peak(p, row[Column::x]);
    EXPECT_NEAR(*std::max_element(p.begin(), p.end()) / row.second_value(Column::largest_pressure), 1., 1e-3);
    EXPECT_NEAR(resultant(found.weights, p) / row.second_value(Column::P), 1., 3e-3); // P is normal to the undeformed face
    EXPECT_NE(row.second_value(Column::largest_pressure), row[Column::largest_pressure]);
  }
}

TEST(ContactPressure, ShorterFacesResolveNarrowContacts)
{
  Scene scene                 = model_a();
  scene.mesh.face_size        = 0.25;
  scene.mesh.faces_in_contact = 4.;
  scene.contact.enforcement   = Enforcement::augmented_lagrangian;
  const MadeMesh triangulation(scene);
  StaticLever<2> model(triangulation, lever_properties(scene));
  expect_reference(strokes(scene, model).rows, narrow, 0.01);
}
