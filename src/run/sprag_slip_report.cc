// SPDX-License-Identifier: GPL-3.0-only
#include "run/sprag_slip_report.h"

#include "base/unknown.h"

#include <cmath>

namespace sprag
{
  namespace
  {
    void add_growth(const Growth &growth, std::vector<Entry> &entries)
    {
      entries.push_back({ "linear_growth_rate", growth.eigenvalue.real(), "1/s", "real part of the eigenvalue" });
      entries.push_back(
          { "measured_growth_rate", growth.envelope.rate, "1/s", "slope of the logarithm of P's envelope in time" });
      entries.push_back({ "growth_difference", growth.growth_difference(), "1", "measured over linear growth rate, less 1" });
      entries.push_back({ "linear_frequency", growth.predicted_frequency(), "Hz", "imaginary part of the eigenvalue" });
      entries.push_back({ "measured_frequency", growth.frequency, "Hz", "of P in time" });
      entries.push_back({ "frequency_difference", growth.frequency_difference(), "1", "measured over linear frequency, less 1" });
      entries.push_back(
          { "growth_scatter", growth.envelope.scatter, "1", "root mean square of the logarithms about their line" });
      entries.push_back({ "growth_slid", growth.slid ? 1. : 0., "1", "1: neither stick nor loss of contact in the window" });
      entries.push_back({ "growth_reached", growth.reached ? 1. : 0., "1", "1: up, or down, to the amplitude aimed at" });
    }

    void add_vibration(const Settled &settled, const HeldSlide &slide, const double begin, std::vector<Entry> &entries)
    {
      const auto &window = settled.window;
      entries.push_back(
          { "cycle", settling_name(settled.kind), "",
            "what it comes to: cycle, irregular vibration, slide, or undecided; about a stable slide after a kick" });
      entries.push_back({ "cycle_begin", begin, "s", "of the rows of the last periods" });
      entries.push_back({ "cycle_amplitude_P", window.amplitude_P, "N", "half of largest less smallest P" });
      entries.push_back(
          { "cycle_amplitude_indentation", window.amplitude_indentation, "mm", "half of its largest less smallest" });
      entries.push_back({ "cycle_relative_amplitude", window.amplitude_P / slide.forces.P, "1", "of P, over P of the slide" });
      entries.push_back({ "cycle_open_share", window.open_share, "1", "share of time without contact" });
      entries.push_back(
          { "cycle_stick_share", window.stick_share, "1", "share of time with part of the contact not sliding on" });
      entries.push_back({ "cycle_frequency", window.frequency, "Hz", "strongest line in the spectrum of P" });
      entries.push_back({ "cycle_agreement", settled.agreement, "1", "difference of the amplitudes of the last two windows" });
    }

    using Value = std::function<double(const ContinuationPoint &)>;

    void add_branch(const std::vector<ContinuationPoint> &points, const std::string &way,
                    const Settled ContinuationPoint::*branch, std::vector<Dataset> &datasets)
    {
      const auto add = [&](const std::string &name, const std::string &unit, const std::string &meaning,
                           const std::function<double(const Settled &)> &value)
      {
        datasets.push_back(dataset_of(points, { name + '_' + way, unit, meaning + " on the way " + way },
                                      [&](const ContinuationPoint &point)
                                      { return point.holds() ? value(point.*branch) : unknown; }));
      };
      add("kind", "1", "0 slide, 1 cycle, 2 irregular vibration, 3 undecided,",
          [](const Settled &settled) { return static_cast<double>(settled.kind); });
      add("amplitude_P", "N", "amplitude of P", [](const Settled &settled) { return settled.window.amplitude_P; });
      add("amplitude_indentation", "mm", "amplitude of the indentation",
          [](const Settled &settled) { return settled.window.amplitude_indentation; });
      add("open_share", "1", "share of time without contact", [](const Settled &settled) { return settled.window.open_share; });
      add("stick_share", "1", "share of time with part of the contact not sliding on",
          [](const Settled &settled) { return settled.window.stick_share; });
      add("frequency", "Hz", "frequency of P", [](const Settled &settled) { return settled.window.frequency; });
    }

