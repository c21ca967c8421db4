// SPDX-License-Identifier: GPL-3.0-only
#include "program/resources.h"

#include "base/errors.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/thrown.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

using namespace sprag;

namespace
{
  /// Largest resident memory of runs of model A, as the system tells it (ru_maxrss), with what differed between them.
  struct Measured
  {
    AnalysisType type;
    ModelType model;
    double start, stroke; ///< of the drive [mm]
    double face_size;     ///< [mm]
    double bytes;
  };

  constexpr auto quasi_static   = AnalysisType::quasi_static;
  constexpr auto transient      = AnalysisType::transient;
  constexpr auto modal          = AnalysisType::modal;
  constexpr auto finite_element = ModelType::finite_element;
  constexpr auto condensed      = ModelType::condensed;

  constexpr Measured measured[] = {
    { quasi_static, finite_element, 0., 65., 0.5, 0.229e9 },
    { quasi_static, finite_element, 0., 65., 0.125, 0.345e9 },
    { quasi_static, finite_element, 0., 65., 0.03125, 1.74e9 },
    { transient, condensed, 45., 45.6, 0.5, 0.226e9 },
    { transient, condensed, 45., 45.6, 0.0625, 0.537e9 },
    { transient, condensed, 0., 65., 0.25, 0.671e9 },
    { transient, condensed, 0., 65., 0.125, 1.67e9 },
    { modal, condensed, 0., 65., 0.5, 0.295e9 },
    { modal, condensed, 0., 65., 0.125, 0.660e9 },
    { modal, finite_element, 0., 65., 0.5, 0.298e9 },
    { modal, finite_element, 0., 65., 0.125, 1.02e9 },
    { transient, finite_element, 45., 45.2, 0.5, 0.276e9 },
    { transient, finite_element, 45., 45.2, 0.125, 0.496e9 },
  };

  Scene make_scene(const Measured &run)
  {
    Scene scene          = model_a();
    scene.drive          = Drive(DriveProfile::triangle, run.start, run.stroke, 112., 1.);
    scene.analysis.type  = run.type;
    scene.analysis.model = run.model;
    scene.mesh.face_size = run.face_size;
    return scene;
  }

  TEST(Memory, EstimateIsThatOfRuns)
  {
    for (const auto &run : measured)
    {
      SCOPED_TRACE(testing::Message() << "type " << static_cast<int>(run.type) << ", model " << static_cast<int>(run.model)
                                      << ", " << run.face_size << " mm");
      const double expected = expected_memory(make_scene(run));
      EXPECT_LT(expected, 1.3 * run.bytes);
      EXPECT_GT(expected, run.bytes / 1.3);
    }
  }

  /// Displacements of params/solid-a.prm, solid-frame-a.prm and solid-plate-a.prm, and what the last takes.
  TEST(Memory, PartsOfTheApparatusCountInThreeDimensions)
  {
    Scene bar                  = model_a();
    bar.analysis.dimension     = 3;
    bar.mesh.face_size         = 1.;
    Scene frame                = bar;
    frame.lever.outline        = LeverOutline::frame;
    Scene plate                = frame;
    plate.plate.type           = PlateType::on_sensors;
    plate.plate.sensors        = { 105., 195. };
    plate.mesh.elements_across = 8;
    plate.cylinder.tilt        = 2e-4;
    for (const auto &[scene, displacements] : { std::pair(bar, 130e3), std::pair(frame, 218508.), std::pair(plate, 336099.) })
    {
      EXPECT_LT(expected_size(scene).displacements, 1.3 * displacements);
      EXPECT_GT(expected_size(scene).displacements, displacements / 1.3);
    }
    EXPECT_GT(expected_memory(plate), 4.73e9 / 1.3);
    EXPECT_LT(expected_memory(plate), 4.73e9 * 1.3);
  }

