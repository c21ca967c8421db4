#pragma once

#include "fe/static_surface.h"

#include <functional>

namespace sprag
{
  /// What the lever rubs against, a convex body: kinematics of a point of the lever at the obstacle's position x from the pivot
  /// frame's origin and hub rotation theta, in the coordinates (displacement along xi, along eta, theta, x).
  using Obstacle = std::function<ContactKinematics<4>(const LeverPoint &point, double x, double theta)>;

  /// A rigid obstacle below the friction face.
  class RigidSurface : public StaticSurface
  {
  public:
    RigidSurface(const FrictionFace<2> &face, Obstacle obstacle, const StaticPorts &ports);

    void enter(const FaceConfiguration &at) override;
    std::vector<unsigned int> near() override;
    void evaluate(unsigned int patch, const StaticStep &step, std::vector<StaticPoint> &points,
                  std::vector<StaticPatch> &loaded) override;
    std::vector<double> slips(unsigned int patch) override;

  private:
    struct Sum;

    bool is_near(const FacePatches::Patch &patch) const;
    ContactKinematics<4> kinematics_of(const LeverPoint &point) const;
    StaticPatch on_ports(const FacePatches::Patch &patch, const Sum &sum) const;

    const FacePatches face;
    const Obstacle obstacle;
    const StaticPorts ports;
    FaceConfiguration at{};
  };
} // namespace sprag
