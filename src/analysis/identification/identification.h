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
    /// Rows between two turns, in which the cylinder moves in one direction.
    struct Stroke
    {
      std::size_t first; ///< row of the turn that begins it
      std::size_t last;  ///< row of the turn that ends it, which begins the next one
      int direction;     ///< +1 forward, -1 back
    };

    /// Position and velocity of the cylinder.
    struct Place
    {
      double x; ///< [mm]
      double v; ///< [mm/s], with the sign of the stroke's direction
    };

    /// Takes x from the measurement, else from the drive. v is the slope of a line fitted to x over at most a fortieth of the
    /// stroke, or that of the drive; without times it is the drive's peak speed.
    explicit MeasuredMotion(const Scene &scene);

    const std::vector<Stroke> &strokes() const
    {
      return all;
    }

    /// Returns the stroke at the instant of the row less `lag` [s], by which measured forces come late.
    std::size_t stroke_at(std::size_t row, double lag) const;

    /// Returns whether that instant lies within the stroke, its ends excluded: there the direction of motion is unknown.
    bool covers(std::size_t row, double lag, std::size_t stroke) const;

    /// Returns the cylinder's place at that instant. Beyond its ends a stroke is continued at constant speed, so that the place
    /// is a smooth function of the lag.
    Place at(std::size_t row, double lag, std::size_t stroke) const;

    /// Returns the distance covered in the stroke until that instant [mm].
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

  /// A number to be identified.
  struct UnknownNumber
  {
    std::string name; ///< "mu", "k", "offset_P"
    std::string unit;
    std::string meaning;
    double start;
    double scale; ///< size of a large change, > 0; scaled unknowns are value/scale
  };

  /// The properties of a lever and its sensors on which a measured stroke depends.
  struct IdentifiedLever
  {
    Geometry geometry;
    FrictionLaw friction;
    double stiffness;            ///< k [N mm/rad]
    double rest_angle;           ///< of the rotational spring [rad]
    std::vector<double> offsets; ///< of the channels [N]
    double lag = 0.;             ///< [s]
  };

  /// The unknowns of a scene as a list of numbers: a friction law may have several.
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

    /// Returns overrides "Section/Name=value" that give a scene this lever. `friction_table` is the file with mu(v), empty for a
    /// constant mu.
    std::vector<std::string> overrides(IdentifiedLever lever, const std::string &friction_table) const;

    /// Returns, in the form of Stability/Ranges, between which values the scene's parameters lie if each unknown lies between
    /// `low` and `high`. Offsets, lags and functions mu(v) are no parameters. "none" where none is sought.
    std::string ranges(const std::vector<double> &values, const std::vector<double> &low, const std::vector<double> &high) const;

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

  /// Returns the corrections at the drive's peak speed [mm/s], interpolated between 24 positions over the drive; zero for
  /// Analysis/Model = closed form. Throws AnalysisError where the model has no steady slide.
  ModelCorrection model_correction(const Scene &scene, double peak_speed);

  /// One measured force at one row.
  struct UsedValue
  {
    std::size_t row;     ///< of the measurement
    std::size_t channel; ///< of MeasuredStroke::channels
    std::size_t stroke;  ///< of MeasuredMotion::strokes()
    double value;        ///< [N]
  };

  /// Compares a lever with a measured stroke: selects the values to be fitted and computes their residuals.
  class StrokeFit
  {
  public:
    const MeasuredMotion &motion;

    StrokeFit(const Scene &scene, const MeasuredMotion &motion, const LeverUnknowns &unknowns);

    /// Returns the values to be fitted: x > 0, further than `window` [mm] behind a turn, faster than 2 % of the peak speed, and
    /// not in the last 2 % of a stroke, in which the drive slows down. `lag` is in s.
    std::vector<UsedValue> used(double window, double lag) const;

    /// Returns the forces of the lever at a row, correction included; none where it has no slide there.
    std::optional<SlidingForces> slide(const IdentifiedLever &lever, const ModelCorrection &correction, std::size_t row,
                                       std::size_t stroke) const;

    /// Returns the value of a channel under these forces, offset included [N].
    double computed_force(const IdentifiedLever &lever, const SlidingForces &slide, std::size_t channel) const;

    /// Returns sqrt(weight) (measured - computed)/deviation of each value; 1e6 where the lever has no slide. Empty `weights` are
    /// all 1. `deviations` are those of the channels [N].
    std::vector<double> residuals(const std::vector<double> &scaled, const std::vector<UsedValue> &values,
                                  const std::vector<double> &deviations, const ModelCorrection &correction,
                                  const std::vector<double> &weights = {}) const;

    /// Returns the values of scaled unknowns, in their units.
    std::vector<double> in_units(const std::vector<double> &scaled) const;

  private:
    const Scene &scene;
    const LeverUnknowns &unknowns;
    const double inertia; ///< J [t mm^2]; 0 for the closed form, which neglects theta'' of steady sliding
  };

  /// Noise of a channel, estimated from its residuals.
  struct ChannelNoise
  {
    double deviation   = 0.; ///< standard deviation [N]
    double rows        = 0.; ///< number of values used
    double correlation = 1.; ///< rows per independent row: 1 + 2 (sum of the autocorrelation), >= 1
    double spread      = 1.; ///< variance of the estimate over that of least squares under normal noise

    double effective_rows() const
    {
      return rows / correlation;
    }
  };

  /// Returns the influence of a residual r, in standard deviations: r for least squares, r within +-1.345 for Huber's loss.
  double influence(IdentificationLoss loss, double residual);

  /// Returns the noise of each channel from `residuals`, given in `deviations`. The autocorrelation is summed within strokes up
  /// to the first value below 2/sqrt(rows). The mean stays in: a systematic misfit counts as correlated noise.
  std::vector<ChannelNoise> estimate_noise(const std::vector<UsedValue> &values, const std::vector<double> &residuals,
                                           const std::vector<double> &deviations, IdentificationLoss loss, std::size_t unknowns);

  /// Uncertainty of the scaled unknowns.
  struct Uncertainty
  {
    std::vector<double> deviations;      ///< standard deviations
    std::vector<double> correlation;     ///< of i and j at i * unknowns + j
    SingularValues singular;             ///< of the Jacobian over the noise; `left` empty
    double quantile = 0.;                ///< of Student's t for the confidence, two-sided
    double freedom  = 0.;                ///< degrees of freedom: effective rows less unknowns, at least 1
    std::vector<std::string> indistinct; ///< sentences: unknowns that the data do not determine or separate
    std::vector<std::string> weak;       ///< sentences: badly separated unknowns, if all are determined
  };

  /// Returns the uncertainty from the Jacobian of residuals in deviations of `noise`, without weights, and their influence().
  /// Noise may be larger at some values than at others. `confidence` is between 0 and 1.
  Uncertainty uncertainty(const std::vector<double> &jacobian, const std::vector<UsedValue> &values,
                          const std::vector<double> &influences, const std::vector<ChannelNoise> &noise,
                          const std::vector<UnknownNumber> &unknowns, double confidence);

  /// An identified number with its confidence interval, in its unit.
  struct FoundNumber
  {
    UnknownNumber number;
    double value;
    double deviation; ///< standard deviation
    double low, high; ///< ends of the interval
  };

  /// An unknown that was not sought and whose change would explain the residuals.
  struct OneMoreUnknown
  {
    std::string name; ///< "Geometry/Cylinder radius"
    std::string unit;
    double change; ///< from the scene's value
    double share;  ///< of the sum of squared residuals, noise subtracted, that it explains
  };

  /// Result of identifying a lever from a measured stroke.
  struct Identification
  {
    std::vector<FoundNumber> found;
    std::vector<ChannelNoise> noise; ///< of the channels of the measurement
    Uncertainty uncertainty;
    IdentifiedLever lever;
    ModelCorrection correction;
    std::vector<UsedValue> used;
    double window       = 0.;    ///< distance behind each turn that is not fitted [mm]
    bool window_is_full = false; ///< a window found from the data reached its upper limit
    unsigned int rounds = 0;     ///< fits, each with new noise, window and correction
    bool converged      = false;
    std::vector<OneMoreUnknown> more; ///< that would explain the residuals, see more_unknowns()
  };

  /// Finds the unknowns of the scene's stroke. Throws AnalysisError where too few values are left.
  Identification identify(const Scene &scene, const MeasuredMotion &motion, const LeverUnknowns &unknowns);
} // namespace sprag
