// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/task_farm/task_farm.h"

#include "base/errors.h"
#include "base/fingerprint.h"
#include "base/messages.h"
#include "base/phase_timer.h"
#include "base/system/interrupt.h"
#include "input/scene_key.h"
#include "program/output_folder.h"
#include "scene/scene.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <deal.II/base/mpi.h>
#include <exception>
#include <fcntl.h>
#include <fstream>
#include <iostream>
#include <optional>
#include <thread>
#include <unistd.h>

namespace sprag
{
  namespace
  {
    /// Time for which a rank collects finished lines before it writes them.
    constexpr std::chrono::milliseconds batch_duration(500);
    constexpr std::chrono::milliseconds pause(20);

    constexpr std::chrono::milliseconds lock_patience(5000);

    void write(const OpenFile &file, const std::string &path, const std::string &text)
    {
      if (!file.write(text))
        throw AnalysisError(path + " cannot be written: " + std::strerror(errno));
    }

    /// Checksum of a line's content, in the results log of a scene.
    std::string checksum(const std::string &header, const std::string &content)
    {
      return fingerprint(header, content) + '\n';
    }

    /// With their ends; the last one may lack it.
    std::vector<std::string> read_lines(const std::string &path)
    {
      std::ifstream input(path);
      std::vector<std::string> lines;
      for (std::string line; std::getline(input, line);)
        lines.push_back(input.eof() ? line : line + '\n');
      return lines;
    }

    /// Returns what a line holds; none where it is not as it was written.
    std::optional<std::string> parse_content(const std::string &header, const std::string &line)
    {
      const std::size_t behind  = line.rfind(' ') + 1; // 0 without a blank
      const std::string content = line.substr(0, behind);
      if (behind == 0 || line.substr(behind) != checksum(header, content))
        return {};
      return content.substr(0, content.size() - 1);
    }
  } // namespace

  /// Numbers in memory that the ranks of a node share. Between nodes the process that owned them would have to call MPI for each
  /// access, and a rank that works on a piece does not.
  class TaskFarm::Counters
  {
  public:
    struct Values
    {
      std::atomic<std::size_t> group{ 0 }; ///< the next one of this node to be taken
      std::atomic<std::size_t> done{ 0 };  ///< pieces
      std::atomic<bool> stop{ false };     ///< no more are begun
    };
    static_assert(std::atomic<std::size_t>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

    Counters()
        : exceptions(std::uncaught_exceptions())
    {
      int ierr = MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
      AssertThrowMPI(ierr);
      const bool is_first = dealii::Utilities::MPI::this_mpi_process(node) == 0;
      void *memory        = nullptr;
      ierr =
          MPI_Win_allocate_shared(is_first ? sizeof(Values) : 0, 1, MPI_INFO_NULL, node, static_cast<void *>(&memory), &window);
      AssertThrowMPI(ierr);
      MPI_Aint size = 0;
      int unit      = 0;
      MPI_Win_shared_query(window, 0, &size, &unit, static_cast<void *>(&memory));
      values = is_first ? new (memory) Values : static_cast<Values *>(memory);
      MPI_Barrier(MPI_COMM_WORLD);
    }

    /// Not while a rank is lost: the others would wait for it.
    ~Counters()
    {
      if (std::uncaught_exceptions() > exceptions)
        return;
      MPI_Win_free(&window);
      MPI_Comm_free(&node);
    }

    Counters &operator=(Counters &&) = delete;

    Values *operator->() const
    {
      return values;
    }

    /// Returns the groups for the ranks of this node, which its first rank names.
    PieceGroups own(const PieceGroups &groups) const
    {
      const auto first_rank = broadcast(node, dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD));
      return groups_on_node(groups, gather(MPI_COMM_WORLD, first_rank), first_rank);
    }

  private:
    const int exceptions;
    MPI_Comm node  = MPI_COMM_NULL;
    Values *values = nullptr;
    MPI_Win window{};
  };

