// SPDX-License-Identifier: GPL-3.0-only
#include "base/parameters.h"

#include "base/errors.h"
#include "base/table_file.h"
#include "base/text.h"
#include "base/units.h"
#include "scene/scene.h"
#include "support/thrown.h"
#include "support/written.h"

#include <cmath>
#include <deal.II/base/parameter_handler.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

using namespace sprag;

namespace
{
  Rule number(const Interval &interval, const std::string &unit = "")
  {
    return { Rule::Kind::number, interval, unit, {} };
  }

  std::vector<Parameter> declared()
  {
    return { { "Geometry", "Cylinder radius", "56", number(above(0.), "mm"), "Radius R", {} },
             { "Geometry", "Pivot height", "0", number(any_number(), "mm"), "Height h", {} },
             { "Drive", "Profile", "triangle", { Rule::Kind::choice, {}, "", { "triangle", "harmonic" } }, "Motion", {} },
             { "Drive", "Table", "", {}, "File", {} },
             { "Friction", "Coefficient", "0.73", number(at_least(0.)), "mu", {} },
             { "Mesh", "Degree", "2", { Rule::Kind::integer, { 1., 2. }, "", {} }, "Degree", {} },
             { "Mesh", "Penalty", "auto", { Rule::Kind::number_or_auto, above(0.), "N/mm3", {} }, "Penalty", {} },
             { "Mesh", "Ratios", "0, 0.5", { Rule::Kind::numbers, { 0., 1., true, false }, "", {} }, "Ratios", {} } };
  }

  Settings read(const std::string &text, const std::vector<std::string> &overrides = {})
  {
    return read_settings(written(text), overrides, declared());
  }

  /// The mistakes with the folder of the file left out.
  std::vector<std::string> mistakes(const std::string &text, const std::vector<std::string> &overrides = {})
  {
    return without_folder(read(text, overrides).mistakes);
  }

  using Messages = std::vector<std::string>;

  /// The mistakes with one value, the first line of which follows that of the section.
  std::vector<std::string> mistakes_with(const std::string &section, const std::string &name, const std::string &value)
  {
    return mistakes("subsection " + section + "\n set " + name + " = " + value + "\nend\n");
  }

  ParameterValues to_values(const std::map<std::string, Setting> &specified)
  {
    ParameterValues values;
    for (const auto &[name, setting] : specified)
      values[name] = setting.value;
    return values;
  }

  /// The columns speed and mu of a text.
  std::vector<NamedColumn> friction_columns(const std::string &text)
  {
    return read_two_columns(written(text, "mu.csv"), { "speed", "v" }, { "mu", "coefficient" }).columns;
  }

  /// Returns what is said of them, from the name of the file on where it is there.
  std::string complaint(const std::string &text)
  {
    const auto said = thrown_text(
        [&]
        {
          const auto columns = friction_columns(text);
          values_in("mm/s", columns[0]);
          values_in("", columns[1]);
        });
    const auto file = said.find("mu.csv");
    return file == std::string::npos ? said : said.substr(file);
  }
} // namespace

TEST(Parameters, GivenValuesAreReadWithTheirPlaces)
{
  const auto settings = read("# a comment\n"
                             "subsection  Geometry # another\n"
                             "  set Cylinder   radius = 21.1 # mm\n"
                             "end\r\n"
                             "SUBSECTION Drive\n"
                             "  SET Profile \\\n"
                             "    = harmonic\n"
                             "  set Table = a b/c=d.csv\n"
                             "END\n");
  EXPECT_TRUE(settings.mistakes.empty());
  ASSERT_EQ(settings.specified.size(), 3u);
  EXPECT_EQ(settings.specified.at("Geometry/Cylinder radius").value, "21.1");
  EXPECT_EQ(settings.specified.at("Geometry/Cylinder radius").place, settings.file + ":3");
  EXPECT_EQ(settings.specified.at("Drive/Profile").value, "harmonic");
  EXPECT_EQ(settings.specified.at("Drive/Profile").place, settings.file + ":6");
  EXPECT_EQ(settings.specified.at("Drive/Table").value, "a b/c=d.csv");
}

