// SPDX-License-Identifier: GPL-3.0-only
#include "program/output_folder.h"

#include "base/errors.h"
#include "base/fingerprint.h"
#include "base/pattern.h"
#include "base/system/open_file.h"
#include "base/version.h"
#include "input/read.h"
#include "input/scene_key.h"
#include "program/checkpoint.h"
#include "program/run_log.h"
#include "results/earlier_result.h"
#include "scene/scene.h"

#include <algorithm>
#include <chrono>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <unistd.h>
#include <utility>
#include <vector>

namespace sprag
{
  namespace
  {
    namespace fs = std::filesystem;

    /// A run that was killed has its folder until the last of its processes is gone.
    constexpr std::chrono::milliseconds lock_timeout(3000);

    /// Returns " (process 123)" of the process with the lock, if known.
    std::string find_holder(const OpenFile &folder)
    {
      const std::string inode = ":" + std::to_string(folder.status().st_ino) + " ";
      std::ifstream locks("/proc/locks");
      for (std::string line; std::getline(locks, line);)
      {
        std::istringstream words(line);
        std::string number, kind, mode, access, process;
        words >> number >> kind >> mode >> access >> process;
        if (kind == "FLOCK" && line.find(inode) != std::string::npos)
          return " (process " + process + ")";
      }
      return {};
    }

    /// Returns whether this process has not had the folder before.
    bool lock(const std::string &folder)
    {
      static OpenFile held; // until the process ends
      OpenFile opened(folder, O_RDONLY | O_DIRECTORY);
      if (!opened.is_open() || held.is_same_as(opened))
        return false;
      if (!opened.lock(lock_timeout) && errno == EWOULDBLOCK)
        throw InputError("--output = " + folder + ": another run writes there" + find_holder(opened) +
                         ". Wait for its end or choose another folder");
      held = std::move(opened);
      return true;
    }

    bool is_written(const std::string &name)
    {
      const std::set<std::string> names = { "result.h5",
                                            std::string("result.h5") + result_begun_ending,
                                            log_name,
                                            results_log_name("map"),
                                            results_log_name("study"),
                                            checkpoint_name,
                                            row_log_name,
                                            next_checkpoint_name };
      return names.count(name) > 0 || is_field_file(name);
    }

    /// Through a link another file would be written.
    void refuse_what_is_no_file(const std::string &folder)
    {
      std::error_code ignored;
      for (fs::directory_iterator entry(folder, ignored), end; entry != end; entry.increment(ignored))
      {
        const std::string name = entry->path().filename().string();
        const auto kind        = entry->symlink_status(ignored).type();
        if (kind == fs::file_type::regular || !is_written(name))
          continue;
        const bool is_folder = kind == fs::file_type::directory;
        const bool is_link   = kind == fs::file_type::symlink;
        throw InputError("--output = " + folder + ": " + name + " is " +
                         (is_folder ? "a folder"
                          : is_link ? "a link"
                                    : "no regular file") +
                         " there");
      }
    }

    /// A file that a run was killed on before it wrote anything holds zeros alone.
    bool holds_anything(const std::string &path)
    {
      std::ifstream input(path, std::ios::binary);
      const std::istreambuf_iterator<char> begin(input), end;
      return std::find_if(begin, end, [](const char c) { return c != '\0'; }) != end;
    }

    /// A file that cannot be read may be anybody's, but where a killed run can be gone on from.
    void refuse_other_result(const std::string &folder, const Scene &scene)
    {
      const std::string path = folder + "/result.h5";
      const auto earlier     = earlier_result(path);
      const bool is_lost     = !earlier && holds_anything(path) && !has_progress(folder, scene);
      if (!is_lost && (!earlier || earlier->parameters == parameters_text(scene)))
        return;
      const std::string kind = is_lost                          ? "damaged, or no result of sprag's"
                               : earlier->status == "completed" ? "the completed result of a run with other parameters"
                                                                : "the unfinished result of a run with other parameters";
      throw InputError("--output = " + folder + ": result.h5 there is " + kind +
                       ". Choose another folder, or replace it by --overwrite");
    }

    /// The folder that was not there when this process claimed it.
    std::string missing;

    bool begins_with(const std::string &header, const std::string &path)
    {
      std::ifstream input(path);
      std::string line;
      return std::getline(input, line) && line + '\n' == header;
    }
  } // namespace

  void require_writable(const std::string &folder)
  {
    std::error_code ignored;
    fs::path existing = fs::absolute(folder);
    while (!fs::exists(existing, ignored) && existing.has_relative_path())
      existing = existing.parent_path();
    if (!fs::is_directory(existing, ignored))
      throw InputError("--output = " + folder + ": " + existing.string() + " is not a folder");
    // Permissions do not restrict root, so a file is created as a test.
    std::string trial = (existing / ".sprag-XXXXXX").string();
    const int file    = ::mkstemp(trial.data());
    if (file < 0)
      throw InputError("--output = " + folder + ": " + existing.string() + " cannot be written to");
    ::close(file);
    ::unlink(trial.c_str());
    refuse_what_is_no_file(folder);
  }

  void prepare_folder(const Scene &scene, const RunOptions &options)
  {
    const auto &folder = options.folder;
    require_writable(folder);
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
      throw InputError("--output = " + folder + ": the folder cannot be made: " + error.message());
    if (lock(folder) && folder == missing)
      refuse_other_result(folder, scene); // of a run that began at the same time
    static std::string begun;
    const bool is_begun = std::exchange(begun, folder) == folder;
    if (!is_begun && !has_progress(folder, scene))
      remove_files(folder, is_field_file);
    if (options.log != nullptr)
      options.log->open(folder, scene);
  }

  void claim_folder(const std::string &folder, const Scene &scene, const bool overwrite)
  {
    require_writable(folder);
    std::error_code ignored;
    if (!fs::is_directory(folder, ignored))
    {
      missing = folder;
      return;
    }
    lock(folder);
    if (overwrite)
      remove_checkpoint(folder);
    else
      refuse_other_result(folder, scene);
  }

  std::string results_log_header(const std::string &what, const std::string &scene_key)
  {
    return "sprag " + version() + " " + what + ", scene " + fingerprint(program_fingerprint(), scene_key) + '\n';
  }

  bool has_progress(const std::string &folder, const Scene &scene)
  {
    const auto type = scene.analysis.type;
    if (type != AnalysisType::map && type != AnalysisType::study)
      return has_checkpoint(folder, scene);
    const std::string analysis = type == AnalysisType::map ? "map" : "study";
    return begins_with(results_log_header(analysis, scene_key(scene)), folder + '/' + results_log_name(analysis));
  }

  void remove_checkpoint(const std::string &folder)
  {
    for (const char *name : { checkpoint_name, next_checkpoint_name, row_log_name })
      ::unlink((folder + '/' + name).c_str());
  }

  bool is_field_file(const std::string &name)
  {
    return matches(name, R"((fields|face|leaf|mode-\d+)(-\d+\.h5|-mesh\.h5|\.h5|\.xdmf))");
  }

  void remove_files(const std::string &folder, const std::function<bool(const std::string &)> &is_named_so)
  {
    std::vector<fs::path> found;
    for (const auto &entry : fs::directory_iterator(folder))
      if (is_named_so(entry.path().filename().string()))
        found.push_back(entry.path());
    for (const auto &path : found)
      fs::remove(path);
  }
} // namespace sprag
