// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/stability/stability.h"
#include "analysis/study/study_points.h"
#include "base/errors.h"
#include "base/ranges.h"
#include "base/text.h"
#include "input/read.h"
#include "input/scene_key.h"
#include "input/sections.h"
#include "levers/dynamics.h"
#include "levers/prepared_scene.h"
#include "mpi_environment.h"
#include "scene/held_slide.h"
#include "scene/scene.h"
#include "support/temporary_folder.h"

#include <functional>
#include <gtest/gtest.h>
#include <set>

// Each parameter that the program declares is changed in turn: what is shared between scenes must be what the changed scene makes
// for itself.

using namespace sprag;

namespace
{
  using Changes = std::vector<std::string>;

  std::vector<Parameter> declared()
  {
    static SceneSettings settings;
    return scene_parameters(settings);
  }

  const std::string &value_in(const Scene &scene, const std::string &name)
  {
    return scene.parameters->at(name);
  }

  std::vector<std::string> other_numbers(const std::string &value)
  {
    const auto number = leading_number(value);
    if (!number || number->value == 0.)
      return { "0.01", "1e-6", "1", "30", "100", "-1e-3" };
    return { number_text(1.01 * number->value), number_text(0.99 * number->value), number_text(1. + number->value) };
  }

  /// Values that may do in place of the present one.
  std::vector<std::string> others(const Parameter &parameter, const std::string &value, const TemporaryFolder &folder)
  {
    using Kind = Rule::Kind;
    std::vector<std::string> result;
    switch (parameter.rule.kind)
    {
    case Kind::number:
    case Kind::number_or_auto:
      return other_numbers(value);
    case Kind::integer:
    {
      const auto number = static_cast<int>(leading_number(value)->value);
      for (const int other : { number + 1, number - 1, 2 * number })
        result.push_back(std::to_string(other));
      return result;
    }
    case Kind::numbers:
      return { number_text(1.01 * parse_numbers(value).front() + 0.01) + value.substr(value.find(',')) };
    case Kind::choice:
      return parameter.rule.choices;
    case Kind::text:
      return { (folder.path / "other").string(), "none", "Lever/Width", folder.path };
    case Kind::file:
      break;
    }
    return result;
  }

  /// The scene with another value of one parameter, for each that is admitted.
  std::vector<Scene> changed_scenes(const Scene &scene, const Parameter &parameter, const TemporaryFolder &folder)
  {
    std::vector<Scene> result;
    const auto name  = full_name(parameter);
    const auto value = value_in(scene, name);
    for (const auto &other : others(parameter, value, folder))
      try
      {
        if (other == value)
          continue;
        result.push_back(variant(scene, { name + "=" + other }));
        if (parameter.rule.kind != Rule::Kind::choice)
          break;
      }
      catch (const InputError &)
      {
      }
    return result;
  }

  /// Everything that a scene was read from but what makes it a study's, with what was given among it; else why it was refused.
  std::vector<std::string> read_or_refused(const std::function<Scene()> &read)
  {
    std::vector<std::string> result;
    try
    {
      const Scene scene = read();
      for (const auto &[name, value] : *scene.parameters)
        if (name.rfind("Study/", 0) != 0)
          result.push_back(name + (scene.specified.count(name) > 0 ? " given as " : " is ") + value);
      result.push_back(scene.accuracy.is_model_open ? "open model" : "fixed model");
    }
    catch (const InputError &)
    {
      result.push_back("refused");
    }
    return result;
  }

  std::string table(const std::string &header, const std::vector<std::pair<double, double>> &rows)
  {
    std::string text = header + '\n';
    for (const auto &[first, second] : rows)
      text += number_text(first) + ',' + number_text(second) + '\n';
    return text;
  }

  /// A table of both ends of a stroke, scaled.
  std::string drive_table(const double stroke)
  {
    return table("time,x", { { 0., 0. }, { 0.2, 0.3 * stroke }, { 0.4, 0.8 * stroke }, { 0.6, stroke }, { 1.2, 0. } });
  }

  std::string friction_table(const double mu)
  {
    return table("speed,mu", { { 0., mu }, { 50., 1.1 * mu }, { 100., 1.2 * mu }, { 200., 1.3 * mu } });
  }

