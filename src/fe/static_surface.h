#pragma once

#include "fe/face_patches.h"
#include "fe/static_ports.h"
#include "model/contact_point.h"
#include "model/port_forces.h"

namespace sprag
{
  /// [N/mm^3], > 0
  struct ContactPenalties
  {
    double normal;
    double tangential;
  };

  /// What an evaluation without inertia found at an integration point of the friction face.
  struct StaticPoint
  {
    unsigned int index;  ///< in FrictionFace::points
    LeverPoint position; ///< deformed, lever axes
    double gap;
    double trial_pressure; ///< lambda - eps g: the pressure where positive [MPa]
    double slip_change;    ///< in a step at the speed of its end [mm]
    double elastic_slip;   ///< of the tangential penalty [mm]

    /// Force on the lever, its coordinates as in Obstacle; the tangent counts against a rigid obstacle alone.
    ContactResponse<4> response;
  };

  /// A step in which tractions are sought.
  struct StaticStep
  {
    const std::vector<ContactMemory> &start; ///< of all points, with the multipliers of the current augmentation
    ContactLaw law;
    FrictionMode mode;
    bool multipliers; ///< whether the traction remembered is a multiplier

    // Of a lever that follows a cylinder. mu is taken at the speed with which a point slides where the step ends, which differs
    // from its mean over the step: most points were not in contact when it began, and the cylinder has changed its speed. What
    // moves along the lever with the contact does so almost steadily, so that a point's rate follows from the place that had
    // the same distance from the contact when the step began, and from the slip's slope along the face where it ends.
    double travel      = 0.; ///< of the contact along the lever in the step [mm]; 0: speeds are means
    double speed_ratio = 1.; ///< sliding speed of a rigid lever at the end over its mean; the law's duration is shorter by it
  };

  /// By how much more a point would slip in a step at the speed of its end, the ratio of speeds apart [mm].
  struct SlipShift
  {
    double slip    = 0.;
    double elastic = 0.; ///< what the elastic slip of the tangential penalty would change less
    double d_slope = 0.; ///< derivative by the slope [mm]

    double total() const
    {
      return slip + elastic;
    }
  };

  /// `slope`: of the slip coordinate along the face at the end of the step. None where the contact came from beyond the face.
  SlipShift slip_shift(const FacePatches &face, unsigned int point, double slope, const StaticStep &step);

  /// Forces of one patch of the friction face on some ports, in any order, and their tangent.
  struct StaticPatch
  {
    std::vector<unsigned int> ports;
    dealii::Vector<double> values;
    dealii::FullMatrix<double> tangent;
  };

  /// Sets forces and tangent of a patch from those over its coordinates, of which `coordinates` are its ports. The support's
  /// displacement moves the obstacle's position, coordinate `x`, back.
  template <class Values, class Tangent>
  void set_on_ports(const std::vector<unsigned int> &coordinates, const unsigned int x, const Values &values,
                    const Tangent &tangent, StaticPatch &patch)
  {
    const auto n    = static_cast<unsigned int>(coordinates.size());
    const auto sign = [x](const unsigned int i) { return i == x ? -1. : 1.; };
    patch.values.reinit(n);
    patch.tangent.reinit(n, n);
    for (unsigned int i = 0; i < n; ++i)
    {
      patch.values[i] = sign(coordinates[i]) * values(coordinates[i]);
      for (unsigned int j = 0; j < n; ++j)
        patch.tangent(i, j) = sign(coordinates[i]) * sign(coordinates[j]) * tangent(coordinates[i], coordinates[j]);
    }
  }

  /// What the friction face rubs against, without inertia.
  class StaticSurface
  {
  public:
    virtual ~StaticSurface() = default;

    /// Where both are, for the calls that follow; the displacements must live as long.
    virtual void enter(const FaceConfiguration &at) = 0;

    /// Patches of the friction face that may touch.
    virtual std::vector<unsigned int> near() = 0;

    /// Appends the points of a patch and, if some are under pressure, their forces.
    virtual void evaluate(unsigned int patch, const StaticStep &step, std::vector<StaticPoint> &points,
                          std::vector<StaticPatch> &loaded) = 0;

    /// Slip coordinates of the points of a patch, whether they touch or not [mm].
    virtual std::vector<double> slips(unsigned int patch) = 0;

    /// Why what touches at the last evaluation of all patches near is beyond the surface; empty if it is not.
    virtual std::string objection() const
    {
      return {};
    }
  };

  /// Sets a point's pressures and slip from its gap and how far it slipped; whether it is under pressure.
  bool set_trial(const ContactMemory &memory, double gap, double slip_change, const ContactLaw &law, StaticPoint &point);

  /// Sets the elastic slip of a point under pressure whose response is known, and its slip at the speed of the step's end.
  void set_slips(const ContactMemory &memory, const StaticStep &step, double shift, StaticPoint &point);
} // namespace sprag