  TEST(Memory, EachProcessAndLeverNeedsItsOwn)
  {
    Scene scene = make_scene(measured[8]);
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
    const auto text      = thrown_text([&] { require_memory(scene); });
    EXPECT_NE(text.find("Mesh/Face size = 0.0001 mm"), std::string::npos) << text;
    EXPECT_NE(text.find(" GB of memory, and "), std::string::npos) << text;
    scene.analysis.model = ModelType::closed_form;
    EXPECT_NO_THROW(require_memory(scene));
  }

  /// Leaves so much of the address space to the process.
  class SpaceLeft
  {
  public:
    explicit SpaceLeft(const double bytes)
    {
      ::getrlimit(RLIMIT_AS, &before);
      double pages = 0.;
      std::ifstream("/proc/self/statm") >> pages;
      const double used = pages * static_cast<double>(::sysconf(_SC_PAGESIZE));
      const rlimit limit{ static_cast<rlim_t>(used + bytes), before.rlim_max };
      ::setrlimit(RLIMIT_AS, &limit);
    }
    SpaceLeft &operator=(SpaceLeft &&) = delete;
    ~SpaceLeft()
    {
      ::setrlimit(RLIMIT_AS, &before);
    }

  private:
    rlimit before{};
  };

  /// The factors of the whole are two fifths of what a lever in three dimensions needs.
  TEST(Memory, FactorsGoToFilesWhereTheyAloneDoNotFit)
  {
    Scene scene              = model_a();
    scene.analysis.dimension = 3;
    scene.mesh.face_size     = 2.;
    scene.cylinder.tilt      = 2e-4;
    const double needed      = expected_memory(scene);
    const auto folder        = std::filesystem::current_path().string(); // on a disk
    EXPECT_FALSE(factor_files(scene, 1, folder));
    {
      const SpaceLeft most(0.8 * needed);
      const auto files = factor_files(scene, 1, folder);
      ASSERT_TRUE(files);
      EXPECT_EQ(files->folder, folder + "/.sprag-factors");
      EXPECT_NEAR(files->memory, needed, 1e-9 * needed);
      EXPECT_LT(files->memory_with_files, files->available.bytes);
      EXPECT_LT(files->available.bytes, needed);
      EXPECT_NO_THROW(require_memory(scene, 1, folder));
      EXPECT_THROW(require_memory(scene), InputError); // nobody said where
      const auto text = to_text(*files);
      EXPECT_NE(text.find("are kept in files"), std::string::npos) << text;
      EXPECT_NE(text.find(" GB in " + folder), std::string::npos) << text;
      scene.analysis.type = AnalysisType::modal; // whose modes need factors in memory all the time
      EXPECT_FALSE(factor_files(scene, 1, folder));
      scene.analysis.type = AnalysisType::quasi_static;
    }
    const SpaceLeft too_little(0.3 * needed);
    EXPECT_FALSE(factor_files(scene, 1, folder));
    EXPECT_THROW(require_memory(scene, 1, folder), InputError);
  }

  TEST(Memory, MoreRowsThanCanBeUsedAreRefused)
  {
    const auto refusal   = [](const Scene &scene) { return thrown_text([&] { require_memory(scene); }); };
    Scene scene          = model_a();
    scene.analysis.model = ModelType::closed_form;
    scene.drive          = Drive(DriveProfile::harmonic, 0., 65., 112., 1e3);
    EXPECT_EQ(refusal(scene), "");
    scene.drive = Drive(DriveProfile::harmonic, 0., 65., 112., 1e5);
    EXPECT_NE(refusal(scene).find("Analysis/Step make 1.3e+07 rows"), std::string::npos) << refusal(scene);
    // 1.3e10 s in steps of 0.8 ms, to which adaptive ones may grow.
    scene.drive          = Drive(DriveProfile::triangle, 0., 65., 1e-8, 1.);
    scene.analysis.type  = AnalysisType::transient;
    scene.analysis.model = ModelType::beam;
    EXPECT_NE(refusal(scene).find("Time/Step make 1.625e+13 rows"), std::string::npos) << refusal(scene);
  }
} // namespace
