// SPDX-License-Identifier: GPL-3.0-only
#include "fe/fields/mode_frames.h"

#include "fe/fields/help_first_rank.h"
#include "scene/device.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n_phases    = 24;
    constexpr double largest_over_span = 0.05; ///< largest displacement over the lever's length

    /// Real or imaginary part of the displacement of all nodes.
    struct Shape
    {
      std::vector<Tensor<1, 3>> whole, elastic;
    };

    double complex_part(const std::complex<double> &value, const unsigned int part)
    {
      return part == 0 ? value.real() : value.imag();
    }

    Shape make_shape(const Device &device, const BodyFields &body, const DevicePose &held, const std::vector<DeviceBlock> &blocks,
                     const DeviceMode &mode, const unsigned int part)
    {
      Shape result;
      for (const auto &block : blocks)
      {
        const auto axes   = block_axes(device, held, block);
        const bool meshed = block.part != DevicePart::rigid_cylinder;
        const bool turns  = block.part == DevicePart::lever;
        const auto nodal  = meshed ? body.moved(mode.levers.at(block.lever).elastic[part]) : std::vector<Tensor<1, 3>>();
        Tensor<1, 3> shift;
        shift[0] = turns ? complex_part(mode.support, part) : 0.;
        for (unsigned int i = 0; i < block.positions.size(); ++i)
        {
          const auto elastic = meshed ? axes.turned(nodal[block.nodes[i]]) : Tensor<1, 3>();
          // d(d)/d(theta) = n, d(n)/d(theta) = -d.
          const auto turned = block.positions[i][0] * axes.across - block.positions[i][1] * axes.along;
          result.elastic.push_back(elastic);
          result.whole.push_back(elastic + shift + (turns ? complex_part(mode.levers[block.lever].rotation, part) : 0.) * turned);
        }
      }
      return result;
    }

    Field field(const std::string &name, const std::string &description, const std::vector<Tensor<1, 3>> &values,
                const double scale)
    {
      Field result{ name, "mm", description, 3, {} };
      for (const auto &value : values)
        append(scale * value, result.values);
      return result;
    }

    /// Returns the largest displacement over all phases.
    double largest(const std::array<Shape, 2> &parts)
    {
      double result = 0.;
      for (std::size_t i = 0; i < parts[0].whole.size(); ++i)
        result = std::max(result, std::hypot(parts[0].whole[i].norm(), parts[1].whole[i].norm()));
      return result;
    }
  } // namespace

  void write_mode(const Device &device, const BodyFields &body, const DevicePose &held, const DeviceMode &mode,
                  const unsigned int number, const std::string &folder)
  {
    const auto blocks = device_blocks(device, body, nullptr);
    const std::array<Shape, 2> parts{ { make_shape(device, body, held, blocks, mode, 0),
                                        make_shape(device, body, held, blocks, mode, 1) } };
    const double size  = largest(parts);
    const double scale = size > 0. ? largest_over_span * device.lever.length / size : 1.;

    char name[16];
    std::snprintf(name, sizeof(name), "mode-%02u", number);
    auto mesh = device_mesh(device, held, blocks, body, nullptr);
    mesh.name = name;
    for (const auto &[text, part] : { std::pair("real", 0u), std::pair("imaginary", 1u) })
    {
      const std::string which = std::string(text) + " part of the mode";
      mesh.fixed.push_back(field(std::string("displacement_") + text, which, parts[part].whole, scale));
      mesh.fixed.push_back(
          field(std::string("elastic_") + text, which + ", without rotation and support", parts[part].elastic, scale));
    }
    FieldFiles files(folder, name, { std::move(mesh) }, FrameStorage::one_file, writers_at_hand());
    const bool swings = mode.frequency > 0.;
    // One of ParaView's readers (Xdmf3, 5.11) shows nothing at a time of 0.
    for (unsigned int k = swings ? 1 : n_phases; k <= n_phases; ++k)
    {
      const double phase = 2. * M_PI * k / n_phases;
      auto now           = parts[0].whole;
      for (std::size_t i = 0; i < now.size(); ++i)
        now[i] = std::cos(phase) * now[i] - std::sin(phase) * parts[1].whole[i];
      files.write(swings ? k / (n_phases * mode.frequency) : 1.,
                  { { field("displacement", "from the held slide at this phase, the hub's rotation included", now, scale) } },
                  { { "frequency", "Hz", mode.frequency },
                    { "growth_rate", "1/s", mode.growth_rate },
                    { "phase", "deg", phase * 180. / M_PI },
                    { "hub_rotation_real", "rad", scale * mode.levers[0].rotation.real() },
                    { "hub_rotation_imaginary", "rad", scale * mode.levers[0].rotation.imag() } });
    }
  }
} // namespace sprag