TEST(Parameters, UnknownNamesAreReportedWithTheNearest)
{
  EXPECT_EQ(mistakes("subsection Geometry\n set Cylinder radus = 5\n set Nothing like it at all = 5\nend\n"),
            (Messages{ "scene.prm:2: Geometry/Cylinder radus = 5: no such parameter; did you mean 'Cylinder radius'?",
                       "scene.prm:3: Geometry/Nothing like it at all = 5: no such parameter" }));
  EXPECT_EQ(mistakes("subsection Geometry\n set Coefficient = 5\nend\n"),
            (Messages{ "scene.prm:2: Geometry/Coefficient = 5: no such parameter; did you mean 'Friction/Coefficient'?" }));
}

TEST(Parameters, UnknownSectionsAreReportedOnceAndStillRead)
{
  EXPECT_EQ(mistakes("subsection geometri\n set Cylinder radius = -5\nend\nsubsection Completely other\n set A = 1\nend\n"),
            (Messages{ "scene.prm:1: subsection geometri: no such subsection; did you mean 'Geometry'?",
                       "scene.prm:2: Geometry/Cylinder radius = -5: must be a number > 0 [mm]",
                       "scene.prm:4: subsection Completely other: no such subsection" }));
}

// Values follow from the definitions of the units: 1 in = 25.4 mm, 1 N = 1 kg m/s2.
TEST(Parameters, NumbersMayHaveUnitsThatAreConverted)
{
  const auto settings = read("subsection Geometry\n set Cylinder radius = 5.6 cm\n set Pivot height = -1 in\nend\n"
                             "subsection Friction\n set Coefficient = 73%\nend\n"
                             "subsection Mesh\n set Penalty = 2 GPa/m\n set Ratios = 5 %, 10 %\nend\n");
  EXPECT_TRUE(settings.mistakes.empty()) << settings.mistakes[0];
  const auto values = to_values(settings.specified);
  EXPECT_EQ(values.at("Geometry/Cylinder radius"), "56");
  EXPECT_EQ(values.at("Geometry/Pivot height"), "-25.4");
  EXPECT_EQ(values.at("Friction/Coefficient"), "0.73");
  EXPECT_EQ(values.at("Mesh/Penalty"), "2");
  EXPECT_EQ(values.at("Mesh/Ratios"), "0.05, 0.1");
  EXPECT_EQ(settings.specified.at("Geometry/Cylinder radius").written, "5.6 cm");

  const auto text = parameters_text(declared(), values, { { "Geometry/Cylinder radius", "5.6 cm" } });
  EXPECT_NE(text.find("set Cylinder radius = 56    # given as 5.6 cm\n"), std::string::npos) << text;
  EXPECT_EQ(to_values(read(text).specified).at("Geometry/Cylinder radius"), "56");
}

TEST(Parameters, AUnitBehindTheLastNumberIsThatOfAll)
{
  const auto common = [](const Messages &numbers) { return with_common_unit(number(any_number(), "mm"), numbers); };
  EXPECT_EQ(common({ "1", "3 cm" }), (Messages{ "1 cm", "3 cm" }));
  EXPECT_EQ(common({ "1", "auto", "2 cm", "3 cm" }), (Messages{ "1 cm", "auto", "2 cm", "3 cm" }));
  EXPECT_EQ(common({ "1", "2" }), (Messages{ "1", "2" }));
  EXPECT_EQ(common({ "1 cm", "2 mm" }), (Messages{ "1 cm", "2 mm" }));
  for (const Messages &unclear : { Messages{ "1 cm", "3" }, { "1 mm", "3", "5 cm" } })
    EXPECT_THROW(common(unclear), InputError);
  // 1 is a number of its own: 1 +- 25 % are not 0.01 +- 0.25.
  EXPECT_THROW(with_common_unit(number(any_number()), { "1", "25 %" }), InputError);
  EXPECT_EQ(mistakes("subsection Mesh\n set Ratios = 5 %, 0.1\nend\n").at(0),
            "scene.prm:2: Mesh/Ratios = 5 %, 0.1: has numbers with and without unit: each must have one, or none");
}

TEST(Parameters, UnitsOfAnotherDimensionAreRefused)
{
  const auto radius       = [](const std::string &value) { return mistakes_with("Geometry", "Cylinder radius", value).at(0); };
  const std::string begin = "scene.prm:2: Geometry/Cylinder radius = ";
  EXPECT_EQ(radius("56 N"), begin + "56 N: must be a number > 0 [mm]: 'N' has the dimension m.kg.s-2, mm has the dimension m");
  EXPECT_EQ(radius("56 mn"), begin + "56 mn: must be a number > 0 [mm]: there is no unit 'mn'");
  EXPECT_EQ(radius("56 mm 10"), begin + "56 mm 10: must be a number > 0 [mm]: there is no unit 'mm 10'");
  EXPECT_EQ(radius("1e308 km"), begin + "1e308 km: must be a number > 0 [mm]: is too large");
  EXPECT_EQ(radius("-1 cm"), begin + "-1 cm: must be a number > 0 [mm]");
  EXPECT_EQ(mistakes("subsection Friction\n set Coefficient = 1 mm\nend\n").at(0),
            "scene.prm:2: Friction/Coefficient = 1 mm: must be a number >= 0: 'mm' has the dimension m, a bare number has no "
            "dimension");
}

