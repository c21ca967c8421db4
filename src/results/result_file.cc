// SPDX-License-Identifier: GPL-3.0-only
#include "results/result_file.h"

#include "base/errors.h"
#include "base/system/disk_reserve.h"
#include "base/unknown.h"
#include "results/earlier_result.h"
#include "results/entries.h"
#include "results/hdf5.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <optional>

namespace sprag
{
  namespace
  {
    constexpr std::size_t table_chunk = 256;

    // A flush costs about 0.4 ms of CPU time, a tenth of a quasi-static step.
    constexpr std::chrono::milliseconds flush_interval(50);

    // Chunks and descriptions that a flush or the entries of /summary and /meta bring along with the numbers themselves.
    constexpr std::size_t overhead = 256 * 1024;

    void remove_old_file(const std::string &path)
    {
      std::error_code ignored;
      if (std::filesystem::is_regular_file(path, ignored))
        std::filesystem::remove(path, ignored);
      DiskReserve(path).cover(overhead);
    }

    hdf5::Handle create(const std::string &path)
    {
      try
      {
        remove_old_file(path);
        return hdf5::create_file(path);
      }
      catch (const AnalysisError &error)
      {
        throw InputError(error.what());
      }
    }

    /// Numbers a row each, or of the shape given: those are rows that are flushed at once.
    hdf5::Series create_series(const hdf5::Handle &group, const ColumnInfo &column, const std::vector<hsize_t> &row = {})
    {
      // A compressed chunk changes its length when a row is added to it, and the space it leaves is lost while others
      // read. With a row a chunk nothing is written twice.
      hdf5::Series series(group, column.name, row.empty() ? table_chunk : 1, row);
      describe(series.handle(), column.unit, column.description);
      return series;
    }

    void write_values(const hdf5::Handle &group, const ColumnInfo &column, const std::vector<double> &values,
                      const std::vector<std::size_t> &shape = {})
    {
      describe(hdf5::write_dataset(group, column.name, values, shape), column.unit, column.description);
    }

    void write_group(const hdf5::Handle &file, const Group &group)
    {
      const hdf5::Handle handle = hdf5::create_group(file, group.name);
      for (const auto &[info, values, shape] : group.datasets)
        write_values(handle, info, values, shape);
      for (const auto &[name, description, values] : group.texts)
        describe(hdf5::write_dataset(handle, name, values), "", description);
    }

    void write_warnings(const hdf5::Handle &file, const Warnings &warnings)
    {
      const hdf5::Handle group = hdf5::create_group(file, "warnings");
      for (const Warning &warning : warnings)
      {
        const hdf5::Handle dataset = hdf5::write_dataset(group, warning.name, warning.found);
        describe(dataset, "", "what was found; its effect and remedy are attributes");
        hdf5::write_attribute(dataset, "effect", warning.effect);
        hdf5::write_attribute(dataset, "remedy", warning.remedy);
      }
    }

    std::size_t estimate_bytes(const Warnings &warnings)
    {
      std::size_t size = 0;
      for (const Warning &warning : warnings)
        size += overhead / 16 + warning.found.size() + warning.effect.size() + warning.remedy.size();
      return size;
    }

    std::size_t estimate_bytes(const std::vector<Group> &groups)
    {
      std::size_t size = 0;
      for (const Group &group : groups)
      {
        for (const Dataset &dataset : group.datasets)
          size += overhead / 16 + sizeof(double) * dataset.values.size();
        for (const TextDataset &dataset : group.texts)
          for (const std::string &text : dataset.values)
            size += overhead / 16 + text.size();
      }
      return size;
    }

    /// A copy of a file under the name of one that was begun, gone with this unless it was given another name. Where no copy is
    /// wanted, or none can be made, it is the file itself.
    class Copy
    {
    public:
      Copy(const std::string &file_path, const bool is_needed)
          : path(file_path)
      {
        std::error_code error;
        is_made = is_needed && std::filesystem::copy_file(path, begun, std::filesystem::copy_options::overwrite_existing, error);
        if (!is_made)
          std::filesystem::remove(begun, error);
      }
      Copy &operator=(Copy &&) = delete;
      ~Copy()
      {
        std::error_code ignored;
        std::filesystem::remove(begun, ignored);
      }

      const std::string &name() const
      {
        return is_made ? begun : path;
      }

    private:
      const std::string path, begun = path + result_begun_ending;
      bool is_made = false;
    };

  } // namespace

  /// Groups of the file that grow by a row at a time.
  namespace growing
  {
    /// /table
    class Table
    {
    public:
      Table(const hdf5::Handle &file, const std::vector<ColumnInfo> &columns)
          : pending(columns.size())
      {
        const hdf5::Handle group = hdf5::create_group(file, "table");
        for (const ColumnInfo &column : columns)
          series.push_back(create_series(group, column));
      }

      void append(const std::vector<double> &row)
      {
        Assert(row.size() == series.size(), dealii::ExcDimensionMismatch(row.size(), series.size()));
        for (std::size_t i = 0; i < row.size(); ++i)
          pending[i].push_back(row[i]);
      }

