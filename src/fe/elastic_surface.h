#pragma once

#include "fe/elastic_body.h"
#include "fe/face_pair_rows.h"
#include "fe/rigid_surface.h"

namespace sprag
{
  /// An elastic cylinder below the friction face, see FacePair. A point of the friction face stands for a facet: pressure and
  /// traction are those of the facet's mean gap and slip. Ports of the cylinder's nodes follow those of the lever's.
  class ElasticSurface : public StaticSurface
  {
  public:
    /// `radius` R [mm]: how far the cylinder's surface runs in its axes as they turn by 1, 0 for a body that turns with them.
    /// `undeformed`: the cylinder without load, of whose slip that of points beside its face is taken. The body must outlive
    /// this.
    ElasticSurface(const ElasticBody<2> &body, Obstacle undeformed, double radius, const StaticPorts &ports);

    void enter(const FaceConfiguration &at) override;
    std::vector<unsigned int> near() override;
    void evaluate(unsigned int patch, const StaticStep &step, std::vector<StaticPoint> &points,
                  std::vector<StaticPatch> &loaded) override;
    std::vector<double> slips(unsigned int patch) override;
    std::string objection() const override;

  private:
    struct Sum;

    double slip(const Facet &facet, const LeverPoint &position) const;
    std::vector<double> slopes(const FacePatches::Patch &patch, const std::vector<double> &slips) const;
    static std::array<unsigned int, 2> neighbours(const FacePatches::Patch &patch, unsigned int q);
    static double distance(const FacePatches::Patch &patch, unsigned int before, unsigned int after);
    void add(const Facet &facet, const ContactMemory &memory, double run, const SlipShift &shift, const StaticStep &step,
             StaticPoint &point, Sum &sum);
    void add_slope(const FacePatches::Patch &patch, unsigned int q, double traction_by_slope, Sum &sum);
    StaticPatch on_ports(const Sum &sum) const;

    const FacePatches face;
    const FacePair pair;
    const Obstacle undeformed;
    const double radius;
    const StaticPorts ports;
    const LeverPoint first_node; ///< of the cylinder's face, about its centre
    PairConfiguration at;
    PatchFacets of; ///< of the patch last looked at
    FacetRows rows;
    bool beyond_face = false;
  };
} // namespace sprag
