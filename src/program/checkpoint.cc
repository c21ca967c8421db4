// SPDX-License-Identifier: GPL-3.0-only
#include "program/checkpoint.h"

#include "base/errors.h"
#include "base/fingerprint.h"
#include "base/system/interrupt.h"
#include "input/read.h"
#include "input/scene_key.h"
#include "program/output_folder.h"
#include "results/earlier_result.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <unistd.h>

namespace sprag
{
  namespace
  {
    /// Returns the content of blocks; none where they are not as they were written.
    std::optional<std::string> verified_content(const std::string &blocks)
    {
      Archive archive(blocks);
      std::string result;
      try
      {
        while (!archive.at_end())
        {
          std::string block;
          archive(block);
          const auto content = unsealed(block);
          if (!content)
            return {};
          result += *content;
        }
      }
      catch (const AnalysisError &)
      {
        return {};
      }
      return result;
    }

    constexpr double largest_share = 0.01; ///< of a run's time that checkpoints take

    double seconds_between()
    {
      const char *const environment_value = std::getenv(checkpoint_variable);
      return environment_value != nullptr ? std::atof(environment_value) : default_checkpoint_seconds;
    }

    struct Content
    {
      std::string parameters; ///< fingerprint of their text, which no choice of settings changes
      std::string key;
      std::size_t rows = 0; ///< size of their results log [bytes]
      std::string progress;
    };

    SPRAG_SERIALISE(Content, parameters, key, rows, progress)

    /// Returns what the checkpoint in a folder holds; none where there is none, it is not as it was written, or another build of
    /// the program wrote other fields.
    std::optional<Content> content_in(const std::string &path)
    {
      std::ifstream input(path, std::ios::binary);
      const auto bytes = unsealed({ std::istreambuf_iterator<char>(input), {} });
      if (!bytes)
        return {};
      Content content;
      Archive archive(*bytes);
      try
      {
        archive(content);
      }
      catch (const AnalysisError &)
      {
        return {};
      }
      return content;
    }

    std::string checkpoint_parameters(const Scene &scene)
    {
      return fingerprint(parameters_text(scene));
    }

    /// Replaces the file in one instant, or not at all.
    void replace(const std::string &path, const std::string &next_path, const std::string &bytes)
    {
      const OpenFile file(next_path, O_WRONLY | O_CREAT | O_TRUNC);
      const bool written = file.is_open() && file.write(bytes) && file.synchronise();
      if (!written || ::rename(next_path.c_str(), path.c_str()) != 0)
        throw AnalysisError(path + " cannot be written: " + std::strerror(errno));
    }
  } // namespace

  RowLog::RowLog(std::string file_path)
      : path(std::move(file_path))
  {
  }

  std::optional<std::string> RowLog::take_up(const std::size_t size)
  {
    std::ifstream input(path, std::ios::binary);
    std::string blocks{ std::istreambuf_iterator<char>(input), {} };
    if (blocks.size() < size)
      return {};
    blocks.resize(size);
    auto result = verified_content(blocks);
    if (!result)
      return {};
    file = OpenFile(path, O_WRONLY | O_APPEND);
    if (!file.is_open() || !file.truncate(size))
      return {};
    written = size;
    return result;
  }

  void RowLog::write_block()
  {
    if (!file.is_open())
      file = OpenFile(path, O_WRONLY | O_CREAT | O_TRUNC | O_APPEND);
    const std::string sum = fingerprint(pending.bytes());
    std::size_t length    = pending.bytes().size() + sum.size();
    Archive head;
    head(length);
    for (const auto *const part : { &head.bytes(), &pending.bytes(), &sum })
      if (!file.is_open() || !file.write(*part))
        return fail();
    written += head.bytes().size() + length;
    pending.clear();
  }

  void RowLog::write()
  {
    write_block();
    if (!file.synchronise())
      fail();
  }

  void RowLog::fail()
  {
    const int reason = errno;
    file.truncate(written);
    throw AnalysisError(path + " cannot be written: " + std::strerror(reason));
  }

