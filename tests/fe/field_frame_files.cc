#include "fe/field_frames.h"

#include "bar.h"

#include <deal.II/base/hdf5.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/numerics/vector_tools.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <optional>
#include <set>
#include <unistd.h>

using namespace sprag;

namespace
{
  /// Empty, and gone with its owner.
  class TemporaryFolder
  {
  public:
    TemporaryFolder()
        : path(std::filesystem::temp_directory_path() / ("sprag-test-frames-" + std::to_string(::getpid())))
    {
      std::filesystem::remove_all(path);
      std::filesystem::create_directories(path);
    }
    TemporaryFolder(const TemporaryFolder &)            = delete;
    TemporaryFolder &operator=(const TemporaryFolder &) = delete;
    ~TemporaryFolder()
    {
      std::filesystem::remove_all(path);
    }

    std::set<std::string> names() const
    {
      std::set<std::string> result;
      for (const auto &entry : std::filesystem::directory_iterator(path))
        result.insert(entry.path().filename());
      return result;
    }

    const std::filesystem::path path;
  };

  /// A value is at most half of the last place off.
  constexpr double single_precision = 0.5 * std::numeric_limits<float>::epsilon() * 1.001;

  using Matrix = dealii::FullMatrix<double>;

  /// A frame as others read it.
  struct Frame
  {
    explicit Frame(const std::string &name)
    {
      dealii::HDF5::File file(name, dealii::HDF5::File::FileAccessMode::open);
      nodes        = file.open_dataset("nodes").read<Matrix>();
      displacement = file.open_dataset("displacement").read<Matrix>();
      stress       = file.open_dataset("von_mises_stress").read<Matrix>();
      part         = file.open_dataset("part").read<Matrix>();
      cells        = file.open_dataset("cells").read<Matrix>();
    }

    std::size_t node(const unsigned int cell, const unsigned int corner) const
    {
      return static_cast<std::size_t>(cells(cell, corner));
    }

    Matrix nodes, displacement, stress, part, cells;
  };

  /// A bar of steel-like metal on a soft layer, both stretched along xi and across eta by strains that are the same everywhere.
  struct StretchedBar
  {
    explicit StretchedBar(const BodyProperties &properties)
    {
      make_bar(bar, triangulation);
      body.emplace(triangulation, properties);
      displacement.reinit(body->n_dofs());
      dealii::VectorTools::interpolate(body->cell_mapping(), body->dofs(), Stretch(), displacement);
    }

    static constexpr double along  = 1e-3;
    static constexpr double across = -4e-4;

    struct Stretch : dealii::Function<2>
    {
      Stretch()
          : dealii::Function<2>(2)
      {
      }
      double value(const dealii::Point<2> &p, const unsigned int component) const override
      {
        return component == 0 ? along * p[0] : across * p[1];
      }
    };

    /// Of plane stress with Poisson's ratio 0.3 or 0, by hand.
    static double von_mises(const double modulus, const double nu)
    {
      const double a = modulus / (1. - nu * nu) * (along + nu * across), b = modulus / (1. - nu * nu) * (across + nu * along);
      return std::sqrt(a * a - a * b + b * b);
    }

    Bar bar;
    dealii::Triangulation<2> triangulation;
    std::optional<ElasticBody<2>> body;
    dealii::Vector<double> displacement;
  };
} // namespace