  /// A bar meshed by a script that includes its depth.
  std::string mesh_script()
  {
    return "Include \"depth.geo\";\n"
           "Point(1) = {10, 46.6, 0}; Point(2) = {210, 46.6, 0}; Point(3) = {210, 46.6 + h, 0}; Point(4) = {10, 46.6 + h, 0};\n"
           "Point(5) = {10, 45.6, 0}; Point(6) = {210, 45.6, 0};\n"
           "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};\n"
           "Line(5) = {5, 6}; Line(6) = {6, 2}; Line(7) = {1, 5};\n"
           "Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};\n"
           "Curve Loop(2) = {5, 6, -1, 7}; Plane Surface(2) = {2};\n"
           "Transfinite Curve {1, 3, 5} = 31; Transfinite Curve {2, 4} = 3; Transfinite Curve {6, 7} = 2;\n"
           "Transfinite Surface {1, 2}; Recombine Surface {1, 2};\n"
           "Physical Surface(\"lever\") = {1}; Physical Surface(\"layer\") = {2};\n"
           "Physical Curve(\"friction face\") = {5}; Physical Curve(\"hub\") = {4};\n";
  }

  Scene make_scene(const TemporaryFolder &folder, const Changes &more)
  {
    Changes changes = { "Analysis/Type=stability", "Analysis/Model=condensed", "Mesh/Face size=8", "Condensed/Modes=3",
                        "Condensed/Cache=" + (folder.path / "cache").string() };
    changes.insert(changes.end(), more.begin(), more.end());
    return read_scene(folder.write("scene.prm", ""), changes);
  }

  /// The lever of model A, coarse.
  Scene bar(const TemporaryFolder &folder)
  {
    return make_scene(folder, {});
  }

  Scene frame_with_plate(const TemporaryFolder &folder)
  {
    return make_scene(folder, { "Lever/Outline=frame", "Friction plate/Type=on sensors", "Cylinder/Type=solid",
                                "Cylinder/Face size=5", "Support/Type=sprung", "Lever/Tip mass=1e-5", "Lever/Hub inertia=0.1" });
  }

  Scene pair_on_leaves(const TemporaryFolder &folder)
  {
    return make_scene(folder, { "Mirrored pair/Type=full", "Mesh/Degree=1", "Rotational spring/Type=leaf",
                                "Mirrored pair/Joint mass=1e-4", "Lever/Inertia=as built", "Drive/Profile=harmonic",
                                "Friction/Law=Coulomb" });
  }

  Scene from_files(const TemporaryFolder &folder)
  {
    folder.write("depth.geo", "h = 20;\n");
    return make_scene(folder, { "Mesh/File=" + folder.write("lever.geo", mesh_script()), "Drive/Profile=table",
                                "Drive/Table=" + folder.write("drive.csv", drive_table(60.)), "Friction/Law=table",
                                "Friction/Table=" + folder.write("mu.csv", friction_table(0.5)),
                                "Identification/Table=" + folder.write("stroke.csv", drive_table(3.)),
                                "Isolation/Base table=" + folder.write("base.csv", drive_table(1.)),
                                "Isolation/Loop table=" + folder.write("loop.csv", drive_table(2.)) });
  }

  /// Everything that a basis is, and the mesh below it.
  std::vector<double> collect_content(const MeshedLever &lever)
  {
    std::vector<double> result;
    for (const auto &vertex : lever.triangulation.get_vertices())
      result.insert(result.end(), { vertex[0], vertex[1] });
    for (const auto &cell : lever.triangulation.active_cell_iterators())
      result.push_back(cell->material_id());
    for (const auto &point : lever.body->friction_face().points)
      result.push_back(point.weight);
    const auto add = [&](const dealii::FullMatrix<double> &matrix)
    {
      for (unsigned int i = 0; i < matrix.m(); ++i)
        for (unsigned int j = 0; j < matrix.n(); ++j)
          result.push_back(matrix(i, j));
    };
    for (const auto &basis : { lever.condensed.lever, lever.condensed.swinging })
      if (basis)
      {
        result.insert(result.end(), basis->stiffness.begin(), basis->stiffness.end());
        result.insert(result.end(), { basis->density_factor, basis->total_mass, basis->moment_of_inertia });
        for (const auto *const matrix : { &basis->shapes, &basis->layer_stiffness, &basis->face_compliance })
          add(*matrix);
        for (const auto &displacement : basis->displacements)
          result.insert(result.end(), displacement.begin(), displacement.end());
      }
    return result;
  }