// A turn by a radian is no number: 60 rpm are 1 Hz, not 2 pi Hz.
TEST(Units, ARadianIsADimension)
{
  EXPECT_EQ(unit_factor("N m/rad", "N mm/rad"), 1000.);
  EXPECT_NEAR(unit_factor("N mm/deg", "N mm/rad"), 180. / M_PI, 1e-13);
  EXPECT_THROW(unit_factor("N m", "N mm/rad"), InputError);
  EXPECT_THROW(unit_factor("rpm", "Hz"), InputError);
  EXPECT_THROW(unit_factor("s", "Hz"), InputError);
  EXPECT_THROW(unit_factor("N/mm", "N/mm^n"), InputError);
}

TEST(Units, AGramThatDoesNotFitIsGravity)
{
  EXPECT_EQ(unit_factor("g", "mm/s2"), 9806.65);
  EXPECT_EQ(unit_factor("g", "t"), 1e-6);
  EXPECT_NEAR(unit_factor("g^2/Hz", "(mm/s2)^2/Hz"), 9806.65 * 9806.65, 1e-6);
}

TEST(Parameters, AByteOrderMarkIsPassedOver)
{
  const auto settings = read("\xEF\xBB\xBFsubsection Mesh\n set Degree = 1\nend\n");
  EXPECT_TRUE(settings.mistakes.empty()) << settings.mistakes[0];
  EXPECT_EQ(settings.specified.at("Mesh/Degree").value, "1");
}

TEST(Parameters, NumbersMustBeFiniteAndInRange)
{
  for (const std::string value : { "nan", "inf", "-inf", "1e999", "", "big", "0", "-56", "--5", "+-5", "0x10", "5,6" })
  {
    const auto found = mistakes_with("Geometry", "Cylinder radius", value);
    ASSERT_EQ(found.size(), 1u) << value;
    EXPECT_EQ(found[0].rfind("scene.prm:2: Geometry/Cylinder radius = " + value + ": must be a number > 0", 0), 0u) << found[0];
  }
  for (const std::string value : { "56", "+56", "5.6e1", ".5", "5.", "1E-3" })
    EXPECT_TRUE(mistakes_with("Geometry", "Cylinder radius", value).empty()) << value;
}

TEST(Parameters, IntegersListsChoicesAndAutoKeepTheirRules)
{
  EXPECT_EQ(mistakes("subsection Mesh\n set Degree = 1.5\n set Penalty = automatic\n set Ratios = 0.1, 1\nend\n"
                     "subsection Drive\n set Profile = harmonics\nend\n"),
            (Messages{ "scene.prm:2: Mesh/Degree = 1.5: must be an integer >= 1 and <= 2",
                       "scene.prm:3: Mesh/Penalty = automatic: must be auto or a number > 0 [N/mm3]",
                       "scene.prm:4: Mesh/Ratios = 0.1, 1: must be numbers >= 0 and < 1, separated by commas",
                       "scene.prm:7: Drive/Profile = harmonics: must be one of triangle | harmonic; did you mean 'harmonic'?" }));
  EXPECT_TRUE(mistakes("subsection Mesh\n set Degree = 1\n set Penalty = auto\n set Ratios = 0.1, 0.9\nend\n").empty());
}

// 74,000 may be 74 and 74000, and the unit counts.
TEST(Parameters, NoHintIsAThousandTimesOff)
{
  const auto rule = [](const std::string &value)
  {
    const auto said = mistakes_with("Geometry", "Cylinder radius", value).at(0);
    return said.substr(said.rfind("must be a number > 0") + 21);
  };
  EXPECT_EQ(rule("5,6"), "with a decimal point: did you mean '5.6'?");
  EXPECT_EQ(rule("5,6 m"), "with a decimal point: did you mean '5.6 m'?");
  EXPECT_EQ(rule("0,125"), "with a decimal point: did you mean '0.125'?");
  EXPECT_EQ(rule("1234,567"), "with a decimal point: did you mean '1234.567'?");
  for (const std::string unclear : { "74,000", "1.234,5", "1,234.5", "1,234,567" })
    EXPECT_EQ(rule(unclear), "with a decimal point and no separator of thousands") << unclear;
  for (const std::string several : { "5,6,7", "12.5,3" })
    EXPECT_EQ(rule(several), "with a decimal point") << several;
}

