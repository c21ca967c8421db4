// SPDX-License-Identifier: GPL-3.0-only
#include "results/earlier_result.h"

#include "base/system/child_process.h"
#include "base/system/confinement.h"
#include "base/version.h"
#include "results/entries.h"

#include <filesystem>
#include <sys/stat.h>

namespace sprag
{
  namespace
  {
    /// A damaged file may keep HDF5 busy for ever [s].
    constexpr double timeout = 20.;

    bool is_newer(const std::string &path, const std::timespec &since)
    {
      struct stat status = {};
      if (::stat(path.c_str(), &status) != 0)
        return false;
      const auto &changed = status.st_mtim;
      return changed.tv_sec > since.tv_sec || (changed.tv_sec == since.tv_sec && changed.tv_nsec >= since.tv_nsec);
    }

    bool is_finished(const std::optional<EarlierResult> &result)
    {
      return result && !result->status.empty();
    }

    void write_end(const std::string &path, const std::string &parameters, const std::string &status)
    {
      const std::vector<Entry> meta = { { "version", version(), "", "of sprag, with the commit that it was built from" } };
      if (std::filesystem::exists(path))
      {
        hdf5::Handle file = hdf5::open_file(path, true);
        if (hdf5::has(file, "summary"))
          return;
        add_entries(file, "summary", { status_entry(status) });
        add_entries(file, "meta", meta);
        file.close();
        return;
      }
      std::filesystem::create_directories(std::filesystem::path(path).parent_path());
      ResultFile(path, parameters, {}, {}).finish({ status_entry(status) }, meta);
    }
  } // namespace

  std::optional<EarlierResult> earlier_result(const std::string &path)
  {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored))
      return {};
    const auto read = [&]
    {
      confine({ path });
      const hdf5::Handle file = hdf5::open_to_read(path);
      if (hdf5::text_attribute(file, "format") != result_format)
        return std::string();
      const std::string status = hdf5::has(file, "summary") ? hdf5::read_text(file, "summary/status") : "";
      return status + '\0' + hdf5::read_text(file, "parameters");
    };
    const auto answer = in_child_process(read, timeout);
    const auto end    = answer.text.find('\0');
    if (!answer.failure.empty() || end == std::string::npos)
      return {};
    return EarlierResult{ answer.text.substr(end + 1), answer.text.substr(0, end) };
  }

  bool finish_abandoned(const std::string &path, const std::string &parameters, const std::string &status,
                        const std::timespec since)
  {
    if (std::filesystem::exists(path) && (!is_newer(path, since) || is_finished(earlier_result(path))))
      return false;
    const auto work = [&]
    {
      write_end(path, parameters, status);
      return std::string();
    };
    return in_child_process(work, timeout).failure.empty();
  }
} // namespace sprag