  /// P and eigenvalues, or why there are none.
  std::string compute_answer(const Scene &scene, const Dynamics &dynamics)
  {
    std::string result;
    try
    {
      const auto found = check_slide(dynamics.model(), held_drive(scene), checked_modes(scene));
      if (found.slide)
        result = number_text(found.slide->forces.P);
      for (const auto &mode : found.modes)
        result += ' ' + number_text(mode.mode.eigenvalue.real()) + ' ' + number_text(mode.mode.eigenvalue.imag());
    }
    catch (const AnalysisError &error)
    {
      result = error.what();
    }
    return result;
  }

  /// The changed scene after `before` in one maker, and from the cache that `before` filled, against the same made afresh.
  void expect_shared_is_fresh(const Scene &before, const Scene &changed, const std::string &what)
  {
    DynamicsMaker sharing(true), reading(true), making(false);
    sharing.make(prepared(before));
    const Scene scene  = prepared(changed);
    const auto fresh   = making.make(scene);
    const auto content = collect_content(*fresh.lever);
    const auto answer  = compute_answer(scene, fresh);
    for (auto *const maker : { &sharing, &reading })
    {
      const auto shared = maker->make(scene);
      EXPECT_TRUE(collect_content(*shared.lever) == content) << what << (maker == &sharing ? ": shared" : ": from the cache");
      EXPECT_EQ(compute_answer(scene, shared), answer) << what;
    }
  }

  /// A scene that was changed in memory, as roles do it, not by its parameters.
  Scene in_memory(const Scene &changed, const Scene &before)
  {
    Scene result      = changed;
    result.parameters = before.parameters;
    return result;
  }

  bool is_bound(const Scene &before, const Scene &changed, const std::string &name)
  {
    const auto value = [&](const Scene &scene)
    {
      SceneSettings settings;
      settings.scene = scene;
      for (const auto &parameter : scene_parameters(settings))
        if (full_name(parameter) == name)
          return parameter.default_value;
      return std::string();
    };
    return value(before) != value(changed);
  }

  bool all(const Parameter &)
  {
    return true;
  }

  bool none(const Parameter &)
  {
    return false;
  }

  /// Changes each parameter, notes the ones that the scene admits and compares what is shared under one of its values.
  void change_each(const Scene &scene, const TemporaryFolder &folder, const std::function<bool(const Parameter &)> &compare,
                   std::set<std::string> &admitted)
  {
    const auto key      = scene_key(scene);
    const auto body     = body_key(scene);
    unsigned int shared = 0;
    std::set<std::string> compared;
    for (const auto &parameter : declared())
      for (const Scene &changed : changed_scenes(scene, parameter, folder))
      {
        const auto name = full_name(parameter);
        const auto what = name + " = " + value_in(changed, name);
        admitted.insert(name);
        EXPECT_NE(scene_key(changed), key) << what;
        const bool shares = body_key(changed) == body && is_meshed(changed.analysis.model);
        if (is_bound(scene, changed, name))
        {
          EXPECT_EQ(body_key(in_memory(changed, scene)) == body, body_key(changed) == body) << what;
        }
        shared += shares ? 1 : 0;
        if (shares && compare(parameter) && compared.insert(name).second)
          expect_shared_is_fresh(scene, changed, what);
      }
    EXPECT_TRUE(shared > 50 || !is_meshed(scene.analysis.model)) << shared;
  }
} // namespace

TEST(EveryParameter, OfALeverIsSharedWhereItDoesNotCount)
{
  const TemporaryFolder folder;
  std::set<std::string> admitted;
  change_each(
      bar(folder), folder, [](const Parameter &parameter) { return parameter.section == "Lever"; }, admitted);
}

TEST(EveryParameterSlow, OfABarIsSharedWhereItDoesNotCount)
{
  const TemporaryFolder folder;
  std::set<std::string> admitted;
  change_each(bar(folder), folder, all, admitted);
}

