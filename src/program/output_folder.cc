#include "program/output_folder.h"

#include "base/errors.h"
#include "program/run_files.h"
#include "program/run_log.h"
#include "results/earlier_result.h"

#include <cerrno>
#include <chrono>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <sys/file.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace sprag
{
  namespace
  {
    namespace fs = std::filesystem;

    /// A run that was killed has its folder until the last of its processes is gone.
    constexpr std::chrono::milliseconds lock_patience(3000), lock_pause(50);

    bool same_folder(const int one, const int other)
    {
      struct stat first = {}, second = {};
      return one >= 0 && ::fstat(one, &first) == 0 && ::fstat(other, &second) == 0 && first.st_dev == second.st_dev &&
             first.st_ino == second.st_ino;
    }

    /// " (process 123)" of whoever has the lock, as far as the system tells.
    std::string holder_of(const int folder)
    {
      struct stat status = {};
      ::fstat(folder, &status);
      const std::string inode = ":" + std::to_string(status.st_ino) + " ";
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

    void lock(const std::string &folder)
    {
      static int held  = -1; // until the process ends
      const int opened = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
      if (opened < 0 || same_folder(held, opened))
      {
        ::close(opened);
        return;
      }
      const auto end = std::chrono::steady_clock::now() + lock_patience;
      while (::flock(opened, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      {
        if (std::chrono::steady_clock::now() > end)
        {
          const std::string holder = holder_of(opened);
          ::close(opened);
          throw InputError("--output = " + folder + ": another run writes there" + holder +
                           ". Wait for its end or choose another folder");
        }
        std::this_thread::sleep_for(lock_pause);
      }
      ::close(held);
      held = opened;
    }

    void refuse_what_is_no_file(const std::string &folder)
    {
      std::error_code ignored;
      for (const char *name :
           { "result.h5", map_journal_name, study_journal_name, checkpoint_name, row_journal_name, "fields.xdmf" })
      {
        const auto kind = fs::status(fs::path(folder) / name, ignored).type();
        if (kind == fs::file_type::directory)
          throw InputError("--output = " + folder + ": " + name + " is a folder there");
        if (kind != fs::file_type::regular && kind != fs::file_type::not_found && kind != fs::file_type::none)
          throw InputError("--output = " + folder + ": " + name + " is no regular file there");
      }
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
    // Permissions say little where root asks: only a file that is made tells.
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
    lock(folder);
    if (options.log != nullptr)
      options.log->open(folder, scene);
  }

  void claim_folder(const std::string &folder, const std::string &parameters, const bool overwrite)
  {
    require_writable(folder);
    std::error_code ignored;
    if (!fs::is_directory(folder, ignored))
      return;
    lock(folder);
    if (overwrite)
      return remove_checkpoint(folder);
    const auto earlier = earlier_result(folder + "/result.h5");
    if (!earlier || earlier->parameters == parameters)
      return;
    const std::string kind = earlier->status == "completed" ? "completed" : "unfinished";
    throw InputError("--output = " + folder + ": result.h5 there is the " + kind + " result of a run with other parameters. " +
                     "Choose another folder, or replace it by --overwrite");
  }
} // namespace sprag
