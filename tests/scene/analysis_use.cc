// SPDX-License-Identifier: GPL-3.0-only
#include "scene/analysis_use.h"

#include "base/errors.h"
#include "input/read.h"
#include "scene/scene.h"
#include "support/shipped.h"
#include "support/thrown.h"

#include <filesystem>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  std::string refusal(const std::vector<std::string> &overrides)
  {
    return thrown_text([&] { shipped("model-a", overrides); });
  }
} // namespace

TEST(Accuracy, NamesAreThoseOfTheAnalysis)
{
  EXPECT_NE(refusal({ "Accuracy/Target=0.01", "Accuracy/Quantity=P, growth_rate" }).find("'growth_rate' is none of P, Q"),
            std::string::npos);
  EXPECT_NE(refusal({ "Analysis/Model=auto" }).find("auto needs Accuracy/Target"), std::string::npos);
  EXPECT_NE(refusal({ "Accuracy/Target=0.01", "Analysis/Type=modal" }).find("Accuracy/Target"), std::string::npos);
  EXPECT_EQ(refusal({ "Accuracy/Target=0.01", "Analysis/Type=slope" }).find("Analysis/Model"), std::string::npos);
  EXPECT_EQ(refusal({ "Accuracy/Target=0.01", "Accuracy/Quantity=P, largest_pressure", "Analysis/Model=auto" }), "");
}

TEST(Accuracy, ContactIsEnforcedByMultipliersWhereThatIsCheap)
{
  const auto enforcement = [](const std::vector<std::string> &overrides)
  { return shipped("model-a", overrides).contact.enforcement; };
  EXPECT_EQ(enforcement({}), Enforcement::augmented_lagrangian);
  EXPECT_EQ(enforcement({ "Analysis/Dimension=3" }), Enforcement::augmented_lagrangian);
  EXPECT_EQ(enforcement({ "Contact/Penalty=500" }), Enforcement::penalty);
  EXPECT_EQ(enforcement({ "Mesh/Degree=1" }), Enforcement::penalty);
  EXPECT_EQ(enforcement({ "Analysis/Type=transient", "Analysis/Model=condensed" }), Enforcement::penalty);
  EXPECT_EQ(enforcement({ "Lever/Material=neo-Hookean", "Analysis/Plane=strain" }), Enforcement::penalty);
  EXPECT_EQ(enforcement({ "Contact/Enforcement=penalty" }), Enforcement::penalty);
}
