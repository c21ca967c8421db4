// SPDX-License-Identifier: GPL-3.0-only
#include "program/run_files.h"

#include "base/fingerprint.h"
#include "base/version.h"
#include "input/scene_key.h"
#include "program/checkpoint.h"
#include "scene/scene.h"

#include <fstream>
#include <unistd.h>

namespace sprag
{
  namespace
  {
    bool begins_with(const std::string &header, const std::string &path)
    {
      std::ifstream input(path);
      std::string line;
      return std::getline(input, line) && line + '\n' == header;
    }
  } // namespace

  std::string results_log_header(const std::string &what, const std::string &scene_key)
  {
    Fingerprint key;
    key.add(program_fingerprint());
    key.add(scene_key);
    return "sprag " + version() + " " + what + ", scene " + key.text() + '\n';
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
} // namespace sprag
