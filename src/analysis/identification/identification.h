// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/nonlinear_least_squares.h"
#include "laws/friction_law.h"
#include "model/step/dynamic_model.h"
#include "scene/identification.h"
#include "scene/lever.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  struct Scene;

  /// Motion of the cylinder at the rows of a measurement: strokes one way, between turns of at least 2 % of the whole range.
  class MeasuredMotion
  {
  public:
    struct Stroke
    {
      std::size_t first; ///< row of the turn that begins it
      std::size_t last;  ///< row of the turn that ends it, which begins the next one
      int direction;     ///< +1 forward, -1 back
    };

    struct Place
    {
      double x; ///< [mm]
      double v; ///< [mm/s], with the sign of the stroke's direction
    };

    /// Takes x of the measurement, or else of the drive at its times; v from a line through x over up to a fortieth of the
    /// stroke, or of the drive, at its peak speed where no times are known.
    explicit MeasuredMotion(const Scene &scene);

    const std::vector<Stroke> &strokes() const
    {
      return all;
    }

    /// Returns the stroke of what is measured in a row that comes a lag behind x [s].
    std::size_t stroke_at(std::size_t row, double lag) const;

    /// Returns whether the cylinder was in the stroke a lag before the row, behind its first row and before its last:
    /// which way it moves there nobody knows.
    bool covers(std::size_t row, double lag, std::size_t stroke) const;

    /// Returns where the cylinder was a lag before the row. Beyond the stroke's ends it goes on at their speed, so that a place
    /// changes smoothly with the lag.
    Place at(std::size_t row, double lag, std::size_t stroke) const;

    /// Returns how far the cylinder has gone in the stroke a lag before the row [mm].
    double travel(std::size_t row, double lag, std::size_t stroke) const;

    /// Returns the distance between the ends of a stroke [mm].
    double length(std::size_t stroke) const;

    double peak_speed() const
    {
      return fastest;
    }

    /// Returns the mean time between rows, 0 where no times are known [s].
    double spacing() const;

  private:
    std::vector<double> time, x;
    std::vector<Stroke> all;
    std::vector<std::vector<double>> speeds; ///< of each stroke at its rows, signed
    double fastest = 0.;

    void find_strokes();
    std::vector<double> measured_speeds(const Stroke &stroke) const;
  };

  struct UnknownNumber
  {
    std::string name; ///< "mu", "k", "offset_P"
    std::string unit;
    std::string meaning;
    double start;
    double scale; ///< a change that is large, > 0
  };

  /// A lever as far as a stroke tells of it.
  struct IdentifiedLever
  {
    Geometry geometry;
    FrictionLaw friction;
    double stiffness;            ///< k [N mm/rad]
    double rest_angle;           ///< of the rotational spring [rad]
    std::vector<double> offsets; ///< of the channels [N]
    double lag = 0.;             ///< [s]
  };

  /// The unknowns of a scene as numbers, of which a law of friction may have several.
  class LeverUnknowns
  {
  public:
    LeverUnknowns(const Scene &scene, const MeasuredMotion &motion);

    const std::vector<UnknownNumber> &numbers() const
    {
      return all;
    }

    /// Returns the lever with these values; throws InputError where they make no lever.
    IdentifiedLever lever(const std::vector<double> &values) const;

    /// Returns the scene with the lever, changed in memory.
    Scene scene_with(const IdentifiedLever &lever) const;

    /// Returns "Section/Name=value" for what a scene has of the lever. `friction_table` is the file that a polynomial or table of
    /// mu is in.
    std::vector<std::string> overrides(IdentifiedLever lever, const std::string &friction_table) const;

    /// Returns the rows, speed [mm/s] and mu, of a polynomial or table of mu; empty for another law.
    std::vector<std::pair<double, double>> friction_rows(const std::vector<double> &values) const;

  private:
    const Scene &scene;
    const double peak_speed;
    std::vector<UnknownNumber> all;

    void add_friction(Unknown unknown, const MeasuredMotion &motion);
    void add_offsets();
  };

  /// Forces of a model's steady slide less those of the closed form, at x [mm] in a direction, 1 or -1.
  using ModelCorrection = std::function<SlidingForces(double x, int direction)>;

  /// Returns the differences of the scene's model from the closed form of the same lever, at the drive's peak speed and at places
  /// over the drive between which they are interpolated; nothing for Analysis/Model = closed form. Throws AnalysisError where the
  /// model has no steady slide.
  ModelCorrection model_correction(const Scene &scene, double peak_speed);

  /// One measured force at one row.
  struct UsedValue
  {
    std::size_t row;
    std::size_t channel;
    std::size_t stroke;
    double value; ///< [N]
  };

  /// A lever against a measured stroke: which values count, and by how much the lever misses them.
  class StrokeFit
  {
  public:
    const MeasuredMotion &motion;

    StrokeFit(const Scene &scene, const MeasuredMotion &motion, const LeverUnknowns &unknowns);

    /// Returns the values that count with this window behind each turn [mm] and lag: x > 0, a speed of more than 2 % of the
    /// peak, and not the last 2 % of a stroke, in which the drive slows down to turn.
    std::vector<UsedValue> used(double window, double lag) const;

    /// Returns the forces of the lever at a row, correction included; none where it has no slide there.
    std::optional<SlidingForces> slide(const IdentifiedLever &lever, const ModelCorrection &correction, std::size_t row,
                                       std::size_t stroke) const;

    /// Returns what a channel shows of them, offset included [N].
    double shown(const IdentifiedLever &lever, const SlidingForces &slide, std::size_t channel) const;

    /// Returns measured less shown over the standard deviation of the channel and times the square root of the weight, where
    /// there are weights; large numbers where the lever has no slide.
    std::vector<double> residuals(const std::vector<double> &scaled, const std::vector<UsedValue> &values,
                                  const std::vector<double> &deviations, const ModelCorrection &correction,
                                  const std::vector<double> &weights = {}) const;

    /// Returns the unknowns in their units.
    std::vector<double> in_units(const std::vector<double> &scaled) const;

  private:
    const Scene &scene;
    const LeverUnknowns &unknowns;
    const double inertia; ///< J, which a steady speed already turns unevenly [t mm^2]; 0 for the closed form
  };

  /// Noise of a channel, estimated from its residuals.
  struct ChannelNoise
  {
    double deviation   = 0.; ///< standard deviation [N]
    double rows        = 0.; ///< that count
    double correlation = 1.; ///< rows for one independent one: 1 + 2 (sum of the autocorrelation), >= 1
    double spread      = 1.; ///< of the estimate, over that of least squares of normal noise

    double effective_rows() const
    {
      return rows / correlation;
    }
  };

  /// Influence of a residual of so many standard deviations on the fit: itself, or at most Huber's 1.345 either way.
  double influence(IdentificationLoss loss, double residual);

  /// Returns the noise of each channel. `residuals` are over `deviations`. The autocorrelation is summed within strokes up to the
  /// first that is less than 2/sqrt(rows); the mean is not taken off, so that what the lever cannot follow counts as correlated.
  std::vector<ChannelNoise> estimate_noise(const std::vector<UsedValue> &values, const std::vector<double> &residuals,
                                           const std::vector<double> &deviations, IdentificationLoss loss, std::size_t unknowns);

  /// Uncertainty of the unknowns. All entries refer to scaled unknowns.
  struct Knowledge
  {
    std::vector<double> deviations;      ///< standard deviations
    std::vector<double> correlation;     ///< of i and j at i * unknowns + j
    SingularValues singular;             ///< of the Jacobian over the noise; `left` empty
    double quantile = 0.;                ///< of Student's t for the confidence asked for, two-sided
    double freedom  = 0.;                ///< degrees of freedom: effective rows less unknowns, at least 1
    std::vector<std::string> indistinct; ///< sentences: what the data cannot find or tell apart
    std::vector<std::string> weak;       ///< sentences: what they tell apart badly, where they tell all
  };

  /// `jacobian` is that of residuals over the deviations of `noise`, without weights.
  Knowledge knowledge(const std::vector<double> &jacobian, const std::vector<UsedValue> &values,
                      const std::vector<ChannelNoise> &noise, const std::vector<UnknownNumber> &unknowns, double confidence);

  struct FoundNumber
  {
    UnknownNumber number;
    double value;
    double deviation; ///< standard deviation
    double low, high; ///< ends of the interval
  };

  /// An unknown that was not sought and by which the lever would follow the data.
  struct OneMoreUnknown
  {
    std::string name; ///< "Geometry/Cylinder radius"
    std::string unit;
    double change; ///< from the scene's value
    double share;  ///< of the squares of the residuals beyond noise that it explains
  };

  /// Result of identifying a lever from a measured stroke.
  struct Identification
  {
    std::vector<FoundNumber> found;
    std::vector<ChannelNoise> noise; ///< of the channels of the measurement
    Knowledge knowledge;
    IdentifiedLever lever;
    ModelCorrection correction;
    std::vector<UsedValue> used;
    double window       = 0.;    ///< left out behind each turn [mm]
    bool window_is_full = false; ///< whether one from the data ends where no more may be left out
    unsigned int rounds = 0;     ///< of fits, with new noise, window and correction
    bool converged      = false;
    std::vector<OneMoreUnknown> more; ///< that would explain the residuals, see more_unknowns()
  };

  /// Finds the unknowns of the scene's stroke. Throws AnalysisError where too few values are left.
  Identification identify(const Scene &scene, const MeasuredMotion &motion, const LeverUnknowns &unknowns);
} // namespace sprag
