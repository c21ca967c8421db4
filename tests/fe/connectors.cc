// SPDX-License-Identifier: GPL-3.0-only
#include "fe/body/connectors.h"

#include "base/errors.h"
#include "fe/algebra/compressed_rows.h"
#include "fe/algebra/mumps.h"
#include "mpi_environment.h"
#include "plate.h"
#include "scene/scene.h"
#include "support/thrown.h"

#include <deal.II/base/function_lib.h>
#include <deal.II/numerics/vector_tools.h>

#include <functional>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Vector = dealii::Vector<double>;
  using Matrix = dealii::PETScWrappers::SparseMatrix;
  using Field  = std::function<std::array<double, 2>(double xi, double eta)>;

  /// Nodal values of a displacement, held nodes included.
  Vector displacement(const ElasticBody<2> &body, const Field &field)
  {
    class PrescribedField : public dealii::Function<2>
    {
    public:
      explicit PrescribedField(const Field &field_)
          : dealii::Function<2>(2)
          , field(field_)
      {
      }
      double value(const dealii::Point<2> &point, const unsigned int component) const override
      {
        return field(point[0], point[1])[component];
      }

    private:
      const Field &field;
    };
    Vector result(body.n_dofs());
    dealii::VectorTools::interpolate(body.dofs(), PrescribedField(field), result);
    return result;
  }

  /// Displacement under forces on the nodes of the friction face next to xi, spread over two.
  Vector loaded(const ElasticBody<2> &body, const double xi, const std::array<double, 2> &force)
  {
    Vector load(body.n_dofs());
    const auto &nodes = body.friction_face().nodes;
    for (const auto &left : nodes)
      for (const auto &right : nodes)
      {
        const double gap = right.position[0] - left.position[0];
        if (gap <= 0. || gap > 1.3 || left.position[0] > xi || right.position[0] <= xi)
          continue;
        for (unsigned int d = 0; d < 2; ++d)
        {
          load[left.dofs[d]]  = force[d] * (right.position[0] - xi) / gap;
          load[right.dofs[d]] = force[d] * (xi - left.position[0]) / gap;
        }
      }
    Matrix stiffness;
    Vector ignored(body.n_dofs()), result;
    body.reinit(stiffness);
    body.assemble(Vector(body.n_dofs()), stiffness, ignored);
    Mumps factors;
    factors.factorise(stiffness);
    factors.solve(load, result);
    return result;
  }
} // namespace

TEST(Connectors, MeasureTheMeanOverPadsBetweenNodes)
{
  const PlateOnBar scene;
  const MeshedPlate plate(scene);
  // Quadratic elements hold these fields exactly; the mean of xi^2 over a pad is its middle squared and length^2 / 12.
  const auto bulge = displacement(*plate,
                                  [&](const double xi, const double eta) -> std::array<double, 2> {
                                    return { { eta < scene.front() ? 3. * xi * xi : 0., eta < scene.front() ? xi * xi : 5. } };
                                  });
  const auto mean  = [&](const double middle) { return middle * middle + scene.sensor_length * scene.sensor_length / 12.; };
  const auto &all  = plate->connectors();
  ASSERT_EQ(all.size(), 3u);
  for (unsigned int i = 0; i < 2; ++i)
    EXPECT_NEAR(all[i].compression(bulge), mean(scene.sensors[i]) - 5., 1e-10);
  EXPECT_NEAR(all[2].compression(bulge), 3. * mean(scene.guide), 1e-10);
}

TEST(Connectors, NoRigidMovementCompressesThem)
{
  const MeshedPlate plate(PlateOnBar{});
  const auto moved = displacement(*plate,
                                  [](const double xi, const double eta) -> std::array<double, 2> {
                                    return { { 2. - 0.3 * eta, 7. + 0.3 * xi } };
                                  });
  for (const auto &connector : plate->connectors())
    EXPECT_NEAR(connector.compression(moved), 0., 1e-12);
}

TEST(Connectors, APlateOnTwoSensorsFollowsTheLeverRule)
{
  // Statically determinate: the forces do not depend on what bends.
  const PlateOnBar scene;
  const MeshedPlate plate(scene);
  const double x_1 = scene.sensors[0], x_2 = scene.sensors[1];
  const double P = 30., F = 20.;
  for (const double xi : { 12., 20.3, 33. })
  {
    const auto u      = loaded(*plate, xi, { { -F, P } });
    const auto forces = plate->sensor_forces(u);
    // Moments about the guide's line, the plate's back: friction along -xi acts layer and plate in front of it.
    const double tilt = F * (scene.back() - scene.offset) / (x_2 - x_1);
    EXPECT_NEAR(forces[0], P * (x_2 - xi) / (x_2 - x_1) + tilt, 1e-8 * P) << xi;
    EXPECT_NEAR(forces[1], P * (xi - x_1) / (x_2 - x_1) - tilt, 1e-8 * P) << xi;
    const auto &guide = plate->connectors().back();
    EXPECT_NEAR(guide.stiffness * guide.compression(u), -F, 1e-8 * F) << xi;
  }
}

TEST(Connectors, APadBesideItsSideIsRefusedByName)
{
  PlateOnBar scene;
  scene.sensors[1] = scene.end - 0.4 * scene.sensor_length;
  const auto text  = thrown_text([&] { const MeshedPlate plate(scene); });
  EXPECT_NE(text.find("force sensor at xi = 34.84 mm"), std::string::npos) << text;
  EXPECT_NE(text.find("'sensor plate'"), std::string::npos) << text;
}
