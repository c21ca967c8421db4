// SPDX-License-Identifier: GPL-3.0-only
#pragma once

namespace sprag
{
  /// Divides a span of time into equal units and each of them into 1, 2, 3, 4, 6, 8, 12 ... equal steps, or only 1, 2, 4, 8 ...,
  /// so that the end is hit and few different durations come up: what a model prepares for one serves again. Durations without
  /// their last digits are equal to the last bit where they are equal but for round-off.
  class StepGrid
  {
  public:
    /// Divides units by halves alone from the next choose() on, for models that prepare much for each duration.
    void use_halves_alone()
    {
      by_halves = true;
    }

    /// Begins a span with as few units as are not longer than `longest` [s], > 0. `to` > `from`.
    void begin(double from, double to, double longest);

    /// Returns whether nothing is left of a span that ends at `to`, or it is another.
    bool needs_span(double to) const
    {
      return is_finished() || end != to;
    }

    bool is_finished() const
    {
      return unit == units;
    }

    /// Makes the present step as long as the grid lets it be from here, but not longer than `target` [s].
    void choose(double target);

    /// Makes the present step shorter, to about half or two thirds.
    void shorten();

    /// Returns the duration of the present step [s].
    double duration() const;

    /// Returns the end of the present step [s].
    double step_end() const;

    /// Goes on to the next step.
    void advance();

  private:
    double origin = 0., end = 0.;
    unsigned long units = 0, unit = 0;   ///< of the span, and the present one
    unsigned long parts = 1, passed = 0; ///< steps of the unit, and those behind

    bool by_halves = false;

    unsigned long next_parts(unsigned long present) const;

    double length() const
    {
      return (end - origin) / static_cast<double>(units);
    }
  };
} // namespace sprag
