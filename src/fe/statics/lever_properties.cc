// SPDX-License-Identifier: GPL-3.0-only
#include "fe/statics/lever_properties.h"

#include "base/ranges.h"
#include "base/text.h"
#include "scene/closed_form.h"
#include "scene/contact_estimates.h"
#include "scene/device.h"
#include "scene/mirrored_pair.h"
#include "scene/pair_closed_form.h"

namespace sprag
{
  namespace
  {
    std::vector<ConnectorSettings> plate_connectors(const FrictionPlate &plate)
    {
      if (plate.type == PlateType::none)
        return {};
      const auto sensor = [&](const double middle) {
        return ConnectorSettings{ ConnectorType::sensor, middle, plate.sensor_length, plate.sensor_stiffness };
      };
      auto result = mapped(plate.sensors, sensor);
      result.push_back({ ConnectorType::guide, plate.guide, plate.sensor_length, plate.guide_stiffness });
      return result;
    }
  } // namespace

  LeverProperties lever_properties(const Device &device)
  {
    LeverProperties result;
    result.body.degree   = device.mesh.degree;
    result.body.plane    = device.analysis.plane;
    result.body.material = device.lever.material;
    result.body.width    = device.lever.width;
    const ElasticConstants metal{ device.lever.young_modulus, device.lever.poisson_ratio };
    result.body.constants  = { { material_id::lever, metal },
                               { material_id::web, metal },
                               { material_id::plate, { device.plate.young_modulus, device.plate.poisson_ratio } },
                               { material_id::layer, { device.layer.young_modulus, device.layer.poisson_ratio } } };
    result.body.planes     = { { material_id::layer, device.layer.plane }, { material_id::cylinder, device.cylinder.plane } };
    result.body.widths     = { { material_id::web, device.frame.web } };
    result.body.connectors = plate_connectors(device.plate);

    if (device.cylinder.type != CylinderType::rigid)
      result.body.constants[material_id::cylinder] = { device.cylinder.young_modulus, device.cylinder.poisson_ratio };
    result.body.curved = device.cylinder.type != CylinderType::rigid;

    // Half a spacing off, the direction of a contact narrower than it is wrong by 1/8000 at most.
    result.body.point_spacing = device.geometry.cylinder_radius / 4000.;

    const Geometry geometry = device.geometry;
    result.centre           = cylinder_centre(geometry);
    result.radius           = geometry.cylinder_radius;
    result.ideal_theta      = [geometry](double x) { return kinematics(geometry, x).theta; };
    result.spring           = { moment_law(device.spring), kinematics(geometry, 0.).theta, geometry.pivot_distance };
    if (device.support.type == SupportType::sprung)
      result.support_stiffness = device.support.stiffness;
    result.friction         = device.friction;
    result.contact          = device.contact;
    result.longest_face     = face_grading(device).value_or(FaceGrading{}).longest;
    result.solution         = device.analysis.solution;
    result.layer_thickness  = device.layer.thickness;
    result.interface_offset = geometry.interface_offset;
    result.cylinder         = device.cylinder;
    result.geometry         = geometry;
    result.is_damper        = true;
    return result;
  }

  std::vector<LeverProperties> all_lever_properties(const Device &device)
  {
    if (count_levers(device) == 1)
      return { lever_properties(device) };
    std::vector<LeverProperties> result;
    for (const unsigned int lever : { 0, 1 })
    {
      result.push_back(lever_properties(lever_device(device, lever)));
      result.back().spring.rest = rest_inclination(device);
      result.back().ideal_theta = [device, lever](const double x) { return pair_inclinations(device, x)[lever]; };
    }
    return result;
  }

  std::string check_locking(const Row &row, const double interface_offset, const DrivePoint &drive)
  {
    const double s    = row[Column::s];
    const double mu_e = row[Column::mu] * interface_offset;
    if (drive_direction(drive.v) >= 0 || row[Column::F] >= 0. || s > mu_e)
      return {};
    return "the lever locks: moving back, s = " + rounded_text(s) + " mm <= mu e = " + rounded_text(mu_e) + " mm; ";
  }

  std::string check_pressure(const double pressure, const double young_modulus)
  {
    constexpr double largest_strain = 0.5;
    const double limit              = largest_strain * young_modulus;
    if (pressure <= limit)
      return {};
    return "the pressure on the friction face exceeds " + rounded_text(limit) +
           " MPa, half of Young's modulus there (Friction layer or Lever/Young's modulus), which linear theory does not bear";
  }
} // namespace sprag
