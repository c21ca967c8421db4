// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/phase_timer.h"
#include "estimate/quasi_static_accuracy.h"
#include "fe/fields/body_fields.h"
#include "fe/fields/field_frames.h"
#include "fe/fields/stress_peaks.h"
#include "fe/statics/static_interface.h"
#include "levers/dynamics.h"
#include "model/interface/interface_forces.h"
#include "scene/held_slide.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>

namespace sprag
{
  struct Scene;

  /// Variables of a state that determine its displacements; those that its model needs.
  struct FieldSource
  {
    dealii::Vector<double> coordinates;
    DofLoads forces;
    dealii::Vector<double> face_force;
  };

  inline StaticState to_static_state(const FieldSource &source)
  {
    return { source.coordinates, source.forces };
  }

  /// Chooses the states of a run whose fields are found, writes those that are frames and looks at the stress. Frames
  /// (Output/Fields) are: turning points, the first state behind each in which the whole contact slides back (or 0.02 R behind
  /// it), the end, every interval if requested, and the state of the largest P; but for the intervals only those in contact.
  /// Frames of intervals are for films: their stress is not looked at and written as von Mises' alone. Some frames are found and
  /// written together, as their displacements then cost little more than those of one.
  ///
  /// The largest stress of a run is found without the fields of every step: each way the states are kept in which an estimate
  /// from what a step knows anyway is largest, and their fields are found at the end. For the layer the estimate is
  /// sqrt(p^2 + 3 t^2) of the worst point of the face, for the lever the bending moment of P and F at the hub and, in time, the
  /// elastic energy.
  class FieldRecorder
  {
  public:
    /// Finds the elastic displacements of the body in some states: one for each lever, in lever axes.
    using Displacements = std::function<std::vector<std::vector<dealii::Vector<double>>>(const std::vector<FieldSource> &)>;

    /// The scene must outlive the object. Without a folder it finds peaks alone. A run that goes on has its first frames in the
    /// folder already.
    FieldRecorder(const Scene &scene, BodyFields fields, Displacements displacements, const std::optional<std::string> &folder,
                  PhaseTimer &timer);

    /// Looks at an accepted step and returns whether it is a frame. `source` makes what its fields follow from.
    bool record(const Row &row, const FaceState &face, const std::function<FieldSource()> &source);

    /// Serialises what was looked at so far.
    void serialise_progress(Archive &archive);

    /// Finds the fields that are still to be found. Returns the peaks of stress for /summary.
    std::vector<Entry> finish();

    /// Largest stress in each of the states whose fields were found so far, of all levers.
    const std::vector<StressSample> &stress_samples() const
    {
      return samples;
    }

  private:
    /// Keeps a state until its fields are computed.
    struct Kept
    {
      Row row;
      FaceState face;
      int direction = 0;
      FieldSource source;
    };
    friend void serialise(Archive &archive, Kept &kept);

    enum class FrameKind
    {
      none,
      between,
      whole
    };

    /// Selects the estimate by which the state of the largest stress is sought.
    enum class Estimate
    {
      force,
      layer_stress,
      lever_moment,
      elastic_energy
    };

    FrameKind frame_kind(const Row &row);
    bool slides_back(const Row &row) const;
    double moment_at_hub(const Row &row) const;
    std::vector<std::pair<Estimate, double>> estimates(const Row &row, const FaceState &face) const;
    void find_waiting();
    void find(const Kept &kept, std::vector<dealii::Vector<double>> elastic, FrameKind frame);

    const Scene &scene;
    PhaseTimer &timer;
    const BodyFields fields;
    const Displacements displacements;
    StressPeaks peaks;
    std::vector<StressSample> samples;
    std::optional<FieldFrames> frames;
    MeshPoint hub_section; ///< where the bending moment is taken, in lever axes

    double travelled  = 0.; ///< by the cylinder [mm]
    double last_frame = 0.; ///< travel there
    double last_x;
    double peak_force = 0.;
    int direction     = 1;
    /// A state whose fields are still to be found.
    struct Waiting
    {
      std::shared_ptr<Kept> state;
      FrameKind frame = FrameKind::none;
    };
    friend void serialise(Archive &archive, Waiting &waiting);
    std::vector<Waiting> waiting;

    std::optional<double> turned;  ///< travel at a turning point whose state behind it is awaited
    std::vector<double> looked_at; ///< times of states

    /// Keeps the state in which an estimate is largest.
    struct Best
    {
      double value = 0.;
      std::shared_ptr<Kept> state;
    };
    friend void serialise(Archive &archive, Best &best);
    std::map<std::pair<Estimate, int>, Best> best; ///< of the estimates, each way
  };

  /// Returns the body of a meshed model in time for its fields.
  inline BodyFields shown_body(const Scene &scene, const Dynamics &dynamics)
  {
    if (dynamics.lever)
      return BodyFields(*dynamics.lever->body);
    const auto &body = *dynamics.solid->body;
    return { body, candidate_face(contact_range(scene), body) };
  }
} // namespace sprag
