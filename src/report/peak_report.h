// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "results/result_file.h"
#include "results/warning.h"

#include <vector>

namespace sprag
{
  struct Scene;

  /// Adds the largest pressure on the friction face over a run of finite elements with x, direction and place, for a pair that of
  /// the lever where it is larger. Adds nothing for models without a face. With a face size [mm] it is the
  /// smoothed_largest_pressure(), for runs without inertia, whose pressure does not ring.
  void add_largest_pressure(const std::vector<Row> &rows, std::vector<Entry> &entries, double face_size = 0.);

  /// The largest pressure of a run without the scatter that passing elements leave between neighbouring rows.
  struct SmoothedPressure
  {
    double value   = 0.; ///< [MPa]
    double scatter = 0.; ///< root mean square distance of the means near by from the smooth curve, at least that of the
                         ///< highest row, over the value
  };

  /// Smooths the pressure of the rows near the largest one, means over a face or a row's step by local regression over six of
  /// these. Where there are too few rows, or the largest one is just behind a reversal, the value is its own, without scatter.
  SmoothedPressure smoothed_largest_pressure(const std::vector<Row> &rows, double face_size);

  /// Returns the relative error of the largest pressure to expect where the contact is `elements` > 0 face sizes wide: at most
  /// 5/elements^3 (displacements of degree 1) or 0.8/elements^3 (degree 2), and 1; tests/benchmarks/pressure.md has the hard
  /// contact against which they were measured.
  double expected_pressure_error(double elements, unsigned int degree);

  /// Faces across the contact below which pressures do not converge with their order yet: the error that a coarser mesh tells is
  /// up to twenty times too large, and expected_pressure_error() bounds it.
  constexpr double least_converging_faces = 6.;

  /// Warns where the mesh is too coarse, by more than 5 % expected, for the largest pressure of a run or for the
  /// pressures over more than a quarter of the way that the cylinder makes in contact.
  Warnings coarse_contact_warnings(const Scene &scene, const std::vector<Row> &rows);

  /// Warns of modes in contact, a contact law and a calibration on a contact narrower than one face of degree 2, two of degree 1,
  /// by its width under P of the closed form. These analyses estimate no errors.
  Warnings narrow_contact_warnings(const Scene &scene);
} // namespace sprag