  /// Lines of this rank, on their way into the results log.
  class TaskFarm::Batch
  {
  public:
    explicit Batch(const TaskFarm &task_farm)
        : farm(task_farm)
    {
    }

    void add(const std::string &line)
    {
      fresh.push_back(line);
      if (std::chrono::steady_clock::now() - begin >= batch_duration)
        write();
    }

    void write()
    {
      begin = std::chrono::steady_clock::now();
      if (fresh.empty())
        return;
      farm.check_inputs();
      append_lines(farm.address.first, farm.address.second, fresh);
      written.insert(written.end(), fresh.begin(), fresh.end());
      fresh.clear();
    }

    const std::vector<std::string> &lines() const
    {
      return written;
    }

  private:
    const TaskFarm &farm;
    std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
    std::vector<std::string> fresh, written;
  };

  void FarmProgress::say(const std::string &text)
  {
    bar.reset();
    if (style != ProgressStyle::quiet)
      std::cerr << text << std::endl;
  }

  void FarmProgress::update(const std::size_t done, const std::size_t total)
  {
    if (!bar)
      bar.emplace(std::cerr, style, static_cast<double>(total));
    bar->update(static_cast<double>(done), {});
  }

  TaskFarm::TaskFarm(const Scene &scene_, const RunOptions &options, Words words_, FarmProgress &progress_)
      : scene(scene_)
      , key(scene_key(scene))
      , words(std::move(words_))
      , progress(progress_)
  {
    on_first_rank([&] { open_log(options); });
    address  = broadcast(MPI_COMM_WORLD, address);
    from_log = broadcast(MPI_COMM_WORLD, from_log);
  }

  void TaskFarm::open_log(const RunOptions &options)
  {
    const auto name = results_log_name(words.analysis);
    prepare_folder(scene, options);
    results_log.emplace(options.folder + '/' + name, words.analysis, key);
    address  = results_log->address();
    from_log = results_log->lines();
    if (results_log->was_emptied())
      progress.say(name + " is of another scene or build: begun anew");
    if (const auto damaged = results_log->damaged_lines(); damaged > 0)
      std::cerr << name << ": damaged lines dropped, their " << words.pieces << " are " << words.again << ": " << damaged
                << std::endl;
    if (!from_log.empty())
      progress.say(name + ": " + std::to_string(from_log.size()) + ' ' + words.pieces + " taken over");
  }

  std::vector<Entry> TaskFarm::cost() const
  {
    namespace MPI    = dealii::Utilities::MPI;
    const double cpu = MPI::sum(PhaseTimer::cpu_seconds(), MPI_COMM_WORLD);
    return { { "ranks", static_cast<double>(MPI::n_mpi_processes(MPI_COMM_WORLD)) },
             { words.pieces + "_taken_over", static_cast<double>(from_log.size()) },
             { "wall_time", monotonic_seconds() - begin },
             { "cpu_time_all", cpu } };
  }

  void TaskFarm::remove_log()
  {
    on_first_rank([&] { results_log->remove(); });
  }

  void TaskFarm::check_inputs() const
  {
    if (scene_key(scene) != key)
      throw AnalysisError("an input file has changed during the " + words.analysis +
                          "; what was finished before is kept for the file as it was: start the " + words.analysis +
                          " again, with that file or the new one");
  }

  void TaskFarm::report(const std::size_t done, const std::size_t total) const
  {
    if (results_log)
      progress.update(done, total);
  }

  PieceGroups groups_on_node(const PieceGroups &groups, const std::vector<unsigned int> &nodes, const unsigned int node)
  {
    PieceGroups result;
    for (std::size_t i = 0; i < groups.size(); ++i)
      if (nodes[i % nodes.size()] == node)
        result.push_back(groups[i]);
    return result;
  }