TEST(Parameters, AListWithDecimalCommasIsRefused)
{
  const auto rule = [](const std::string &value)
  {
    const auto said = mistakes_with("Mesh", "Ratios", value).at(0);
    return said.substr(said.rfind(": ") + 2);
  };
  EXPECT_EQ(rule("0,5"), "must be '0, 5' for a list, or '0.5'");
  EXPECT_EQ(rule("0,1, 0,5"), "must be '0, 1, 0, 5' for a list, or '0.1, 0.5'");
  EXPECT_EQ(rule("0.1,0.9"), "must be '0.1, 0.9'");
  EXPECT_EQ(rule("0,0,0"), "must be '0, 0, 0'");
  EXPECT_EQ(rule("1,000, 0"), "must have a blank behind each comma between numbers, and no separator of thousands");
}

TEST(Parameters, BrokenStructureIsReported)
{
  EXPECT_EQ(mistakes("set Coefficient = 1\n"),
            (Messages{ "scene.prm:1: Coefficient = 1: must stand inside a subsection; did you mean 'Friction/Coefficient'?" }));
  EXPECT_EQ(mistakes("subsection Drive\n"), (Messages{ "scene.prm:1: subsection Drive: must be closed by a line 'end'" }));
  EXPECT_EQ(mistakes("subsection Drive\nsubsection Mesh\nend\n"),
            (Messages{ "scene.prm:2: subsection Mesh: subsection Drive must be closed by a line 'end' before it" }));
  EXPECT_EQ(mistakes("subsection Drive\nend\nend\n"), (Messages{ "scene.prm:3: end: no subsection is open" }));
  EXPECT_EQ(mistakes("subsection Drive\nend Drive\n"), (Messages{ "scene.prm:2: end Drive: 'end' must stand alone" }));
  EXPECT_EQ(mistakes("subsection Mesh\n set Degree 1\nend\n"),
            (Messages{ "scene.prm:2: set Degree 1: must have the form set Name = value" }));
  EXPECT_EQ(mistakes("subsection Mesh\n sett Degree = 1\nend\n"),
            (Messages{ "scene.prm:2: sett Degree = 1: must begin with subsection, set, end or #; did you mean 'set'?" }));
  EXPECT_EQ(mistakes("include other.prm\n"),
            (Messages{ "scene.prm:1: include other.prm: other files are not included: write their lines here or use --set" }));
}

TEST(Parameters, MistakesInOverridesAreReported)
{
  EXPECT_EQ(mistakes("", { "Degree=1", "Mesh/Degree", "Mesh/Degre=1", "Mash/Degree=3", "Mesh/Degree=2 nodes" }),
            (Messages{ "--set: Degree=1: must have the form Section/Name=value",
                       "--set: Mesh/Degree: must have the form Section/Name=value",
                       "--set: Mesh/Degre = 1: no such parameter; did you mean 'Degree'?",
                       "--set: Mash/Degree = 3: no such section; did you mean 'Mesh'?",
                       "--set: Mesh/Degree = 3: must be an integer >= 1 and <= 2",
                       "--set: Mesh/Degree = 2 nodes: must be an integer >= 1 and <= 2: there is no unit 'nodes'" }));
}

TEST(Parameters, LaterMistakesNamePlaceAndValueInUse)
{
  auto settings = read("subsection Geometry\n set Cylinder radius = 5\nend\n", { "Mesh/Degree=1" });
  add_mistake(settings, declared(), "Geometry/Cylinder radius", "must be more");
  add_mistake(settings, declared(), "Geometry/Pivot height", "must be more");
  add_mistake(settings, declared(), "Mesh/Degree", "must be more");
  EXPECT_EQ(settings.mistakes,
            (Messages{ settings.file + ":2: Geometry/Cylinder radius = 5: must be more",
                       settings.file + ": Geometry/Pivot height = 0: must be more", "--set: Mesh/Degree = 1: must be more" }));
}

