// SPDX-License-Identifier: GPL-3.0-only
#include "base/text.h"
#include "input/analysis_texts.h"
#include "messages.h"
#include "scene/scene.h"
#include "support/temporary_folder.h"

#include <cmath>

using namespace sprag;

namespace
{
  const std::string header = "time [s], x [mm], P [N], Q [N]\n";

  /// Rows of x over time there and back.
  std::string rows(const std::size_t number = 40)
  {
    std::string text;
    for (std::size_t i = 0; i < number; ++i)
    {
      const double x = 60. * std::sin(M_PI * static_cast<double>(i) / static_cast<double>(number - 1));
      text += number_text(0.01 * static_cast<double>(i)) + ", " + number_text(x) + ", " + number_text(0.2 * x) + ", " +
              number_text(0.1 * x) + '\n';
    }
    return text;
  }

  Messages identification(const std::string &table, const Messages &more = {})
  {
    Messages all = { "Analysis/Type=identification", "Identification/Table=" + table };
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  class ReadIdentification : public ::testing::Test
  {
  protected:
    const TemporaryFolder folder;

    Scene scene(const std::string &text, const Messages &more = {}) const
    {
      return make_scene(identification(folder.write("stroke.csv", text), more));
    }

    /// Returns the message about a table or other settings, without the table's path.
    std::string mistake(const std::string &text, const Messages &more = {}) const
    {
      const auto messages = thrown_messages([&] { scene(text, more); });
      EXPECT_EQ(messages.size(), 1u);
      return messages.empty() ? "none" : messages.front();
    }

    /// Thirty rows whose first column begins at 0 and grows by `step`.
    static std::string steady(const double step)
    {
      std::string text;
      for (int i = 0; i < 30; ++i)
        text += number_text(step * i) + ", 1\n";
      return text;
    }

    void expect_mistake(const std::string &part, const std::string &text, const Messages &more = {}) const
    {
      const auto found = mistake(text, more);
      EXPECT_NE(found.find(part), std::string::npos) << found;
    }
  };
} // namespace

TEST_F(ReadIdentification, TakesColumnsByNameInTheirUnits)
{
  const auto measured = scene("\xEF\xBB\xBF"
                              "T [ms]; Q [kN]; other; X [cm]\n" +
                              std::string("0;0.001;7;0\n") +
                              [&]
                              {
                                std::string text;
                                for (int i = 1; i < 30; ++i)
                                  text += number_text(10. * i) + "; 0.002; ; " + number_text(0.1 * i) + " # remark\n";
                                return text;
                              }())
                            .identification.measured;
  ASSERT_EQ(measured.rows(), 30u);
  EXPECT_NEAR(measured.time[2], 0.02, 1e-15);
  EXPECT_NEAR(measured.x[2], 2., 1e-12);
  ASSERT_EQ(measured.channels.size(), 1u);
  EXPECT_EQ(measured.channels[0].force, MeasuredForce::drive);
  EXPECT_NEAR(measured.channels[0].values[0], 1., 1e-12);
}

TEST_F(ReadIdentification, SumsSensorsAndChoosesForces)
{
  std::string text = "x [mm], sensor_1 [N], sensor_2 [N], P [N]\n";
  for (int i = 0; i < 30; ++i)
    text += number_text(i) + ", 1, 2, " + (i == 3 ? "" : "5") + '\n';
  const auto all = scene(text).identification.measured;
  ASSERT_EQ(all.channels.size(), 2u);
  EXPECT_TRUE(std::isnan(all.channels[0].values[3]));
  EXPECT_EQ(all.channels[1].force, MeasuredForce::sensors);
  EXPECT_EQ(all.channels[1].values[0], 3.);
  EXPECT_EQ(scene(text, { "Identification/Forces=sensors" }).identification.measured.channels.size(), 1u);
}

TEST_F(ReadIdentification, TellsWhatIsWrongWithTheTable)
{
  expect_mistake("must name a file", "", { "Identification/Table=" });
  expect_mistake("column 'P' has no unit", "time [s], x [mm], P\n" + std::string("0, 0, 1\n"));
  expect_mistake("column 'P': must be in N: 'K' has the dimension K", "x [mm], P [K]\n1, 2\n");
  expect_mistake("has no column P, Q, sensor_sum or sensor_1: it has time, x, F", "time [s], x [mm], F [N]\n0, 0, 1\n");
  expect_mistake("has no column time or x", "P [N]\n1\n");
  expect_mistake("has no column for Q", "x [mm], P [N]\n1, 2\n", { "Identification/Forces=Q" });
  expect_mistake("must have at least 20 rows, has 12", header + rows(12));
  expect_mistake("must be the names of the columns", rows());
  expect_mistake("stroke.csv:3: has 3 cells, the header 4", header + "0, 0, 0, 0\n1, 2, 3\n");
  expect_mistake("numbers need a decimal point: 1.5", "x [mm]; P [N]\n1,5; 2\n");
  expect_mistake("must be a number", "x [mm], P [N]\nnine, 2\n");
  expect_mistake("row 2: time must not be less", "time [s], P [N]\n" + steady(-1.));
  expect_mistake("where the cylinder reaches the pivot", "x [mm], P [N]\n" + steady(10.));
  expect_mistake("x must be >= 0, it is negative in 29 of 30 rows, down to -29 mm in row 30: give x the other sign",
                 "x [mm], P [N]\n" + steady(-1.));
  expect_mistake("the drive ends at", "time [s], P [N]\n" + steady(1.));
}

TEST_F(ReadIdentification, TellsWhatIsWrongWithTheUnknowns)
{
  const auto expect_wrong = [&](const std::string &unknowns, const std::string &part)
  { expect_mistake(part, header + rows(), { "Identification/Unknowns=" + unknowns }); };
  expect_wrong("mu, stifness", "'stifness' is no unknown");
  expect_wrong("mu, mu", "names 'mu' twice");
  expect_wrong("mu, friction factor", "can have one of mu, mu polynomial");
  expect_mistake("lag needs a column time", "x [mm], P [N]\n" + steady(1.), { "Identification/Unknowns=mu, lag" });
  expect_mistake("must be at least 4 speeds that increase", header + rows(),
                 { "Identification/Unknowns=mu table", "Identification/Friction speeds=10, 5, 20, 30" });
}

TEST_F(ReadIdentification, RefusesAnApparatusThatItDoesNotIdentify)
{
  const auto expect_refusal = [&](const std::string &change, const std::string &part)
  { expect_mistake(part, header + rows(), { change }); };
  expect_refusal("Rotational spring/Type=leaf", "must be torsional");
  expect_refusal("Mirrored pair/Type=full", "must be half");
  expect_refusal("Support/Type=sprung", "must be rigid");
  expect_refusal("Analysis/Model=finite element", "must be closed form, rigid, beam or condensed");
}
