// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/fields/device_mesh.h"

#include <array>
#include <complex>
#include <string>

namespace sprag
{
  struct Device;

  /// A vibration exp(lambda t) of the apparatus about a held slide.
  struct DeviceMode
  {
    double frequency   = 0.; ///< Im lambda / 2 pi [Hz]
    double growth_rate = 0.; ///< Re lambda [1/s]

    /// The mode of one lever.
    struct LeverShape
    {
      std::array<dealii::Vector<double>, 2> elastic; ///< displacement of the body in the lever's axes, real and imaginary [mm]
      std::complex<double> rotation;                 ///< of the hub [rad]
    };
    std::vector<LeverShape> levers;
    std::complex<double> support; ///< [mm]
  };

  /// Writes a mode for ParaView: `folder`/mode-01.xdmf shows one period of it in 24 frames, Re(phi exp(i omega t)) about the held
  /// slide without growth, over the time; of a mode without frequency one frame, at a time of 1 s. `displacement` includes the
  /// hub's rotation. Its largest value is a twentieth of the lever's length; `displacement_real` and `displacement_imaginary` are
  /// phi in that scale, `elastic_real` and `elastic_imaginary` its elastic part, frequency and growth rate are data of each
  /// frame. Leaf springs are left out.
  void write_mode(const Device &device, const BodyFields &body, const DevicePose &held, const DeviceMode &mode,
                  unsigned int number, const std::string &folder);
} // namespace sprag
