// SPDX-License-Identifier: GPL-3.0-only
#include "results/result_file.h"

#include "support/make_row.h"
#include "support/temporary_folder.h"

#include <array>
#include <filesystem>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  const FacePoints three_points = { { 10., 20., 30. }, { 1., 2., 1. } };

  class ResultFileTest : public testing::Test
  {
  protected:
    std::string path() const
    {
      return (folder / "result.h5").string();
    }

    /// Returns the output of Python; `f` is the file opened by h5py with further arguments.
    std::string h5py(const std::string &statements, const std::string &arguments = "") const
    {
      return read_output("/usr/bin/python3 -c 'import h5py\nf = h5py.File(\"" + path() + "\"" + arguments + ")\n" + statements +
                         "' 2>&1");
    }

    static std::string read_output(const std::string &command)
    {
      std::FILE *pipe = popen(command.c_str(), "r");
      std::string output;
      std::array<char, 256> buffer;
      while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr)
        output += buffer.data();
      pclose(pipe);
      return output;
    }

    const TemporaryFolder temporary;
    const std::filesystem::path &folder = temporary.path;
  };

  Row row(const double time)
  {
    return make_row({ { Column::time, time }, { Column::x, 112. * time }, { Column::Q, -2. * time } });
  }

  FaceState face_state(const double time)
  {
    return { time, 112. * time, { 0., time, 0. }, { 0., 0.5 * time, 0. }, {}, {}, {} };
  }

  void write_rows(ResultFile &file, const int n_rows)
  {
    for (int i = 0; i < n_rows; ++i)
    {
      file.append(row(i));
      file.append(face_state(i));
    }
  }

  const std::string print_progress =
      "print(len(f[\"table/time\"]), f[\"table/x\"][-1], f[\"face/pressure\"].shape, f[\"face/pressure\"][-1, 1])";
} // namespace

TEST_F(ResultFileTest, RoundTrip)
{
  ResultFile file(path(), "set A = µ\n", three_points);
  write_rows(file, 300); // more than a chunk
  file.finish({ { "slope_forward", 0.0804711777, "N/mm", "representative slope" } },
              { { "version", std::string("0.1.0"), "", "of sprag" }, { "cells", 12., "1", "of the mesh" } });

  EXPECT_EQ(h5py("print(len(f[\"table\"]), len(f[\"table/Q\"]), f[\"table/Q\"][299], f[\"table/P\"][0])"),
            std::to_string(n_columns) + " 300 -598.0 nan\n");
  EXPECT_EQ(h5py("print(f[\"face/xi\"][:], f[\"face/weight\"][:], f[\"face/x\"][2], f[\"face/traction\"][299, :])"),
            "[10. 20. 30.] [1. 2. 1.] 224.0 [  0.  149.5   0. ]\n");
  EXPECT_EQ(h5py("print(f[\"parameters\"].asstr()[()])"), "set A = µ\n\n");
  EXPECT_EQ(h5py("print(f[\"summary/slope_forward\"][()], f[\"meta/version\"].asstr()[()], f[\"meta/cells\"][()])"),
            "0.0804711777 0.1.0 12.0\n");
  EXPECT_EQ(h5py("print(f.attrs[\"format\"], f.attrs[\"format_version\"])"), "sprag result 1.0\n");
}

TEST_F(ResultFileTest, ColumnsOfAPairOnSensorsHoldWhatTheirNamesSay)
{
  FrictionPlate plate;
  plate.type    = PlateType::on_sensors;
  plate.sensors = { 105., 195. };
  MirroredPair pair;
  pair.type = PairType::full;
  Row first = row(1.), second = row(1.);
  first[Column::theta]  = 0.10;
  second[Column::theta] = 0.06;
  first[Column::P]      = 10.;
  second[Column::P]     = 8.;
  first[Column::F] = second[Column::F] = 0.;
  first.sensor_forces                  = { 4., 5. };
  second.sensor_forces                 = { 2., 1. };
  first.add_second_lever(second);
  ResultFile file(path(), "", {}, table_columns(plate, pair));
  file.append(first);
  file.finish({}, {});
  const std::string names = "[\"P\", \"P_2\", \"theta_2\", \"Q_pair\", \"sensor_1\", \"sensor_sum\", \"sensor_1_2\", "
                            "\"sensor_sum_2\"]";
  EXPECT_EQ(h5py("print([float(f[\"table/\" + name][0]) for name in " + names + "])"),
            "[10.0, 8.0, 0.06, -4.0, 4.0, 9.0, 2.0, 3.0]\n");
  EXPECT_EQ(h5py("print(round(float(f[\"table/swing\"][0]), 12), round(float(f[\"table/lateral_force\"][0]), 6))"),
            "0.02 -1.964437\n"); // 8 cos 0.06 - 10 cos 0.1
}

TEST_F(ResultFileTest, EachWarningIsADatasetOfItsName)
{
  ResultFile file(path(), "", {});
  file.finish({}, {}, { { "second", "It is 2.", "Q is off.", "Halve it." }, { "first", "x", "y", "z" } });
  EXPECT_EQ(h5py("print(list(f[\"warnings\"]), f[\"warnings/second\"].asstr()[()], "
                 "*(f[\"warnings/second\"].attrs[n] for n in (\"effect\", \"remedy\")))"),
            "['second', 'first'] It is 2. Q is off. Halve it.\n");
}

TEST_F(ResultFileTest, UnfinishedFileKeepsItsRows)
{
  {
    ResultFile file(path(), "", three_points);
    write_rows(file, 3);
  }
  EXPECT_EQ(h5py("print(len(f[\"table/time\"]), \"summary\" in f)"), "3 False\n");
}