    Group continuation_group(const std::vector<ContinuationPoint> &points)
    {
      Group group{ "continuation", {} };
      const auto add = [&](const ColumnInfo &info, const Value &value)
      { group.datasets.push_back(dataset_of(points, info, value)); };
      const auto of_slide = [](const ContinuationPoint &point, const double value) { return point.holds() ? value : unknown; };
      add({ "x", "mm", "where the slide is held" }, [](const ContinuationPoint &point) { return point.x; });
      add({ "stable", "1", "1: the slide is stable by its eigenvalues, 0: it is not, or there is none" },
          [](const ContinuationPoint &point) { return point.slide.kind == SlideKind::stable ? 1. : 0.; });
      add({ "growth_rate", "1/s", "largest real part of the eigenvalues" },
          [](const ContinuationPoint &point) { return point.slide.growth_rate(); });
      add({ "mode_frequency", "Hz", "of that eigenvalue" },
          [](const ContinuationPoint &point) { return point.slide.frequency(); });
      add({ "P", "N", "of the slide" },
          [&](const ContinuationPoint &point) { return of_slide(point, point.holds() ? point.slide.slide->forces.P : 0.); });
      add({ "indentation", "mm", "of the slide" },
          [&](const ContinuationPoint &point) { return of_slide(point, point.holds() ? point.slide.slide->indentation : 0.); });
      add_branch(points, "away", &ContinuationPoint::away, group.datasets);
      add_branch(points, "back", &ContinuationPoint::back, group.datasets);
      return group;
    }

    Group growth_group(const Growth &growth, const double at_start)
    {
      const auto column = [&](const ColumnInfo &info, const auto &value) { return dataset_of(growth.sizes, info, value); };
      return { "growth",
               { column({ "time", "s", "from the perturbation on" }, [](const Sample &sample) { return sample.time; }),
                 column({ "amplitude", "1", "of the overlap over its mean, from the envelope of P" },
                        [](const Sample &sample) { return sample.value; }),
                 column({ "predicted", "1", "the same by the eigenvalue" },
                        [&](const Sample &sample) { return at_start * std::exp(growth.eigenvalue.real() * sample.time); }) } };
    }
  } // namespace

  std::vector<Entry> sprag_slip_summary(const SpragSlip &found)
  {
    std::vector<Entry> entries = { { "slide", kind_name(found.slide.kind), "", "stable, flutter, divergence or jammed" } };
    if (found.slide.slide)
    {
      const auto &slide = *found.slide.slide;
      entries.push_back({ "x", slide.drive.x, "mm", "where the slide is held" });
      entries.push_back({ "P", slide.forces.P, "N", "of the slide" });
      entries.push_back({ "indentation", slide.indentation, "mm", "of the slide" });
      entries.push_back({ "slip_speed", slide.speed, "mm/s", "of the slide" });
    }
    if (found.growth)
    {
      add_growth(*found.growth, entries);
      entries.push_back(
          { "linearisation", found.exact ? "exact" : "without the tangential spring of stick", "",
            "of friction in the eigenvalue; the spring is left out where mu falls with speed, Regularisation speed = 0" });
    }
    if (found.settled)
      add_vibration(*found.settled, *found.slide.slide, found.settled_begin, entries);
    if (!found.points.empty())
    {
      const auto range = found.coexistence.value_or(Coexistence{ unknown, unknown });
      entries.push_back(
          { "coexistence_from", range.from, "mm", "x from which a stable slide and a vibration live side by side" });
      entries.push_back({ "coexistence_to", range.to, "mm", "x up to which they do; NaN: nowhere" });
    }
    entries.push_back({ "energy_residual_share", found.ledger.share(), "1", "largest residual over the largest work" });
    entries.push_back({ "steps", static_cast<double>(found.steps), "1", "accepted steps" });
    return entries;
  }

  std::vector<Group> sprag_slip_groups(const SpragSlip &found, const SpragSlipSettings &settings)
  {
    std::vector<Group> groups;
    if (found.growth)
      groups.push_back(growth_group(*found.growth, found.slide.kind == SlideKind::stable ? settings.final : settings.initial));
    if (!found.points.empty())
      groups.push_back(continuation_group(found.points));
    return groups;
  }
} // namespace sprag
