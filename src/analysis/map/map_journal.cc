#include "analysis/map/map_journal.h"

#include "base/child_process.h"
#include "base/errors.h"
#include "base/fingerprint.h"
#include "base/text.h"

#include <cerrno>
#include <chrono>
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

    std::string header_of(const std::string &scene)
    {
      Fingerprint key;
      key.add(scene);
      return "sprag " SPRAG_VERSION " map, scene " + key.text() + '\n';
    }

    /// Of a line's numbers, in the journal of a scene.
    std::string checksum(const std::string &header, const std::string &numbers)
    {
      Fingerprint sum;
      sum.add(header);
      sum.add(numbers);
      return sum.text() + '\n';
    }

    std::string line_of(const std::string &header, const MapSite &site, const MapCell &cell)
    {
      std::string numbers = formatted("%a %a ", site.first, site.second);
      for (const double value : cell.values)
        numbers += formatted("%a ", value); // to the last bit
      return numbers + checksum(header, numbers);
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

    /// None where the line is not as line_of() made it.
    std::optional<std::pair<MapSite, MapCell>> cell_of(const std::string &header, const std::string &line)
    {
      const std::size_t behind = line.rfind(' ') + 1; // 0 without a blank
      if (line.substr(behind) != checksum(header, line.substr(0, behind)))
        return {};
      const char *at  = line.c_str();
      const auto next = [&at]
      {
        char *end          = nullptr;
        const double value = std::strtod(at, &end);
        at                 = end;
        return value;
      };
      const double first = next(), second = next();
      MapCell cell{};
      for (double &value : cell.values)
        value = next();
      return std::make_pair(MapSite{ first, second }, cell);
    }
  } // namespace

  MapJournal::MapJournal(const std::string &file_path, const std::string &scene)
      : path(file_path)
      , file(::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666))
      , header(header_of(scene))
  {
    if (file < 0)
      throw InputError(path + " cannot be written: " + std::strerror(errno));
    try
    {
      lock();
      read();
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

  void MapJournal::read()
  {
    const auto lines  = lines_of(path);
    const bool usable = !lines.empty() && lines.front() == header;
    other_scene       = !lines.empty() && !usable;
    if (!usable)
    {
      if (::ftruncate(file, 0) != 0)
        throw InputError(path + " cannot be written: " + std::strerror(errno));
      return write(header);
    }
    for (std::size_t i = 1; i < lines.size(); ++i)
      if (const auto cell = cell_of(header, lines[i]))
        found.insert(*cell);
      else
        ++damaged;
    if (lines.back().back() != '\n')
      write("\n");
  }

  void MapJournal::append(const MapCells &more)
  {
    std::string text;
    for (const auto &[site, cell] : more)
      text += line_of(header, site, cell);
    write(text);
  }

  void MapJournal::write(const std::string &text)
  {
    if (!write_all(file, text))
      throw AnalysisError(path + " cannot be written: " + std::strerror(errno));
  }

  void MapJournal::remove()
  {
    ::unlink(path.c_str());
  }
} // namespace sprag
