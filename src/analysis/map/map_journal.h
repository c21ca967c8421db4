#pragma once

#include "analysis/map/map_cell.h"

#include <string>

namespace sprag
{
  using MapCells = std::map<MapSite, MapCell>;

  /// A file of a map's judged cells, so that a map that was killed goes on where it was. A line a cell, every number to the last
  /// bit, with a checksum over the line and the scene. While it is open, no other run can have it.
  class MapJournal
  {
  public:
    /// Opens the journal and reads the cells in it, or begins one. `scene` is the scene_key(): cells of another scene, or of
    /// another version of the program, are dropped, and so is any line that is not as it was written. Throws InputError if the
    /// file cannot be written or another run keeps it open for more than 5 s.
    MapJournal(const std::string &path, const std::string &scene);
    ~MapJournal();

    MapJournal &operator=(MapJournal &&) = delete;

    /// Cells found in the file.
    const MapCells &cells() const
    {
      return found;
    }

    /// Returns whether the file held cells of another scene, which were dropped.
    bool dropped() const
    {
      return other_scene;
    }

    /// Returns the number of lines that were not as they had been written.
    std::size_t damaged_lines() const
    {
      return damaged;
    }

    /// Hands the lines to the operating system. Throws AnalysisError if they cannot be written.
    void append(const MapCells &more);

    /// Removes the file, once the map is complete.
    void remove();

  private:
    const std::string path;
    int file;
    std::string header;
    MapCells found;
    bool other_scene    = false;
    std::size_t damaged = 0;

    void lock();
    void read();
    void write(const std::string &text);
  };
} // namespace sprag
