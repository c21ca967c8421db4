// SPDX-License-Identifier: GPL-3.0-only
#include "program/run_log.h"

#include "base/version.h"
#include "program/output_folder.h"
#include "scene/scene.h"

#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <streambuf>

namespace sprag
{
  namespace
  {
    std::string date()
    {
      const std::time_t now = std::time(nullptr);
      std::tm local         = {};
      ::localtime_r(&now, &local);
      std::ostringstream text;
      text << std::put_time(&local, "%Y-%m-%d %H:%M:%S %z");
      return text.str();
    }

    /// Between quotes where a shell would split it.
    std::string as_typed(const std::string &argument)
    {
      return argument.find_first_of(" '|;&*()") == std::string::npos ? argument : '"' + argument + '"';
    }

    std::string command(const int argc, const char *const *argv)
    {
      std::string text = "Command:";
      for (int i = 0; i < argc; ++i)
        text += ' ' + as_typed(argv[i]);
      return text + '\n';
    }

    std::string specified_parameters(const Scene &scene)
    {
      std::string text;
      if (scene.parameters)
        for (const auto &[name, value] : *scene.parameters)
        {
          if (scene.specified.count(name) > 0)
            text += "  " + name + " = " + value + '\n';
          else if (const auto material = scene.written.find(name); material != scene.written.end())
            text += "  " + name + " = " + value + ", " + material->second + '\n';
        }
      return "Scene:   " + scene.name + ", with\n" + text + '\n';
    }

    std::string log_in(const std::string &folder)
    {
      return folder + '/' + log_name;
    }
  } // namespace

  struct RunLog::Record
  {
    std::string text;       ///< before the file is open
    std::string line;       ///< that is not at its end
    bool in_colour = false; ///< within a sequence of coloured(), which is left out
    std::ofstream file;

    void take(const char c)
    {
      in_colour = in_colour || c == '\033';
      if (in_colour)
        in_colour = c != 'm';
      else if (c == '\r')
        line.clear();
      else
        line += c;
      if (c == '\n')
        put();
    }

    void put()
    {
      if (file.is_open())
        file << line << std::flush;
      else
        text += line;
      line.clear();
    }
  };

  class RunLog::Tee : public std::streambuf
  {
  public:
    Tee(std::ostream &stream_, std::shared_ptr<Record> into)
        : stream(stream_)
        , terminal(stream.rdbuf(this))
        , record(std::move(into))
    {
    }

    ~Tee() override
    {
      stream.rdbuf(terminal);
    }

  protected:
    int_type overflow(const int_type c) override
    {
      if (traits_type::eq_int_type(c, traits_type::eof()))
        return terminal->pubsync() == 0 ? traits_type::not_eof(c) : c;
      record->take(traits_type::to_char_type(c));
      return terminal->sputc(traits_type::to_char_type(c));
    }

    std::streamsize xsputn(const char *const text, const std::streamsize size) override
    {
      for (std::streamsize i = 0; i < size; ++i)
        record->take(text[i]);
      return terminal->sputn(text, size);
    }

    int sync() override
    {
      return terminal->pubsync();
    }

  private:
    std::ostream &stream;
    std::streambuf *const terminal;
    const std::shared_ptr<Record> record;
  };

  RunLog::RunLog(const int argc, const char *const *argv)
      : record(std::make_shared<Record>())
      , out(std::make_unique<Tee>(std::cout, record))
      , error(std::make_unique<Tee>(std::cerr, record))
  {
    record->text = "sprag " + version() + ", " + date() + '\n' + command(argc, argv);
  }

  RunLog::~RunLog() = default;

  void RunLog::open(const std::string &folder, const Scene &scene)
  {
    if (record->file.is_open())
      return;
    const bool goes_on = has_progress(folder, scene);
    record->file.open(log_in(folder), goes_on ? std::ios::app : std::ios::trunc);
    const auto head = record->text.find('\n', record->text.find('\n') + 1) + 1;
    record->file << (goes_on ? "\n" : "") << record->text.substr(0, head) << specified_parameters(scene)
                 << record->text.substr(head) << std::flush;
  }

  void add_to_log(const std::string &folder, const std::string &line)
  {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(log_in(folder), ignored))
      std::ofstream(log_in(folder), std::ios::app) << line << '\n';
  }
} // namespace sprag