      std::size_t n_columns() const
      {
        return series.size();
      }

      std::size_t pending_bytes() const
      {
        return pending.empty() ? 0 : pending.size() * pending.front().size() * sizeof(double);
      }

      void write()
      {
        for (std::size_t i = 0; i < series.size(); ++i)
        {
          series[i].append(pending[i]);
          pending[i].clear();
        }
      }

    private:
      std::vector<hdf5::Series> series;
      std::vector<std::vector<double>> pending; ///< rows not yet written, by column
    };

    /// /face
    class Face
    {
    public:
      Face(const hdf5::Handle &file, const FacePoints &points)
          : group(hdf5::create_group(file, "face"))
          , time(create_series(group, { "time", "s", "time of the written step" }))
          , x(create_series(group, { "x", "mm", "position of the cylinder at the written step" }))
          , pressure(
                create_series(group, { "pressure", "MPa", "contact pressure, written steps x points" }, { points.xi.size() }))
          , traction(create_series(group,
                                   { "traction", "MPa", "friction traction on the lever along -d, written steps x points" },
                                   { points.xi.size() }))
      {
        write_values(group, { "xi", "mm", "lever coordinate of the undeformed point, from the pivot" }, points.xi);
        write_values(group, { "weight", "mm^2", "area of the friction face carried by the point" }, points.weight);
        if (points.zeta.empty())
          return;
        write_values(group, { "zeta", "mm", "lever coordinate of the undeformed point across the width, from its middle" },
                     points.zeta);
        across.emplace(create_series(
            group, { "traction_across", "MPa", "friction traction on the lever along zeta, written steps x points" },
            { points.xi.size() }));
      }

      void append(const FaceState &state)
      {
        time.append({ state.time });
        x.append({ state.x });
        pressure.append(state.pressure);
        traction.append(state.traction);
        if (across)
          across->append(state.traction_across);
      }

    private:
      hdf5::Handle group;
      hdf5::Series time, x, pressure, traction;
      std::optional<hdf5::Series> across;
    };
  } // namespace growing

  namespace
  {
    /// The row in the order of table_columns(), NaN in place of sensors that the model has not.
    std::vector<double> row_values(const Row &row, const std::size_t n_values)
    {
      const auto &second = row.second_lever();
      const bool is_pair = !second.empty();
      const auto pair_values =
          is_pair ? std::vector<double>{ row.swing(), row.drive_force(), row.lateral_force() } : std::vector<double>();
      const auto n_sensors =
          (n_values - n_columns - second.size() - pair_values.size() - row.across.size()) / (is_pair ? 2 : 1); // and their sum
      const auto sensor_values = [&](const std::size_t lever)
      {
        std::vector<double> forces(n_sensors, unknown);
        if (row.sensor_forces.empty() || forces.empty())
          return forces;
        const auto begin = row.sensor_forces.begin() + static_cast<std::ptrdiff_t>(lever * (n_sensors - 1));
        std::copy_n(begin, n_sensors - 1, forces.begin());
        forces.back() = std::accumulate(forces.begin(), forces.end() - 1, 0.);
        return forces;
      };
      std::vector<double> values;
      for (std::size_t i = 0; i < n_columns; ++i)
        values.push_back(row[static_cast<Column>(i)]);
      sprag::append(values, sensor_values(0));
      sprag::append(values, second);
      if (is_pair)
        sprag::append(values, sensor_values(1));
      return joined(joined(values, pair_values), row.across);
    }

    /// Values most of which are 0 before the first and behind the last that is not: on a face where nothing touches.
    struct Sparse
    {
      std::vector<double> &values;
    };

    void serialise(Archive &archive, const Sparse sparse)
    {
      auto &values          = sparse.values;
      const auto is_nothing = [](const double value) { return value == 0. && !std::signbit(value); };
      const auto first      = std::find_if_not(values.begin(), values.end(), is_nothing);
      const auto end        = std::find_if_not(values.rbegin(), std::make_reverse_iterator(first), is_nothing).base();
      std::size_t size = values.size(), before = static_cast<std::size_t>(first - values.begin());
      std::vector<double> inside(first, end);
      archive(size, before, inside);
      if (!archive.reads())
        return;
      values.assign(size, 0.);
      std::copy(inside.begin(), inside.end(), values.begin() + static_cast<std::ptrdiff_t>(before));
    }
  } // namespace

  /// Open handles and buffers while rows are appended.
  struct ResultFile::Writer
  {
    DiskReserve reserve; // given back after the file is closed
    hdf5::Handle file;
    growing::Table table;
    std::optional<growing::Face> face                = {};
    std::chrono::steady_clock::time_point last_flush = {};
    std::size_t pending                              = 0; ///< bytes of faces since then

    void flush_now_and_then()
    {
      if (std::chrono::steady_clock::now() - last_flush >= flush_interval)
        flush();
    }