TEST(Parameters, PrintedTextReadsBackHereAndInDealII)
{
  const auto specified = read("", { "Geometry/Cylinder radius=21.1", "Drive/Table=a b.csv", "Mesh/Penalty=1000" }).specified;
  const auto text      = parameters_text(declared(), to_values(specified));
  EXPECT_NE(text.find("Radius R [mm]: a number > 0."), std::string::npos) << text;

  const auto again = read(text);
  EXPECT_TRUE(again.mistakes.empty()) << again.mistakes[0];
  EXPECT_EQ(again.specified.size(), declared().size());
  EXPECT_EQ(parameters_text(declared(), to_values(again.specified)), text);
  const auto partly = read(parameters_text(declared(), to_values(specified), {}, { "Geometry/Cylinder radius" })).specified;
  EXPECT_EQ(partly.size(), declared().size() - 1);
  EXPECT_EQ(partly.count("Geometry/Cylinder radius"), 0u);

  dealii::ParameterHandler handler;
  for (const auto &parameter : declared())
  {
    handler.enter_subsection(parameter.section);
    handler.declare_entry(parameter.name, parameter.default_value);
    handler.leave_subsection();
  }
  EXPECT_NO_THROW(handler.parse_input_from_string(text));
  handler.enter_subsection("Geometry");
  EXPECT_EQ(handler.get("Cylinder radius"), "21.1");
}

TEST(Parameters, AnyTextReadsBackAsItWas)
{
  for (const std::string text :
       { "run#3/own.geo", "#", "a # b", "line\nfeed", "back\\", " blank ", "\\x41", "\t\x1b[31m", "\xc2\x9b", "\xc3\xa4" })
  {
    const auto printed = parameters_text(declared(), { { "Drive/Table", text } });
    EXPECT_EQ(read(printed).specified.at("Drive/Table").value, text) << printed;
    EXPECT_EQ(printed.find('\x1b'), std::string::npos);
  }
  EXPECT_EQ(read("subsection Drive\n  set Table = C:\\x.csv # \\x41\nend\n").specified.at("Drive/Table").value, "C:\\x.csv");
}

TEST(Csv, ColumnsMayBeSeparatedByCommasOrWhiteSpace)
{
  const auto columns = friction_columns("# measured\nspeed, mu\n0, 0.3\n10 0.5 # a comment\n\n20;0.7\r\n1e2\t0.9\n");
  EXPECT_EQ(columns[0].values, (std::vector<double>{ 0., 10., 20., 100. }));
  EXPECT_EQ(columns[1].values, (std::vector<double>{ 0.3, 0.5, 0.7, 0.9 }));
}

TEST(Csv, ColumnsAreFoundByNameInTheirUnits)
{
  const std::vector<std::string> headers = { "MU [-], Speed [m/s]",
                                             "\xEF\xBB\xBFmu [%], speed [cm/s]",
                                             "\"Friction coefficient\"; \"sliding speed (mm/s)\"",
                                             "mu\tv/(km/h)",
                                             "# mu [1] speed [m/s]",
                                             "mu speed [m/s]",
                                             "# mu, speed (m/s)\n# measured today",
                                             "# in the lab\n# mu (1); speed (m/s)\n#----" };
  const std::vector<double> speeds       = { 1000., 10., 1., 1e6 / 3600., 1000., 1000., 1000., 1000. };
  for (std::size_t i = 0; i < headers.size(); ++i)
  {
    const auto columns = friction_columns(headers[i] + "\n0.3 0\n0.5 1\n");
    EXPECT_NEAR(values_in("mm/s", columns[0]).at(1), speeds[i], 1e-10) << headers[i];
    EXPECT_NEAR(values_in("", columns[1]).at(1), i == 1 ? 0.005 : 0.5, 1e-15) << headers[i];
  }
  EXPECT_EQ(friction_columns("a, b\n1, 2\n")[0].name, "a");
  const auto wide = read_two_columns(written("mu, T [K], speed\n1, warm, 2\n", "mu.csv"), { "speed" }, { "mu" });
  EXPECT_EQ(wide.columns[0].values, std::vector<double>{ 2. });
  EXPECT_EQ(wide.unused, std::vector<std::string>{ "T" });
}