TEST(EveryParameterSlow, OfAFrameAndOfAPairIsSharedWhereItDoesNotCount)
{
  const TemporaryFolder folder;
  std::set<std::string> admitted;
  change_each(frame_with_plate(folder), folder, all, admitted);
  change_each(pair_on_leaves(folder), folder, all, admitted);
}

TEST(EveryParameter, BelongsToTheKeysOfSomeScene)
{
  const TemporaryFolder folder;
  std::set<std::string> admitted;
  const Changes statics = { "Analysis/Type=quasi-static", "Analysis/Model=finite element", "Analysis/Plane=strain" };
  const Changes in_time = { "Analysis/Type=transient", "Analysis/Model=rigid", "Friction/Law=Stribeck" };
  for (const Scene &scene : { bar(folder), frame_with_plate(folder), pair_on_leaves(folder), make_scene(folder, statics),
                              make_scene(folder, in_time), from_files(folder) })
    change_each(scene, folder, none, admitted);
  std::set<std::string> missing;
  for (const auto &parameter : declared())
    if (parameter.rule.kind != Rule::Kind::file && admitted.count(full_name(parameter)) == 0)
      missing.insert(full_name(parameter));
  EXPECT_EQ(missing, std::set<std::string>());
}

TEST(EveryParameter, OfAStudysRowIsThatOfTheRunAlone)
{
  const TemporaryFolder folder;
  const auto file = folder.write("scene.prm", "");
  for (const Changes &changes : { Changes{ "Analysis/Type=quasi-static", "Analysis/Model=finite element" },
                                  Changes{ "Analysis/Type=transient", "Analysis/Model=beam" },
                                  Changes{ "Analysis/Type=stability", "Analysis/Model=auto", "Accuracy/Target=0.01" } })
  {
    const Scene base      = read_scene(file, changes);
    const auto type       = base.parameters->at("Analysis/Type");
    unsigned int accepted = 0;
    for (const auto &parameter : declared())
      for (const auto &value : others(parameter, value_in(base, full_name(parameter)), folder))
        try
        {
          const auto name   = full_name(parameter);
          const Scene study = read_scene(
              file, joined(changes, { "Analysis/Type=study", "Study/Type=" + type, "Study/Vary=" + name + " = " + value }));
          const auto row   = read_or_refused([&] { return scene_at(study, { 0 }); });
          const auto alone = read_or_refused(
              [&] {
                return read_scene(file, joined(changes, { name + "=" + value, "Output/Fields=none" }));
              });
          EXPECT_EQ(row, alone) << name << " = " << value;
          ++accepted;
        }
        catch (const InputError &)
        {
          break; // it cannot be varied
        }
    EXPECT_GT(accepted, 150u) << type;
  }
}

// The grading follows P of the closed form.
TEST(EveryParameter, FrictionAndSpeedCountWhereFacesAreGradedByForces)
{
  const TemporaryFolder folder;
  const auto with = [&](std::vector<std::string> changes)
  {
    changes.push_back("Friction/Law=cork on aluminium");
    return read_scene(folder.write("graded.prm", ""), changes);
  };
  const auto graded = body_key(with({}));
  for (const char *const change : { "Friction/Factor=0.1", "Drive/Speed=5" })
  {
    EXPECT_NE(body_key(with({ change })), graded) << change;
    EXPECT_EQ(body_key(with({ change, "Mesh/Faces in contact=0" })), body_key(with({ "Mesh/Faces in contact=0" }))) << change;
  }
}

TEST(EveryParameter, SparedOnesAreDeclared)
{
  std::set<std::string> names, sections;
  for (const auto &parameter : declared())
  {
    names.insert(full_name(parameter));
    sections.insert(parameter.section);
  }
  for (const auto &name : spared_parameters())
    EXPECT_EQ(names.count(name), 1u) << name;
  for (const auto &section : spared_sections())
    EXPECT_EQ(sections.count(section), 1u) << section;
}

TEST(EveryParameter, AMeshIsMadeAnewWhenItsFileChangesInOneProcess)
{
  const TemporaryFolder folder;
  const Scene scene = from_files(folder);
  DynamicsMaker maker(false);
  const auto before = maker.make(scene).lever;
  EXPECT_EQ(maker.make(scene).lever, before);
  folder.write("depth.geo", "h = 21;\n");
  EXPECT_NE(collect_content(*maker.make(scene).lever), collect_content(*before));
}
