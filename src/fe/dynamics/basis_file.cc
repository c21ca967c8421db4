// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/basis_file.h"

#include "base/errors.h"
#include "base/fingerprint.h"
#include "base/system/child_process.h"
#include "base/system/confinement.h"
#include "base/system/open_file.h"
#include "results/hdf5.h"

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <functional>
#include <regex>
#include <unistd.h>

namespace sprag
{
  namespace
  {
    std::string cache_path(const std::string &folder, const std::string &key)
    {
      return folder + "/basis-" + key + ".h5";
    }

    double checksum(const std::string &key, const StoredArrays &arrays)
    {
      Fingerprint sum;
      sum.add(key.data(), key.size());
      for (const auto &[name, values] : arrays)
      {
        sum.add(name.data(), name.size());
        sum.add(values.data(), values.size() * sizeof(double));
      }
      // Below 2^53 whole numbers are exact.
      return static_cast<double>(sum.value() >> 11);
    }

    /// Written here first, each process to its own.
    std::string temporary_path(const std::string &folder, const std::string &key)
    {
      return cache_path(folder, key) + "." + std::to_string(::getpid());
    }

    /// Returns whether a file in the folder, and no link, has a name like ours.
    bool is_called(const std::regex &name, const std::filesystem::directory_entry &entry)
    {
      std::error_code ignored;
      return std::regex_match(entry.path().filename().string(), name) &&
             entry.symlink_status(ignored).type() == std::filesystem::file_type::regular;
    }

    const std::regex &basis_name()
    {
      static const std::regex name(R"(basis-[0-9a-f]{16}\.h5)");
      return name;
    }

    const std::regex &temporary_name()
    {
      static const std::regex name(R"(basis-[0-9a-f]{16}\.h5\.[0-9]+)");
      return name;
    }