  void TaskFarm::carry_out(const PieceGroups &groups, const std::function<std::string(std::size_t)> &work,
                           const std::function<void(const std::string &)> &learn)
  {
    Batch batch(*this);
    std::string failure;
    {
      const Counters counters;
      const auto groups_here = counters.own(groups);
      std::size_t total      = 0;
      for (const auto &group : groups_here)
        total += group.size();
      try
      {
        work_on(groups_here, work, total, counters, batch);
      }
      catch (const AnalysisError &error)
      {
        failure        = error.what();
        counters->stop = true;
      }
      wait_for_others(total, counters);
    }
    for (const auto &lines : gather(MPI_COMM_WORLD, batch.lines()))
      std::for_each(lines.begin(), lines.end(), learn);
    for (const auto &message : gather(MPI_COMM_WORLD, failure))
      if (!message.empty())
        throw AnalysisError(message);
  }

  void TaskFarm::work_on(const PieceGroups &groups, const std::function<std::string(std::size_t)> &work, const std::size_t total,
                         const Counters &counters, Batch &batch) const
  {
    const auto stopped = [&] { return interrupted() || counters->stop; };
    for (std::size_t next = 0; !stopped() && (next = counters->group++) < groups.size();)
      for (std::size_t i = 0; i < groups[next].size() && !stopped(); ++i)
      {
        const auto line = work(groups[next][i]);
        // A piece that was cut short is none.
        if (interrupted())
          break;
        batch.add(line);
        report(++counters->done, total);
      }
    batch.write();
    if (interrupted())
      throw AnalysisError("interrupted; what is finished is kept: start the same " + words.analysis + " again to go on");
  }

  /// Waits for the ranks of this node without the calls of MPI that keep a core busy.
  void TaskFarm::wait_for_others(const std::size_t total, const Counters &counters) const
  {
    for (; counters->done < total && !counters->stop; std::this_thread::sleep_for(pause))
      report(counters->done, total);
    report(counters->done, total);
  }

  bool is_first_rank()
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }

  void on_first_rank(const std::function<void()> &work)
  {
    std::vector<std::string> input, analysis;
    if (is_first_rank())
      try
      {
        work();
      }
      catch (const InputError &error)
      {
        input = error.messages;
      }
      catch (const AnalysisError &error)
      {
        analysis = { error.what() };
      }
    input    = broadcast(MPI_COMM_WORLD, input);
    analysis = broadcast(MPI_COMM_WORLD, analysis);
    if (!input.empty())
      throw InputError(input);
    if (!analysis.empty())
      throw AnalysisError(analysis.front());
  }

  void append_lines(const std::string &path, const std::string &header, const std::vector<std::string> &lines)
  {
    std::string text;
    for (const auto &line : lines)
      text += line + ' ' + checksum(header, line + ' ');
    const OpenFile file(path, O_WRONLY | O_APPEND);
    if (!file.is_open())
      throw AnalysisError(path + " cannot be written: " + std::strerror(errno));
    write(file, path, text);
  }

  ResultsLog::ResultsLog(const std::string &file_path, const std::string &what, const std::string &scene)
      : path(file_path)
      , file(path, O_RDWR | O_CREAT | O_APPEND)
      , header(results_log_header(what, scene))
  {
    if (!file.is_open())
      throw InputError(path + " cannot be written: " + std::strerror(errno));
    if (!file.lock(lock_patience) && errno == EWOULDBLOCK)
      throw InputError(path + " is in use by another run. Choose another --output, or end that run.");
    read();
  }

  void ResultsLog::read()
  {
    const auto lines  = read_lines(path);
    const bool usable = !lines.empty() && lines.front() == header;
    other_scene       = !lines.empty() && !usable;
    if (!usable)
    {
      if (!file.truncate(0))
        throw InputError(path + " cannot be written: " + std::strerror(errno));
      return write(file, path, header);
    }
    for (std::size_t i = 1; i < lines.size(); ++i)
      if (const auto content = parse_content(header, lines[i]))
        found.push_back(*content);
      else
        ++damaged;
    if (lines.back().back() != '\n')
      write(file, path, "\n");
  }

  void ResultsLog::remove()
  {
    ::unlink(path.c_str());
  }
} // namespace sprag
