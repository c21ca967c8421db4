// SPDX-License-Identifier: GPL-3.0-only
#include "scene/contact_estimates.h"

#include "input/read.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/shipped.h"

#include <cmath>
#include <gtest/gtest.h>
#include <string>

using namespace sprag;

namespace
{
  Scene meshed_model_a()
  {
    Scene scene          = model_a();
    scene.analysis.model = ModelType::condensed;
    return scene;
  }

} // namespace

// Finite elements of model A are pressed in by P = 9117 delta^1.444 (N, mm): the analysis of its contact law.
TEST(ContactReference, StiffnessOfAMeshedLeverIsThatOfItsFace)
{
  Scene scene          = meshed_model_a();
  const auto reference = contact_reference(scene);
  const double fitted  = 1.444 * std::pow(9117., 1. / 1.444) * std::pow(reference.P, 1. - 1. / 1.444);
  EXPECT_NEAR(reference.stiffness, fitted, 0.05 * fitted);
  scene.contact.stiffness *= 10.; // of reduced models alone
  EXPECT_DOUBLE_EQ(contact_reference(scene).stiffness, reference.stiffness);
  EXPECT_DOUBLE_EQ(contact_reference(scene).relaxation, reference.relaxation);
  scene.analysis.model = ModelType::rigid;
  EXPECT_NEAR(contact_reference(scene).stiffness, scene.contact.stiffness, 1e-9 * scene.contact.stiffness);
}

// Johnson, Contact Mechanics, eq. 5.57: delta = 2 P/(pi b E) (log(2 h/a)) of half width a, which grows with the root of P.
TEST(ContactReference, OfAContactThatIsNarrowAgainstItsLayerIsThatOfAHalfPlane)
{
  Scene scene               = meshed_model_a();
  scene.layer.thickness     = 20.;
  scene.layer.young_modulus = 2000.;
  scene.layer.poisson_ratio = 0.;
  const auto reference      = contact_reference(scene);
  const double half_width   = 0.5 * estimated_contact_width(scene, reference.P);
  const double per_force    = 2. / (M_PI * scene.lever.width * 2000.) * (std::log(2. * 20. / half_width) - 0.5);
  EXPECT_NEAR(reference.stiffness * per_force, 1., 0.05);
}

// A layer yields alike on the lever and, as a tyre, on the shaft; what it is pressed against hardly counts.
TEST(ContactReference, OfATyreIsThatOfALayer)
{
  Scene layer                 = meshed_model_a();
  layer.lever.young_modulus   = 2e6;
  layer.layer.thickness       = 2.;
  Scene tyre                  = layer;
  tyre.layer.thickness        = 0.;
  tyre.cylinder.type          = CylinderType::solid;
  tyre.cylinder.inner_radius  = tyre.geometry.cylinder_radius - 2.;
  tyre.cylinder.young_modulus = layer.layer.young_modulus;
  tyre.cylinder.poisson_ratio = layer.layer.poisson_ratio;
  const double P              = contact_reference(layer).P;
  EXPECT_NEAR(contact_reference(tyre).relaxation, contact_reference(layer).relaxation,
              1e-3 * contact_reference(layer).relaxation);
  EXPECT_EQ(estimated_contact_width(tyre, P), estimated_contact_width(layer, P));
}

// Widths of hard contact on faces of 0.03125 mm, from tests/benchmarks/pressure.md; estimates need not be better than a fifth.
TEST(FaceGrading, WidthsOfModelAAreEstimated)
{
  const Scene scene = shipped("model-a");
  EXPECT_NEAR(estimated_contact_width(scene, 1.52), 0.723, 0.15);
  EXPECT_NEAR(estimated_contact_width(scene, 6.15), 1.356, 0.27);
  EXPECT_NEAR(estimated_contact_width(scene, 14.7), 1.940, 0.39);
}

TEST(FaceGrading, ShortFacesLieWhereTheContactIsNarrow)
{
  const auto grading = face_grading(shipped("model-a"));
  ASSERT_TRUE(grading);
  EXPECT_DOUBLE_EQ(grading->longest, 0.25);
  EXPECT_DOUBLE_EQ(grading->shortest, 0.0625);
  EXPECT_LT(grading->begin, 175.);
  EXPECT_GT(grading->begin, 160.);
  EXPECT_GT(grading->end, 185.2); // of x = 0
}

TEST(FaceGrading, NoneWhereFacesAreShortEnoughOrFarTooLong)
{
  EXPECT_FALSE(face_grading(shipped("model-a", { "Mesh/Faces in contact=0" })));
  EXPECT_FALSE(face_grading(shipped("model-a", { "Drive/Start=50", "Mesh/Face size=0.1" })));
  EXPECT_FALSE(face_grading(shipped("model-a", { "Mesh/Face size=4" })));
}

TEST(FaceGrading, ContactsNarrowerThanFacesAreNoneOfGradedFaces)
{
  const auto is_narrow = [](const double width, const std::vector<std::string> &changes)
  { return is_narrower_than_faces(shipped("model-a", changes), width); };
  const std::string even = "Mesh/Faces in contact=0", wide = "Mesh/Face size=2";
  EXPECT_TRUE(is_narrow(1.9, { even, wide }));
  EXPECT_FALSE(is_narrow(2.1, { even, wide }));
  EXPECT_TRUE(is_narrow(3.9, { even, wide, "Mesh/Degree=1" }));
  EXPECT_TRUE(is_narrow(0.2, { even }));
  EXPECT_FALSE(is_narrow(0.2, {}));
}