TEST(FieldFrames, EachPartHasItsNumberAndItsOwnStressUpToWhereItMeetsAnother)
{
  const TemporaryFolder folder;
  const StretchedBar stretched(bar_properties({}, 0.3));
  FieldFrames(*stretched.body, folder.path).write(stretched.displacement, 0.5);
  Frame frame(folder.path / "fields-0000.h5");

  const double largest   = StretchedBar::along * stretched.bar.length;
  const double interface = stretched.bar.offset + stretched.bar.layer;
  unsigned int of_layer = 0, at_interface = 0;
  for (unsigned int c = 0; c < frame.cells.m(); ++c)
  {
    double middle = 0.;
    for (unsigned int v = 0; v < 4; ++v)
      middle += 0.25 * frame.nodes(frame.node(c, v), 1);
    const bool layer = middle < interface;
    of_layer += layer ? 1 : 0;
    for (unsigned int v = 0; v < 4; ++v)
    {
      const auto node = frame.node(c, v);
      at_interface += std::abs(frame.nodes(node, 1) - interface) < 1e-9 ? 1 : 0;
      EXPECT_EQ(frame.part(node, 0), layer ? material_id::layer : material_id::lever);
      const double expected = layer ? StretchedBar::von_mises(20., 0.) : StretchedBar::von_mises(70000., 0.3);
      EXPECT_NEAR(frame.stress(node, 0), expected, single_precision * expected);
      EXPECT_NEAR(frame.displacement(node, 0), StretchedBar::along * frame.nodes(node, 0), single_precision * largest);
      EXPECT_NEAR(frame.displacement(node, 1), StretchedBar::across * frame.nodes(node, 1), single_precision * largest);
    }
  }
  // 8 elements along, 1 + 2 across, each as 2 x 2 pieces.
  EXPECT_EQ(frame.cells.m(), 4u * 8 * 3);
  EXPECT_EQ(of_layer, 4u * 8);
  EXPECT_EQ(at_interface, 2u * 2 * 2 * 8);
}

TEST(FieldFrames, CurvedCellsAreWrittenCurved)
{
  const TemporaryFolder folder;
  const double radius = 56., core = 28.;
  dealii::Triangulation<2> triangulation;
  dealii::GridGenerator::hyper_shell(triangulation, {}, core, radius, 8);
  for (const auto &cell : triangulation.active_cell_iterators())
    cell->set_material_id(material_id::cylinder);
  BodyProperties properties;
  properties.curved    = true;
  properties.constants = { { material_id::cylinder, { 70000., 0.33 } } };
  const ElasticBody<2> body(triangulation, properties);
  FieldFrames(body, folder.path).write(dealii::Vector<double>(body.n_dofs()), 0.);
  const Frame frame(folder.path / "fields-0000.h5");
  ASSERT_EQ(frame.nodes.m(), 8u * 9);
  unsigned int outside = 0;
  for (unsigned int node = 0; node < frame.nodes.m(); ++node)
  {
    const double distance = std::hypot(frame.nodes(node, 0), frame.nodes(node, 1));
    const double nearest  = distance > 50. ? radius : distance > 35. ? 0.5 * (radius + core) : core;
    outside += nearest == radius ? 1 : 0;
    EXPECT_NEAR(distance, nearest, 2. * single_precision * radius);
    EXPECT_EQ(frame.part(node, 0), material_id::cylinder);
  }
  EXPECT_EQ(outside, 8u * 3);
}

TEST(FieldFrames, IndexNamesEveryFrameWithItsTimeAndFields)
{
  const TemporaryFolder folder;
  const StretchedBar stretched(bar_properties({}, 0.3));
  FieldFrames frames(*stretched.body, folder.path, "leaf");
  frames.write(stretched.displacement, 0.5);
  frames.write(stretched.displacement, 0.75);
  EXPECT_EQ(folder.names(), (std::set<std::string>{ "leaf-0000.h5", "leaf-0001.h5", "leaf.xdmf" }));

  std::ifstream stream(folder.path / "leaf.xdmf");
  const std::string index{ std::istreambuf_iterator<char>(stream), {} };
  for (const std::string expected : { "Time Value=\"0.5\"", "Time Value=\"0.75\"", "leaf-0000.h5:/part", "leaf-0001.h5:/part",
                                      "leaf-0001.h5:/displacement", "leaf-0001.h5:/von_mises_stress" })
    EXPECT_NE(index.find(expected), std::string::npos) << expected;
}

TEST(FieldFrames, OnlyFramesOfThatNameAreRemoved)
{
  const TemporaryFolder folder;
  for (const std::string name : { "fields-0012.h5", "fields.xdmf", "fields.png", "leaf-0000.h5", "fields-of-mine.h5" })
    std::ofstream(folder.path / name) << "something";
  const StretchedBar stretched(bar_properties({}, 0.3));
  const FieldFrames frames(*stretched.body, folder.path);
  EXPECT_EQ(folder.names(), (std::set<std::string>{ "fields.png", "leaf-0000.h5", "fields-of-mine.h5" }));
}
