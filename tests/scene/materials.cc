// SPDX-License-Identifier: GPL-3.0-only
#include "input/section.h"

#include "input/sections.h"
#include "scene/messages.h"
#include "scene/scene.h"

#include <array>
#include <regex>

using namespace sprag;

namespace
{
  /// Returns the value of a cell in the unit of the lever's parameter of this name.
  double in_own_unit(const std::string &name, const std::string &cell)
  {
    SceneSettings settings;
    const auto parameters = scene_parameters(settings);
    return std::stod(kept_value(find_parameter(parameters, "Lever/" + name)->rule, cell));
  }

  Scene with_layer(const std::string &lines, const std::vector<std::string> &overrides = {})
  {
    return read_scene(written("subsection Friction layer\n" + lines + "end\n"), overrides);
  }
} // namespace

TEST(Materials, EveryRowIsASolidWithASourceWithinItsRange)
{
  ASSERT_GT(materials().size(), 15);
  for (const auto &[name, material] : materials())
  {
    if (name == "none")
      continue;
    const double E   = in_own_unit("Young's modulus", material.at("Young's modulus"));
    const double nu  = in_own_unit("Poisson's ratio", material.at("Poisson's ratio"));
    const double rho = in_own_unit("Density", material.at("Density"));
    std::smatch range;
    ASSERT_TRUE(std::regex_match(material.at("range of Young's modulus"), range, std::regex("(.*) to (.*) ([MG]Pa)"))) << name;
    EXPECT_GE(E, in_own_unit("Young's modulus", range.str(1) + ' ' + range.str(3))) << name;
    EXPECT_LE(E, in_own_unit("Young's modulus", range.str(2) + ' ' + range.str(3))) << name;
    // Solids for parts lie between cork or rubber and steel or copper.
    EXPECT_TRUE(E >= 1. && E <= 2.2e5) << name << ": " << E << " MPa";
    EXPECT_TRUE(nu >= 0. && nu < 0.49991) << name << ": " << nu;
    EXPECT_TRUE(rho >= 1.2e-10 && rho <= 9e-9) << name << ": " << rho << " t/mm3";
    // A bar's speed of sound is 35 m/s in soft rubber and 5200 m/s in the lightest metals.
    EXPECT_TRUE(std::sqrt(E / rho) > 3e4 && std::sqrt(E / rho) < 5.3e6) << name << ": " << std::sqrt(E / rho) << " mm/s";
    EXPECT_TRUE(std::regex_search(material.at("source"), std::regex(R"(\((19|20)\d\d\)|\[[AK]\]|MIL-HDBK)"))) << name;
  }
}

TEST(Materials, FillWhatTheSectionLeavesOut)
{
  const Scene scene = with_layer("set Made of = natural rubber\n set Young's modulus = 4.5\n");
  EXPECT_EQ(scene.layer.young_modulus, 4.5);
  EXPECT_EQ(scene.layer.poisson_ratio, 0.4996);
  EXPECT_DOUBLE_EQ(scene.layer.density, 9.5e-10);
  EXPECT_EQ(scene.lever.young_modulus, Lever().young_modulus);
  EXPECT_EQ(scene.specified, (std::set<std::string>{ "Friction layer/Made of", "Friction layer/Young's modulus" }));
  const auto text = parameters_text(scene);
  EXPECT_NE(text.find("given as that of natural rubber; default: 0\n"), std::string::npos) << text;
  const Scene again = read_scene(written(text));
  EXPECT_EQ(again.layer.density, scene.layer.density);
}

TEST(Materials, OfTheCommandLineOrAStudyReplaceThoseOfTheFile)
{
  const std::string own = "set Made of = cork\n set Young's modulus = 30\n";
  const Scene file      = with_layer(own);
  EXPECT_EQ(file.layer.young_modulus, 30.);
  const Scene rubber = variant(file, { "Friction layer/Made of=natural rubber" });
  EXPECT_EQ(rubber.layer.young_modulus, 2.2);
  EXPECT_EQ(variant(rubber, { "Lever/Depth=10" }).layer.young_modulus, 2.2);
  EXPECT_EQ(variant(rubber, { "Friction layer/Made of=PTFE" }).layer.poisson_ratio, 0.46);
  EXPECT_EQ(variant(rubber, { "Friction layer/Young's modulus=3" }).layer.young_modulus, 3.);
  EXPECT_EQ(variant(rubber, { "Friction layer/Made of=none" }).layer.poisson_ratio, FrictionLayer().poisson_ratio);
  EXPECT_EQ(with_layer(own, { "Friction layer/Made of=PTFE", "Friction layer/Density=1e-9" }).layer.density, 1e-9);
  EXPECT_EQ(with_layer(own, { "Friction layer/Made of=PTFE" }).layer.young_modulus, 500.);
  // A modulus of --set stays in each row of a study over materials.
  const Scene study = with_layer(own, { "Friction layer/Young's modulus=4.5" });
  for (const Scene &row : { variant(study, { "Friction layer/Made of=PTFE" }),
                            variant(variant(study, { "Lever/Depth=10" }), { "Friction layer/Made of=PTFE" }) })
  {
    EXPECT_EQ(row.layer.young_modulus, 4.5);
    EXPECT_EQ(row.layer.poisson_ratio, 0.46);
  }
}

TEST(Materials, UnknownOrWithoutEffectAreMistakes)
{
  const auto unknown = find_mistakes({ "Lever/Made of=stell" });
  ASSERT_EQ(unknown.size(), 1);
  EXPECT_NE(unknown.front().find("did you mean 'steel'?"), std::string::npos) << unknown.front();
  EXPECT_EQ(find_mistakes({ "Lever/Material=steel" }).front(),
            "--set: Lever/Material = steel: must be one of linear | neo-Hookean; Lever/Made of can be steel");
  const auto idle = mistakes("subsection Friction layer\nset Made of = PTFE\nset Young's modulus = 20\nset Poisson's ratio = 0\n"
                             "set Density = 2e-10\nend\n");
  ASSERT_EQ(idle.size(), 1);
  EXPECT_NE(idle.front().find("sets other constants"), std::string::npos) << idle.front();
}
