// SPDX-License-Identifier: GPL-3.0-only
// Files that were cut short or in which bits were turned over: what reads them refuses or takes them, and comes back.
#include "base/errors.h"
#include "fe/dynamics/basis_file.h"
#include "fe/mesh/geometry_script.h"

#include "mpi_environment.h"
#include "support/temporary_folder.h"

#include <gmsh.h>

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  namespace fs = std::filesystem;

  class DamagedFiles : public ::testing::Test
  {
  protected:
    static std::string read_content(const fs::path &path)
    {
      std::ifstream stream(path, std::ios::binary);
      return { std::istreambuf_iterator<char>(stream), {} };
    }

    /// Calls `read` for copies with a byte turned over, and cut short, at places all over the file.
    template <class Read>
    static void for_all_damages(const fs::path &path, const unsigned int places, const Read &read)
    {
      const std::string whole = read_content(path);
      for (unsigned int i = 0; i < places; ++i)
      {
        const std::size_t at = (i * 2654435761u) % whole.size();
        std::string damaged  = whole;
        if (i % 3 == 0)
          damaged.resize(at);
        else
          damaged[at] = static_cast<char>(damaged[at] ^ (1 << i % 8));
        fs::remove(path);
        std::ofstream(path, std::ios::binary) << damaged;
        SCOPED_TRACE("byte " + std::to_string(at) + (i % 3 == 0 ? " cut" : " turned"));
        read();
      }
    }

    const TemporaryFolder temporary;
    const fs::path &folder = temporary.path;
  };

  MeshGroups strip_groups()
  {
    return { { { "lever", 1 } }, { { "hub", 1 } }, "'lever'", [](const auto &, const auto &) {
              return std::vector<std::string>();
            } };
  }

  void write_strip(const std::string &path, const bool binary)
  {
    gmsh::initialize();
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("Mesh.Binary", binary ? 1 : 0);
    const int corner = gmsh::model::geo::addPoint(0., 0., 0.);
    gmsh::vectorpair line, area;
    gmsh::model::geo::extrude({ { 0, corner } }, 10., 0., 0., line, { 6 });
    gmsh::model::geo::extrude({ line[1] }, 0., 2., 0., area, { 3 }, {}, true);
    gmsh::model::geo::synchronize();
    gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, { area[1].second }), "lever");
    gmsh::model::setPhysicalName(1, gmsh::model::addPhysicalGroup(1, { line[1].second }), "hub");
    gmsh::model::mesh::generate(2);
    gmsh::write(path);
    gmsh::finalize();
  }

  TEST_F(DamagedFiles, MeshesAreRefusedOrRead)
  {
    for (const bool binary : { false, true })
    {
      const auto path = folder / "strip.msh";
      write_strip(path, binary);
      dealii::Triangulation<2> good;
      read_gmsh(path, {}, strip_groups(), good);
      ASSERT_EQ(good.n_active_cells(), 18u);
      unsigned int refused = 0;
      for_all_damages(path, 60,
                      [&]
                      {
                        dealii::Triangulation<2> mesh;
                        try
                        {
                          read_gmsh(path, {}, strip_groups(), mesh);
                          EXPECT_GT(mesh.n_active_cells(), 0u);
                        }
                        catch (const InputError &error)
                        {
                          ++refused;
                          EXPECT_NE(std::string(error.what()).find("strip.msh"), std::string::npos);
                        }
                      });
      EXPECT_GT(refused, 25u);
    }
  }

  TEST_F(DamagedFiles, BasesAreTakenWholeOrNotAtAll)
  {
    std::string bytes;
    for (unsigned int i = 0; i < 7200; ++i)
      bytes.push_back(static_cast<char>(i * 37));
    ASSERT_EQ(store_basis(folder, "key", bytes), "");
    ASSERT_EQ(load_basis(folder, "key"), bytes);
    EXPECT_EQ(load_basis(folder, "another key"), std::nullopt);
    unsigned int refused = 0;
    for_all_damages(folder / "basis-key.bin", 120,
                    [&]
                    {
                      const auto found = load_basis(folder, "key");
                      refused += found ? 0 : 1;
                      EXPECT_TRUE(!found || *found == bytes);
                    });
    EXPECT_GT(refused, 60u);
  }
} // namespace
