// SPDX-License-Identifier: GPL-3.0-only
#include "run/field_recorder.h"

#include "base/ranges.h"
#include "model/step/state_archive.h"
#include "program/recorder.h"
#include "results/result_file.h"
#include "scene/mirrored_pair.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    constexpr double all_slide   = 0.99; ///< share of mu P from which the whole contact counts as sliding
    constexpr double long_behind = 0.02; ///< travel behind a turning point, over R, after which it is no longer waited for
    constexpr double no_contact  = 1e-3; ///< P over the largest one so far
    constexpr double intervals   = 20.;  ///< between frames over all travel, where no interval is given

    constexpr std::size_t together = 8; ///< states whose fields are found together

    /// Middle of the lever where its free part begins.
    MeshPoint section_at_hub(const BodyFields &fields)
    {
      double begin = std::numeric_limits<double>::max();
      for (const auto &node : fields.nodes)
        if (!node.at_hub && node.part == material_id::lever)
          begin = std::min(begin, node.position[0]);
      double low = std::numeric_limits<double>::max(), high = -low;
      for (const auto &node : fields.nodes)
        if (node.part == material_id::lever && std::abs(node.position[0] - begin) < 1e-6)
        {
          low  = std::min(low, node.position[1]);
          high = std::max(high, node.position[1]);
        }
      return { begin, 0.5 * (low + high) };
    }

    double largest_force(const Row &row)
    {
      return std::fmax(row[Column::P], row.lever_value(Column::P, 1));
    }
  } // namespace

  FieldRecorder::FieldRecorder(const Scene &scene_, BodyFields fields_, Displacements source_,
                               const std::optional<std::string> &folder, PhaseTimer &timer_)
      : scene(scene_)
      , timer(timer_)
      , fields(std::move(fields_))
      , displacements(std::move(source_))
      , peaks(fields)
      , hub_section(section_at_hub(fields))
      , last_x(scene.drive.at(0.).x)
  {
    if (folder)
      frames.emplace(scene, fields, *folder);
  }

  bool FieldRecorder::record(const Row &row, const FaceState &face, const std::function<FieldSource()> &source)
  {
    if (row[Column::v] != 0.)
      direction = row[Column::v] > 0. ? 1 : -1;
    travelled += std::abs(row[Column::x] - last_x);
    last_x     = row[Column::x];
    peak_force = std::max(peak_force, largest_force(row));

    std::shared_ptr<Kept> state;
    const auto kept = [&]
    {
      if (!state)
        state = std::make_shared<Kept>(Kept{ row, face, direction, source() });
      return state;
    };
    for (const auto &[estimate, value] : estimates(row, face))
      if (auto &found = best[{ estimate, direction }]; value > found.value || (!found.state && value > 0.))
        found = { value, kept() };
    const auto frame = frame_kind(row);
    if (frame != FrameKind::none)
      waiting.push_back({ kept(), frame });
    if (waiting.size() == together)
      find_waiting();
    return frame != FrameKind::none;
  }

  std::vector<std::pair<FieldRecorder::Estimate, double>> FieldRecorder::estimates(const Row &row, const FaceState &face) const
  {
    const double surface =
        std::max(largest_surface_stress(face.pressure, face.traction), largest_surface_stress(face.pressure_2, face.traction_2));
    std::vector<std::pair<Estimate, double>> result = { { Estimate::force, largest_force(row) },
                                                        { Estimate::layer_stress, surface },
                                                        { Estimate::lever_moment, moment_at_hub(row) } };
    if (scene.analysis.type == AnalysisType::transient)
      result.emplace_back(Estimate::elastic_energy, row[Column::elastic_energy]);
    return result;
  }

  double FieldRecorder::moment_at_hub(const Row &row) const
  {
    const double drive_force_arm = hub_section[1] - scene.geometry.interface_offset;
    const auto moment            = [&](const unsigned int lever)
    {
      const auto value = [&](const Column column) { return row.lever_value(column, lever); };
      return value(Column::P) > 0.
                 ? std::abs(value(Column::P) * (value(Column::s) - hub_section[0]) - value(Column::F) * drive_force_arm)
                 : 0.;
    };
    return std::max(moment(0), moment(1));
  }

  bool FieldRecorder::slides_back(const Row &row) const
  {
    const double reached = direction * row[Column::friction_resultant];
    return reached > 0. && reached >= all_slide * row[Column::mu] * row[Column::normal_resultant];
  }

  FieldRecorder::FrameKind FieldRecorder::frame_kind(const Row &row)
  {
    if (!frames)
      return FrameKind::none;
    const auto &output = scene.output;
    const bool turning = scene.drive.turns_at(row[Column::time]) || row[Column::time] >= scene.drive.duration();
    bool behind        = false;
    if (turned)
      behind = slides_back(row) || travelled >= *turned + long_behind * scene.geometry.cylinder_radius;
    if (behind)
      turned.reset();
    if (turning)
      turned = travelled;
    const double interval = output.field_interval.value_or(path_length(scene.drive) / intervals);
    const bool due        = output.fields == FieldOutput::interval && travelled >= last_frame + interval - 1e-9;
    if (due || turning)
      last_frame = travelled;
    if ((turning || behind) && largest_force(row) > no_contact * peak_force)
      return FrameKind::whole;
    return due ? FrameKind::between : FrameKind::none;
  }

  void FieldRecorder::find_waiting()
  {
    if (waiting.empty())
      return;
    const PhaseTimer::Scope scope(timer, "fields");
    auto elastic = displacements(mapped(waiting, [](const Waiting &some) { return some.state->source; }));
    for (std::size_t i = 0; i < waiting.size(); ++i)
      find(*waiting[i].state, std::move(elastic[i]), waiting[i].frame);
    waiting.clear();
  }

  void FieldRecorder::find(const Kept &kept, std::vector<dealii::Vector<double>> elastic, const FrameKind frame)
  {
    DeviceState state{ kept.row[Column::time], to_pose(kept.row), std::move(elastic), {}, kept.face };
    StressSample sample;
    for (unsigned int lever = 0; lever < state.displacements.size(); ++lever)
    {
      state.nodal.push_back(fields.at(state.displacements[lever]));
      if (frame == FrameKind::between)
        continue;
      peaks.look_at(state.nodal[lever], kept.row[Column::x], kept.direction, lever);
      look_at(fields, state.nodal[lever], kept.row, sample);
    }
    if (frame != FrameKind::none)
      frames->write(state, frame == FrameKind::whole);
    if (frame == FrameKind::between)
      return;
    samples.push_back(sample);
    looked_at.push_back(kept.row[Column::time]);
  }

  SPRAG_SERIALISE(FieldSource, coordinates, forces, face_force)

  SPRAG_SERIALISE(FieldRecorder::Kept, row, face, direction, source)

  SPRAG_SERIALISE(FieldRecorder::Waiting, state, frame)

  SPRAG_SERIALISE(FieldRecorder::Best, value, state)

  void FieldRecorder::serialise_progress(Archive &archive)
  {
    archive(travelled, last_frame, last_x, peak_force, direction, turned, looked_at, samples, best, waiting);
    peaks.serialise_progress(archive);
    if (frames)
      frames->serialise_progress(archive);
  }

  std::vector<Entry> FieldRecorder::finish()
  {
    find_waiting();
    std::map<double, Waiting> left;
    const Best *largest = nullptr;
    for (const auto &[key, found] : best)
      if (found.state)
      {
        left[found.state->row[Column::time]] = { found.state, FrameKind::none };
        if (key.first == Estimate::force && (largest == nullptr || found.value > largest->value))
          largest = &found;
      }
    if (largest != nullptr && frames)
      left[largest->state->row[Column::time]].frame = FrameKind::whole;
    for (const auto &[time, state] : left)
      if (!contains(looked_at, time))
        waiting.push_back(state);
    find_waiting();
    best.clear();
    return peaks.entries(count_levers(scene));
  }
} // namespace sprag
