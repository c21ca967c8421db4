#include "analysis/map_journal.h"

#include "base/errors.h"

#include <cerrno>
#include <chrono>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <optional>
#include <sys/file.h>
#include <thread>
#include <unistd.h>

namespace sprag
{
  namespace
  {
    constexpr unsigned int lock_attempts = 50;
    constexpr std::chrono::milliseconds lock_pause(100);

    /// FNV-1a.
    std::uint64_t hash(const std::string &text)
    {
      std::uint64_t result = 0xcbf29ce484222325u;
      for (const char c : text)
        result = (result ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
      return result;
    }

    std::string header_of(const std::string &scene)
    {
      char number[17];
      std::snprintf(number, sizeof number, "%016" PRIx64, hash(scene));
      return "sprag " SPRAG_VERSION " map, scene " + std::string(number) + '\n';
    }

    std::string exact(const double number)
    {
      char text[40];
      std::snprintf(text, sizeof text, "%a ", number);
      return text;
    }

    // A line ends with this, so that a torn one is told from a whole one.
    constexpr char end_mark[] = ".\n";

    std::string line_of(const MapSite &site, const MapCell &cell)
    {
      std::string line = exact(site.first) + exact(site.second);
      for (const double value : cell.values)
        line += exact(value);
      return line + end_mark;
    }

    /// With their ends; the last one may lack it.
    std::vector<std::string> lines_of(const std::string &path)
    {
      std::ifstream input(path);
      std::vector<std::string> lines;
      for (std::string line; std::getline(input, line);)
        lines.push_back(input.eof() ? line : line + '\n');
      return lines;
    }

    /// None where the line is not whole.
    std::optional<std::pair<MapSite, MapCell>> cell_of(const std::string &line)
    {
      const char *at  = line.c_str();
      const auto next = [&]() -> std::optional<double>
      {
        char *behind       = nullptr;
        const double value = std::strtod(at, &behind);
        if (behind == at || *behind != ' ')
          return {};
        at = behind + 1;
        return value;
      };
      const auto first = next(), second = next();
      MapCell cell{};
      for (double &value : cell.values)
        if (const auto number = next())
          value = *number;
        else
          return {};
      if (!first || !second || std::strcmp(at, end_mark) != 0)
        return {};
      return std::make_pair(MapSite{ *first, *second }, cell);
    }
  } // namespace

  MapJournal::MapJournal(const std::string &file_path, const std::string &scene)
      : path(file_path)
      , file(::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666))
  {
    if (file < 0)
      throw InputError(path + " cannot be written: " + std::strerror(errno));
    try
    {
      lock();
      read(header_of(scene));
    }
    catch (...)
    {
      ::close(file);
      throw;
    }
  }

  MapJournal::~MapJournal()
  {
    ::close(file);
  }

  void MapJournal::lock()
  {
    for (unsigned int attempt = 0; ::flock(file, LOCK_EX | LOCK_NB) != 0; ++attempt)
    {
      if (attempt == lock_attempts)
        throw InputError(path + " is in use by another run. Choose another --output, or end that run.");
      std::this_thread::sleep_for(lock_pause);
    }
  }

  void MapJournal::read(const std::string &header)
  {
    const auto lines  = lines_of(path);
    const bool usable = !lines.empty() && lines.front() == header;
    std::size_t whole = usable ? header.size() : 0;
    for (std::size_t i = 1; usable && i < lines.size(); ++i)
    {
      const auto cell = cell_of(lines[i]);
      if (!cell)
        break;
      found.insert(*cell);
      whole += lines[i].size();
    }
    other_scene = !lines.empty() && !usable;
    if (::ftruncate(file, static_cast<off_t>(whole)) != 0)
      throw InputError(path + " cannot be written: " + std::strerror(errno));
    if (!usable)
      write(header);
  }

  const MapCells &MapJournal::cells() const
  {
    return found;
  }

  bool MapJournal::dropped() const
  {
    return other_scene;
  }

  void MapJournal::append(const MapCells &more)
  {
    std::string text;
    for (const auto &[site, cell] : more)
      text += line_of(site, cell);
    write(text);
  }

  void MapJournal::write(const std::string &text)
  {
    for (std::size_t done = 0; done < text.size();)
    {
      const auto written = ::write(file, text.data() + done, text.size() - done);
      if (written < 0 && errno != EINTR)
        throw AnalysisError(path + " cannot be written: " + std::strerror(errno));
      done += written > 0 ? static_cast<std::size_t>(written) : 0;
    }
  }

  void MapJournal::remove()
  {
    ::unlink(path.c_str());
  }
} // namespace sprag
