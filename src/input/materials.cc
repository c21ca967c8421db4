// SPDX-License-Identifier: GPL-3.0-only
#include "input/materials.h"

#include "base/text.h"

#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/trim.hpp>

#include <algorithm>
#include <sstream>
#include <vector>

namespace sprag
{
  extern const char *const material_page; // put in by CMake

  namespace
  {
    Choices<Material> read_materials()
    {
      Choices<Material> result = { { "none", {} } };
      std::vector<std::string> headings;
      std::istringstream lines(material_page);
      for (std::string line; std::getline(lines, line);)
      {
        const auto cells = split(line, '|');
        if (boost::starts_with(line, "| material"))
          headings = cells;
        if (!boost::starts_with(line, "| `"))
          continue;
        Material material;
        for (std::size_t i = 2; i < std::min(cells.size(), headings.size()); ++i)
          material.emplace(headings[i], cells[i]);
        result.emplace_back(boost::trim_copy_if(cells[1], boost::is_any_of("`")), material);
      }
      return result;
    }
  } // namespace

  const Choices<Material> &materials()
  {
    static const auto result = read_materials();
    return result;
  }
} // namespace sprag
