#include "analysis/memory.h"

#include "base/errors.h"
#include "scenes.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  /// /meta/peak_memory of a run and the parameters that it had.
  struct Measured
  {
    AnalysisType type;
    ModelType model;
    double face_size; ///< [mm]
    double bytes;
  };

  constexpr Measured measured[] = { { AnalysisType::quasi_static, ModelType::finite_element, 0.5, 0.26e9 },
                                    { AnalysisType::quasi_static, ModelType::finite_element, 0.25, 0.38e9 },
                                    { AnalysisType::quasi_static, ModelType::finite_element, 0.125, 0.77e9 },
                                    { AnalysisType::quasi_static, ModelType::finite_element, 0.0625, 2.2e9 },
                                    { AnalysisType::quasi_static, ModelType::finite_element, 0.03125, 7.2e9 } };

  Scene scene_of(const Measured &run)
  {
    Scene scene          = model_a();
    scene.analysis.type  = run.type;
    scene.analysis.model = run.model;
    scene.mesh.face_size = run.face_size;
    return scene;
  }

  TEST(Memory, EstimateIsWithinAFactorOfTwo)
  {
    for (const auto &run : measured)
    {
      SCOPED_TRACE(run.face_size);
      const double expected = expected_memory(scene_of(run));
      EXPECT_LT(expected, 2. * run.bytes);
      EXPECT_GT(expected, 0.5 * run.bytes);
    }
  }

  TEST(Memory, EachProcessAndLeverNeedsItsOwn)
  {
    Scene scene = scene_of(measured[2]);
    EXPECT_NEAR(expected_memory(scene, 4), 4. * expected_memory(scene), 1e7);
    const double one = expected_memory(scene);
    scene.pair.type  = PairType::full;
    EXPECT_GT(expected_memory(scene), 1.5 * one);
  }

  TEST(Memory, WhatCannotFitIsRefusedWithBothNumbers)
  {
    Scene scene = model_a();
    EXPECT_NO_THROW(require_memory(scene));
    scene.mesh.face_size = 1e-4;
    try
    {
      require_memory(scene);
      FAIL();
    }
    catch (const InputError &error)
    {
      const std::string text = error.what();
      EXPECT_NE(text.find("Mesh/Face size = 0.0001 mm"), std::string::npos) << text;
      EXPECT_NE(text.find(" GB of memory, and "), std::string::npos) << text;
    }
    scene.analysis.model = ModelType::closed_form;
    EXPECT_NO_THROW(require_memory(scene));
  }
} // namespace