  bool has_checkpoint(const std::string &folder, const Scene &scene)
  {
    const auto content = content_in(folder + '/' + checkpoint_name);
    return content && content->parameters == checkpoint_parameters(scene);
  }

  Checkpoint::Checkpoint(const Scene &scene, const RunOptions &options)
      : is_kept(options.in_memory == nullptr)
      , quiet(options.quiet)
      , folder(options.folder)
      , parameters(is_kept ? checkpoint_parameters(scene) : "")
      , own_scene_key(is_kept ? scene_key(scene) : "")
      , interval(seconds_between())
      , row_log(folder + '/' + row_log_name)
      , next(Clock::now() + std::chrono::duration_cast<Clock::duration>(interval))
  {
    if (is_kept)
      find();
  }

  /// The key includes the program's fingerprint, as the meaning of stored progress depends on the program to the last
  /// instruction.
  std::string Checkpoint::key() const
  {
    return fingerprint(own_scene_key, program_fingerprint());
  }

  void Checkpoint::find()
  {
    const std::string path = folder + '/' + checkpoint_name;
    if (std::filesystem::exists(path))
    {
      const auto drop = [&](const std::string &reason)
      {
        std::cerr << path << ": " << reason << ": the run begins anew" << std::endl;
        remove_checkpoint(folder);
      };
      auto content = content_in(path);
      if (!content)
        return drop("damaged");
      if (content->key != key())
        return drop("of another scene, of input files that held something else, or of another build of sprag");
      auto rows = row_log.take_up(content->rows);
      if (!rows)
        return drop("its rows are damaged");
      progress_found = std::move(content->progress);
      rows_found     = std::move(*rows);
      is_resumed     = true;
    }
    else
      remove_checkpoint(folder); // what a run left that was killed before its first one
    if (const auto earlier = earlier_result(folder + "/result.h5");
        !is_resumed && !quiet && earlier && earlier->status != "completed")
      std::cout << "Begins anew:  the result in the folder is unfinished and has no checkpoint\n" << std::flush;
  }

  void Checkpoint::serialise_all(const ProgressSerialiser &progress, Archive &archive) const
  {
    progress(archive);
    for (const auto &part : parts)
      part(archive);
  }

  bool Checkpoint::take_up(const ProgressSerialiser &progress)
  {
    if (!resumes())
      return false;
    Archive archive(std::move(progress_found));
    serialise_all(progress, archive);
    return true;
  }

  void Checkpoint::accept_step(const ProgressSerialiser &progress)
  {
    if (is_kept && (interrupted() || Clock::now() >= next))
      try_to([&] { write(progress); });
    end_if_interrupted();
  }

  void Checkpoint::end_steps(const ProgressSerialiser &progress)
  {
    if (is_kept && (is_resumed || is_written))
      try_to([&] { write(progress); });
  }

  void Checkpoint::try_to(const std::function<void()> &write)
  {
    try
    {
      write();
    }
    catch (const AnalysisError &error)
    {
      next = Clock::now() + std::chrono::duration_cast<Clock::duration>(interval);
      if (!std::exchange(has_failed, true))
        std::cerr << error.what() << "; the run goes on without" << std::endl;
    }
  }

  void Checkpoint::write(const ProgressSerialiser &progress)
  {
    const auto begin = Clock::now();
    row_log.write();
    Archive archive, whole;
    serialise_all(progress, archive);
    Content content{ parameters, key(), row_log.size(), archive.bytes() };
    whole(content);
    replace(folder + '/' + checkpoint_name, folder + '/' + next_checkpoint_name, sealed(whole.bytes()));
    is_written     = true;
    const auto end = Clock::now();
    next           = end + std::chrono::duration_cast<Clock::duration>(interval);
    if (interval.count() > 0.)
      next = std::max(next, end + std::chrono::duration_cast<Clock::duration>((end - begin) / largest_share));
  }

  void Checkpoint::finish(const std::string &status) const
  {
    if (is_kept && status != interruption && !is_needed)
      remove_checkpoint(folder);
  }
} // namespace sprag