TEST(Csv, ColumnsThatAreNotClearAreRefused)
{
  EXPECT_EQ(complaint("mu, mu0\n1, 2\n"), "mu.csv: the header 'mu, mu0' has no column 'speed': it has mu, mu0");
  EXPECT_EQ(complaint("v1 v2 mu\n1 2 3\n"), "mu.csv: the header 'v1 v2 mu' has no column 'speed': it has v1, v2, mu");
  EXPECT_EQ(complaint("speed [mm], mu\n1, 2\n"),
            "column 'speed': must be in mm/s: 'mm' has the dimension m, mm/s has the dimension m.s-1");
  EXPECT_EQ(complaint("1, 2\n" + std::string("\0", 1)), "mu.csv: is not a text in UTF-8");
  for (const std::string name : { "speed_km/h", "speed_m/s", "speed in m/s" }) // a slash leaves the unit behind it
    EXPECT_NE(complaint(name + ", mu\n1, 2\n"), "") << name;
  EXPECT_EQ(complaint("speed_kn, mu\n1, 2\n"), "") << "a kilonewton is no speed";
  EXPECT_EQ(complaint("speed_knot, mu\n1, 2\n"),
            "column 'speed_knot': 'knot' may be its unit: must be in brackets, as '[knot]', or not there");
  EXPECT_EQ(complaint("speed_mean, mu_k\n1, 2\n"), "");
}

// Such comments would be passed over beside numbers 1000 times as large.
TEST(Csv, AUnitInACommentIsReadOrRefused)
{
  const auto said = [](const std::string &header) { return complaint(header + "\n0, 1\n0.5, 1\n"); };
  EXPECT_EQ(said("speed, mu\n# [m/s], [-]"),
            "mu.csv:2: the comment '[m/s], [-]' may tell the unit 'm/s', and the column 'speed' has none: write a first line as "
            "'speed [m/s], ...', with [mm/s] where the comment means something else");
  EXPECT_EQ(said("# v (m/s), mu\n# v (cm/s), mu"),
            "mu.csv:1: the comments 'v (m/s), mu' and 'v (cm/s), mu' name different units: one alone may");
  for (const std::string header :
       { "# speed in m/s, mu", "# speeds in m/s.", "# speed_m/s, mu", "# speed m/s, mu", "# m/s, 1", "# v/(m/s), mu",
         "# v/km/h, mu", "# a lab, a day: all speeds [m/s]", "speed, mu # m/s, -", "speed, mu\n# rows of v (m/s) and mu" })
    EXPECT_NE(said(header), "") << header;
  for (const std::string header :
       { "# speed in mm/s, mu", "# in the lab, on 3/4", "# s, mu", "# in m/s\nspeed [mm/s], mu", "# v, mu(v)" })
    EXPECT_EQ(said(header), "") << header;
}

TEST(Csv, NoHintIsAThousandTimesOff)
{
  EXPECT_EQ(complaint("0;0,3\n"), "mu.csv:1: 0;0,3: numbers need a decimal point: 0;0.3");
  EXPECT_EQ(complaint("10;2,000\n"), "mu.csv:1: 10;2,000: numbers need a decimal point and no separator of thousands");
}

// A first row taken for a header would leave a table without its friction at rest.
TEST(Csv, AFirstRowIsNoHeader)
{
  const std::string rest = "\n40, 0.6\n";
  for (const std::string row : { "O, 1", "nan, 1", "<0, 1",
                                 "\xC2\xA0"
                                 "0, 1",
                                 "0, l", "0, " })
    EXPECT_THROW(friction_columns(row + rest), InputError) << row;
  for (const std::string row : { "0, 1",
                                 "\xEF\xBB\xBF"
                                 "0, 1",
                                 "\"0\", \"1\"" })
    EXPECT_EQ(friction_columns(row + rest)[1].values, (std::vector<double>{ 1., 0.6 })) << row;
}

TEST(Csv, EveryFaultyLineIsNamed)
{
  const auto messages = thrown_messages([] { friction_columns("v, mu\n0, 0.3\n1\n2, 0.5, 7\nx, y\n3, 0.5\n"); });
  EXPECT_EQ(without_folder(messages), (Messages{ "mu.csv:3: 1: must be two numbers", "mu.csv:4: 2, 0.5, 7: must be two numbers",
                                                 "mu.csv:5: x, y: must be two numbers" }));
  EXPECT_THROW(read_two_columns("/nowhere/mu.csv", { "v" }, { "mu" }), InputError);
  EXPECT_THROW(read_two_columns(testing::TempDir(), { "v" }, { "mu" }), InputError);
  EXPECT_THROW(friction_columns("# nothing\n"), InputError);
}
