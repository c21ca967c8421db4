// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"
#include "base/ranges.h"
#include "results/columns.h"
#include "results/warning.h"

#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sprag
{
  /// A named scalar or text with its unit and meaning, for /summary, /meta and /accuracy.
  struct Entry
  {
    std::string name;
    std::variant<double, std::string> value;
    std::string unit                                            = {}; ///< "1" where dimensionless, empty for text
    std::string description                                     = {};
    std::vector<std::pair<std::string, std::string>> attributes = {}; ///< further ones, name and text
  };

  /// Numbers of a fixed size, stored row by row.
  struct Dataset
  {
    ColumnInfo info;
    std::vector<double> values;
    std::vector<std::size_t> shape; ///< empty: one dimension
  };

  /// Returns a dataset with a value for each item of a range.
  template <class Items, class Value>
  Dataset make_dataset(const Items &items, const ColumnInfo &info, const Value &value)
  {
    return { info, mapped(items, value), {} };
  }

  /// Texts of one dimension.
  struct TextDataset
  {
    std::string name;
    std::string description;
    std::vector<std::string> values;
  };

  /// Returns a text dataset with a value for each item of a range.
  template <class Items, class Value>
  TextDataset make_texts(const Items &items, const std::string &name, const std::string &description, const Value &value)
  {
    return { name, description, mapped(items, value) };
  }

  /// A named group of datasets.
  struct Group
  {
    std::string name;
    std::vector<Dataset> datasets;
    std::vector<TextDataset> texts = {};
  };

  /// Points of the friction face (fixed for a run): lever coordinates of the undeformed nodes and their weights.
  struct FacePoints
  {
    std::vector<double> xi;     ///< along the lever, from the pivot [mm]
    std::vector<double> weight; ///< area of the face carried by the point [mm^2]
    std::vector<double> zeta{}; ///< across the lever from the middle of its width; empty in a plane [mm]
  };

  /// State of the friction face at one written step, an entry per point of FacePoints.
  struct FaceState
  {
    double time = 0.;                      ///< [s]
    double x    = 0.;                      ///< [mm]
    std::vector<double> pressure;          ///< [MPa]
    std::vector<double> traction;          ///< friction on the lever along -d [MPa]
    std::vector<double> traction_across{}; ///< and along zeta; empty in a plane [MPa]

    // The second lever of a pair has its own; empty without. Field files contain them, /face does not.
    std::vector<double> pressure_2;
    std::vector<double> traction_2;
    std::vector<double> traction_across_2{};
  };

  /// Returns the state of the first lever's face with that of the second's.
  inline FaceState joined_faces(FaceState first, FaceState second)
  {
    first.pressure_2        = std::move(second.pressure);
    first.traction_2        = std::move(second.traction);
    first.traction_across_2 = std::move(second.traction_across);
    return first;
  }

  /// `result.h5`: /table/<column>, /face, /summary, /parameters, /meta, /warnings. The file can be read while the run goes on
  /// (HDF5 single-writer-multiple-reader) and after it is killed: what is appended is flushed at once; of rows that come within
  /// 50 ms of the last flush several are flushed together. Throws AnalysisError when HDF5 fails. To be destroyed before MPI is
  /// finalised.
  class ResultFile
  {
  public:
    /// Creates or replaces the file; throws InputError if that cannot be done. `parameters` is the full .prm text as used.
    /// No points: no /face. The table has one column a ColumnInfo; other than all_columns() for the slope sweeps.
    ResultFile(const std::string &path, const std::string &parameters, const FacePoints &points,
               const std::vector<ColumnInfo> &columns = all_columns());
    ResultFile(ResultFile &&) noexcept;
    ~ResultFile();

    /// Appends a row to a file with all_columns() or table_columns().
    void append(const Row &row);

    /// Appends a value for each of the columns given to the constructor.
    void append(const std::vector<double> &row);

    void append(const FaceState &state);

    /// Writes /summary, /meta, /warnings, other groups and, where there are entries, /accuracy, and closes the file. To be called
    /// once, also after a failed analysis. Of each warning a dataset of its name: what was found, with the attributes effect and
    /// remedy.
    void finish(const std::vector<Entry> &summary, const std::vector<Entry> &meta, const Warnings &warnings = {},
                const std::vector<Group> &groups = {}, const std::vector<Entry> &accuracy = {});

  private:
    struct Writer;
    std::string path;
    std::unique_ptr<Writer> writer; ///< null once the file is finished
  };

  void serialise(Archive &archive, FaceState &face);
} // namespace sprag