    std::optional<std::vector<double>> read_array(const hid_t file, const std::string &name)
    {
      const hid_t opened = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
      if (opened < 0)
        return {};
      const hdf5::Handle dataset(opened, H5Dclose);
      const hdf5::Handle space(H5Dget_space(dataset.id()), H5Sclose);
      const auto count = H5Sget_simple_extent_npoints(space.id());
      if (count < 0)
        return {};
      std::vector<double> values(static_cast<std::size_t>(count));
      if (H5Dread(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
        return {};
      return values;
    }

    /// A damaged file may keep HDF5 busy for ever [s], or ask for all the memory there is [bytes].
    constexpr double file_patience  = 10.;
    constexpr std::size_t file_room = std::size_t(1) << 28;

    /// Returns whether a file was written here, by what it holds.
    bool holds_basis(const std::string &path)
    {
      const auto look = [&]
      {
        confine({ path });
        const hdf5::Handle file = hdf5::open_to_read(path);
        return std::string(hdf5::has(file, "checksum") ? "is one" : "");
      };
      return !in_child_process(look, file_patience).text.empty();
    }

    /// Removes bases that were used longest ago, until those that stay have no more than `most` bytes.
    void prune(const std::string &folder, const std::uintmax_t most)
    {
      std::multimap<std::filesystem::file_time_type, std::filesystem::directory_entry, std::greater<>> latest_first;
      std::error_code error;
      for (std::filesystem::directory_iterator entry(folder, error), end; entry != end; entry.increment(error))
        if (is_called(basis_name(), *entry))
          latest_first.emplace(entry->last_write_time(error), *entry);
      std::uintmax_t sum = 0;
      for (const auto &[time, entry] : latest_first)
      {
        const auto size = entry.file_size(error);
        if (error)
          continue;
        if (sum + size <= most)
          sum += size;
        else if (holds_basis(entry.path().string()))
          std::filesystem::remove(entry.path(), error);
      }
    }

    /// None if the file is damaged as far as HDF5 or the checksum can tell.
    std::optional<StoredArrays> read_file(const std::string &path, const std::string &key)
    {
      const hid_t opened = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
      if (opened < 0)
        return {};
      const hdf5::Handle file(opened, H5Fclose);
      StoredArrays arrays;
      for (const auto &name : hdf5::names_in(file))
      {
        auto values = read_array(file.id(), name);
        if (!values)
          return {};
        arrays[name] = std::move(*values);
      }
      const auto found = arrays.find("checksum");
      if (found == arrays.end() || found->second.size() != 1)
        return {};
      const double stored = found->second.front();
      arrays.erase(found);
      if (stored != checksum(key, arrays))
        return {};
      return arrays;
    }

    /// Bytes of the arrays: of each its name, a zero, the number of values and these.
    std::string packed(const std::optional<StoredArrays> &arrays)
    {
      std::string bytes;
      if (arrays)
        for (const auto &[name, values] : *arrays)
        {
          const std::size_t count = values.size();
          bytes.append(name.c_str(), name.size() + 1);
          bytes.append(reinterpret_cast<const char *>(&count), sizeof count);
          bytes.append(reinterpret_cast<const char *>(values.data()), count * sizeof(double));
        }
      return bytes;
    }

    std::optional<StoredArrays> unpacked(const std::string &bytes)
    {
      StoredArrays arrays;
      for (std::size_t at = 0; at < bytes.size();)
      {
        auto &values = arrays[bytes.data() + at];
        at           = bytes.find('\0', at) + 1;
        std::size_t count;
        std::memcpy(&count, bytes.data() + at, sizeof count);
        at += sizeof count;
        values.resize(count);
        std::memcpy(values.data(), bytes.data() + at, count * sizeof(double));
        at += count * sizeof(double);
      }
      return arrays.empty() ? std::nullopt : std::optional(std::move(arrays));
    }
  } // namespace

  std::string cache_folder(const std::string &configured)
  {
    if (!configured.empty())
      return configured;
    if (const char *cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != '\0')
      return std::string(cache) + "/sprag";
    if (const char *home = std::getenv("HOME"); home != nullptr && *home != '\0')
      return std::string(home) + "/.cache/sprag";
    return {};
  }

  std::optional<StoredArrays> load_arrays(const std::string &folder, const std::string &key)
  {
    const std::string path = cache_path(folder, key);
    std::error_code ignored;
    if (folder.empty() || !std::filesystem::is_regular_file(path, ignored))
      return {};
    const auto bytes  = std::filesystem::file_size(path, ignored);
    const auto answer = in_child_process(
        [&]
        {
          limit_growth(file_room + 20 * bytes);
          confine({ path });
          return packed(read_file(path, key));
        },
        file_patience + 1e-7 * static_cast<double>(bytes));
    const auto found = answer.failure.empty() ? unpacked(answer.text) : std::nullopt;
    if (found) // what was used is pruned last
      std::filesystem::last_write_time(path, std::filesystem::file_time_type::clock::now(), ignored);
    return found;
  }

  void remove_abandoned(const std::string &folder)
  {
    // A writer's lock follows the file's creation at once.
    constexpr std::chrono::seconds young(10);
    std::error_code ignored;
    for (std::filesystem::directory_iterator entry(folder, ignored), end; entry != end; entry.increment(ignored))
    {
      const auto written = entry->last_write_time(ignored);
      const bool old     = !ignored && std::filesystem::file_time_type::clock::now() - written > young;
      if (old && is_called(temporary_name(), *entry))
        if (const OpenFile file(entry->path().string(), O_RDWR); file.is_open() && file.lock())
          std::filesystem::remove(entry->path(), ignored);
    }
  }

  std::string store_arrays(const std::string &folder, const std::string &key, const StoredArrays &arrays,
                           const std::uintmax_t most_bytes)
  {
    if (folder.empty())
      return "there is no cache folder";
    const std::string temporary = temporary_path(folder, key);
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    std::filesystem::remove(temporary, error); // what is there is no process's any more, or a link
    const OpenFile writer(temporary, O_RDWR | O_CREAT | O_EXCL);
    if (!writer.is_open())
      return temporary + " cannot be made";
    writer.lock(); // until it is closed nobody takes the file for abandoned
    try
    {
      auto file = hdf5::create_file(temporary);
      for (const auto &[name, values] : arrays)
        hdf5::write_dataset(file, name, values);
      hdf5::write_dataset(file, "checksum", checksum(key, arrays));
      file.close();
      std::filesystem::rename(temporary, cache_path(folder, key));
      prune(folder, most_bytes);
    }
    catch (const std::exception &failure)
    {
      std::filesystem::remove(temporary, error);
      return failure.what();
    }
    return {};
  }
} // namespace sprag
