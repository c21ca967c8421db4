#pragma once

#include "analysis/map_cell.h"

#include <string>

namespace sprag
{
  using MapCells = std::map<MapSite, MapCell>;

  /// A file of a map's judged cells, so that a map that was killed goes on where it was. A line a cell, every number to the last
  /// bit. While it is open, no other run can have it.
  class MapJournal
  {
  public:
    /// Opens the journal and reads the cells in it, or begins one. `scene` is the text of all parameters: cells of another scene,
    /// or of another version of the program, are dropped. A last line without end is dropped as well. Throws InputError if the
    /// file cannot be written or another run keeps it open for more than 5 s.
    MapJournal(const std::string &path, const std::string &scene);
    ~MapJournal();

    MapJournal(const MapJournal &)            = delete;
    MapJournal &operator=(const MapJournal &) = delete;

    /// Cells found in the file.
    const MapCells &cells() const;

    /// Whether the file held cells of another scene.
    bool dropped() const;

    /// Hands the lines to the operating system. Throws AnalysisError if they cannot be written.
    void append(const MapCells &more);

    /// The map is complete: removes the file.
    void remove();

  private:
    const std::string path;
    int file;
    MapCells found;
    bool other_scene = false;

    void lock();
    void read(const std::string &header);
    void write(const std::string &text);
  };
} // namespace sprag