    void flush()
    {
      reserve.require_in_place();
      reserve.cover(overhead + table.pending_bytes() + pending);
      table.write();
      hdf5::checked("flushing", H5Fflush(file.id(), H5F_SCOPE_LOCAL));
      last_flush = std::chrono::steady_clock::now();
      pending    = 0;
    }

    /// Returns false at the end of a run where there is no space left but for the end itself.
    bool flush_what_fits()
    {
      reserve.require_in_place();
      try
      {
        flush();
        return true;
      }
      catch (const AnalysisError &)
      {
        return false;
      }
    }
  };

  ResultFile::ResultFile(const std::string &file_path, const std::string &parameters, const FacePoints &points,
                         const std::vector<ColumnInfo> &columns)
      : path(file_path)
  {
    // Until others can read it, it has another name: of a run that is killed nothing is left that nobody can read, and somebody
    // who still reads the old file keeps it.
    if (std::filesystem::is_directory(path))
      throw InputError("cannot write " + path + ": is a folder");
    const std::string begun = path + result_begun_ending;
    hdf5::Handle file       = create(begun);
    DiskReserve reserve(begun);
    reserve.cover(overhead + parameters.size());
    hdf5::write_attribute(file, "format", std::string(result_format));
    hdf5::write_attribute(file, "format_version", 1.);
    describe(hdf5::write_dataset(file, "parameters", parameters), "", "every parameter as used, in .prm form");
    growing::Table table(file, columns);
    std::optional<growing::Face> face;
    if (!points.xi.empty())
      face.emplace(file, points);
    // From here on others can read along; no object and no attribute can be created any more.
    hdf5::checked("letting others read", H5Fstart_swmr_write(file.id()));
    reserve.rename(path);
    writer = std::make_unique<Writer>(Writer{ std::move(reserve), std::move(file), std::move(table), std::move(face) });
  }

  ResultFile::ResultFile(ResultFile &&) noexcept = default;

  ResultFile::~ResultFile()
  {
    if (writer)
      try
      {
        writer->flush();
      }
      catch (const AnalysisError &)
      {
        // The run is being abandoned for a reason of its own.
      }
  }

  void ResultFile::append(const Row &row)
  {
    Assert(writer, dealii::ExcMessage("The result file is finished."));
    append(row_values(row, writer->table.n_columns()));
  }

  void ResultFile::append(const std::vector<double> &row)
  {
    Assert(writer, dealii::ExcMessage("The result file is finished."));
    writer->table.append(row);
    writer->flush_now_and_then();
  }

  void ResultFile::append(const FaceState &state)
  {
    Assert(writer && writer->face, dealii::ExcMessage("The result file has no open /face."));
    writer->pending += 3 * state.pressure.size() * sizeof(double);
    writer->reserve.cover(overhead + writer->pending);
    writer->face->append(state);
    writer->flush_now_and_then();
  }

  void add_entries(const hdf5::Handle &file, const std::string &name, const std::vector<Entry> &entries)
  {
    const hdf5::Handle group = hdf5::create_group(file, name);
    for (const Entry &entry : entries)
    {
      const auto dataset =
          std::visit([&](const auto &value) { return hdf5::write_dataset(group, entry.name, value); }, entry.value);
      describe(dataset, entry.unit, entry.description);
      for (const auto &[attribute, text] : entry.attributes)
        hdf5::write_attribute(dataset, attribute, text);
    }
  }

  void ResultFile::finish(const std::vector<Entry> &summary, const std::vector<Entry> &meta, const Warnings &warnings,
                          const std::vector<Group> &groups, const std::vector<Entry> &accuracy)
  {
    Assert(writer, dealii::ExcMessage("The result file is finished already."));
    // Nothing can be created in a file that others may be reading along: close it and open it anew.
    const bool has_space = writer->flush_what_fits();
    writer.reset();
    // A file that is being changed is damaged if the run is killed: a copy is, where there is space for one.
    const Copy copy(path, has_space);
    DiskReserve reserve(copy.name());
    if (has_space)
      reserve.cover(overhead + estimate_bytes(groups) + estimate_bytes(warnings));
    hdf5::Handle file = hdf5::open_file(copy.name());
    add_entries(file, "summary", summary);
    add_entries(file, "meta", meta);
    if (!accuracy.empty())
      add_entries(file, "accuracy", accuracy);
    if (has_space)
      write_warnings(file, warnings);
    for (const Group &group : has_space ? groups : std::vector<Group>())
      write_group(file, group);
    file.close();
    reserve.rename(path);
  }

  SPRAG_SERIALISE(Row, sensor_forces, across, values, second_values)

  void serialise(Archive &archive, FaceState &face)
  {
    auto &[time, x, pressure, traction, traction_across, pressure_2, traction_2, traction_across_2] = face;
    archive(time, x);
    for (auto *const values : { &pressure, &traction, &traction_across, &pressure_2, &traction_2, &traction_across_2 })
      serialise(archive, Sparse{ *values });
  }
} // namespace sprag
