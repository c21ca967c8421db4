#include "fe/elastic_surface.h"

#include <algorithm>

namespace sprag
{
  using dealii::FullMatrix;
  using dealii::Vector;

  /// Over the coordinates of a patch.
  struct ElasticSurface::Sum
  {
    explicit Sum(const PairCoordinates &of_patch)
        : coordinates(of_patch)
        , values(of_patch.size())
        , tangent(of_patch.size(), of_patch.size())
    {
    }

    PairCoordinates coordinates;
    Vector<double> values;
    FullMatrix<double> tangent;
  };

  namespace
  {
    LeverPoint first_node_of(const FrictionFace<2> &face)
    {
      const auto position = face.edges.front().nodes.front().position;
      return { position[0], position[1] };
    }
  } // namespace

  ElasticSurface::ElasticSurface(const ElasticBody<2> &body, Obstacle undeformed_body, const double radius_,
                                 const StaticPorts &ports_)
      : face(body.friction_face())
      , pair(body.friction_face(), body.cylinder_face())
      , undeformed(std::move(undeformed_body))
      , radius(radius_)
      , ports(ports_)
      , first_node(first_node_of(body.cylinder_face()))
  {
  }

  void ElasticSurface::enter(const FaceConfiguration &places)
  {
    at          = pair.configuration(places);
    beyond_face = false;
  }

  std::vector<unsigned int> ElasticSurface::near()
  {
    const auto range = pair.near(at);
    std::vector<unsigned int> result;
    for (unsigned int patch = range.begin; patch < range.end; ++patch)
      result.push_back(patch);
    return result;
  }

  /// How far the cylinder's undeformed surface has run past a facet, from where its first node without load counts 0 against
  /// the undeformed body.
  double ElasticSurface::slip(const Facet &facet, const LeverPoint &position) const
  {
    const auto &places = at.at;
    if (!facet.opposed)
      return undeformed(position, places.x, places.theta).slip;
    const LeverPoint begin{ places.centre.xi + first_node.xi, places.centre.eta + first_node.eta };
    return facet.arc + undeformed(begin, places.x, places.theta).slip;
  }

  std::vector<double> ElasticSurface::slips(const unsigned int patch)
  {
    const auto &of_face = face.patches()[patch];
    const auto nodal    = FacePatches::nodal(of_face, *at.at.displacement);
    pair.find_facets(patch, at, of);
    std::vector<double> result;
    for (unsigned int q = of_face.begin; q < of_face.end; ++q)
      result.push_back(slip(of.facets[q - of_face.begin], FacePatches::position(face.points()[q], nodal)));
    return result;
  }

  void ElasticSurface::evaluate(const unsigned int patch, const StaticStep &step, std::vector<StaticPoint> &points,
                                std::vector<StaticPatch> &loaded)
  {
    const auto &of_face = face.patches()[patch];
    const auto nodal    = FacePatches::nodal(of_face, *at.at.displacement);
    const auto slip_of  = slips(patch);
    const auto slope    = slopes(of_face, slip_of);
    Sum sum(pair.coordinates(patch, { &of }));
    bool touches = false, ends = false;
    for (unsigned int q = of_face.begin; q < of_face.end; ++q)
    {
      const auto &facet  = of.facets[q - of_face.begin];
      const auto &memory = step.start[q];
      auto &point        = points.emplace_back();
      point.index        = q;
      point.position     = FacePatches::position(face.points()[q], nodal);
      const double run   = slip_of[q - of_face.begin] - memory.slip;
      ends               = ends || !facet.opposed;
      if (!set_trial(facet.opposed ? memory : ContactMemory{}, facet.gap, facet.stretch * run, step.law, point))
        continue;
      touches          = true;
      const auto shift = slip_shift(face, q, slope[q - of_face.begin], step);
      add(facet, memory, run, shift, step, point, sum);
      set_slips(memory, step, facet.stretch * shift.slip, point);
      if (const double by_slope = shift.d_slope * facet.stretch * point.response.d_shift; by_slope != 0.)
        add_slope(of_face, q, by_slope, sum);
    }
    beyond_face = beyond_face || (touches && ends);
    if (touches)
      loaded.push_back(on_ports(sum));
  }

  /// The facets beside one, of whose slips the slope is the difference.
  std::array<unsigned int, 2> ElasticSurface::neighbours(const FacePatches::Patch &patch, const unsigned int q)
  {
    return { { std::max(q, patch.begin + 1) - 1, std::min(q + 1, patch.end - 1) } };
  }

  /// Of the slip along the face [1].
  std::vector<double> ElasticSurface::slopes(const FacePatches::Patch &patch, const std::vector<double> &slips) const
  {
    std::vector<double> result(slips.size(), 1.);
    for (unsigned int q = patch.begin; patch.end > patch.begin + 1 && q < patch.end; ++q)
    {
      const auto [before, after] = neighbours(patch, q);
      result[q - patch.begin]    = (slips[after - patch.begin] - slips[before - patch.begin]) / distance(patch, before, after);
    }
    return result;
  }

  /// Along the undeformed face, which the facets of a patch share evenly [mm].
  double ElasticSurface::distance(const FacePatches::Patch &patch, const unsigned int before, const unsigned int after)
  {
    return patch.length * (after - before) / (patch.end - patch.begin);
  }

  /// How the traction on a facet changes with the slip's slope. Turning moves both neighbours alike.
  void ElasticSurface::add_slope(const FacePatches::Patch &patch, const unsigned int q, const double traction_by_slope, Sum &sum)
  {
    const auto [before, after] = neighbours(patch, q);
    const auto &left           = of.facets[before - patch.begin];
    const auto &right          = of.facets[after - patch.begin];
    if (before == after || !left.opposed || !right.opposed)
      return;
    FacetRows at_left, at_right;
    find_rows(of, left, at, sum.coordinates, radius, at_left);
    find_rows(of, right, at, sum.coordinates, radius, at_right);
    at_right.arc -= at_left.arc;
    add_product(-of.facets[q - patch.begin].weight * traction_by_slope / distance(patch, before, after), rows.slip, at_right.arc,
                sum.tangent);
  }

  void ElasticSurface::add(const Facet &facet, const ContactMemory &memory, const double run, const SlipShift &shift,
                           const StaticStep &step, StaticPoint &point, Sum &sum)
  {
    // Gap and slip as the only coordinates.
    ContactKinematics<2> kinematics{ facet.gap, {}, {}, point.slip_change, {}, {}, facet.stretch * shift.slip + shift.elastic };
    kinematics.gap_row[0] = kinematics.slip_row[1] = 1.;
    ContactMemory from                             = memory;
    from.slip                                      = 0.;
    const auto response                            = contact_response(kinematics, from, step.law, step.mode);
    const double normal                            = response.force[0];
    const double along_slip                        = response.force[1];

    find_rows(of, facet, at, sum.coordinates, radius, rows);
    point.response.pressure = response.pressure;
    point.response.traction = response.traction;
    point.response.mu       = response.mu;
    point.response.slipping = response.slipping;
    point.response.d_shift  = response.d_shift;
    for (unsigned int i = 0; i < 2 * sum.coordinates.n_lever; ++i)
      point.response.force[i % 2] += normal * rows.gap[i] + along_slip * rows.slip[i];
    for (const auto &[i, coordinate] : { std::pair{ 2u, sum.coordinates.theta() }, { 3u, sum.coordinates.x() } })
      point.response.force[i] = normal * rows.gap[coordinate] + along_slip * rows.slip[coordinate];

    const double weight = facet.weight;
    sum.values.add(weight * normal, rows.gap, weight * along_slip, rows.slip);
    // The change of slip varies with the place on the cylinder, its own turn and the stretch.
    auto &slip_change = rows.arc;
    slip_change[sum.coordinates.theta()] -= radius;
    slip_change *= facet.stretch;
    slip_change.add(run, rows.stretch);
    add_product(weight * response.tangent[0][0], rows.gap, rows.gap, sum.tangent);
    add_product(weight * response.tangent[1][0], rows.slip, rows.gap, sum.tangent);
    add_product(weight * response.tangent[1][1], rows.slip, slip_change, sum.tangent);
    add_product(-weight * shift.slip * response.d_shift, rows.slip, rows.stretch, sum.tangent);
    add_curvature(of, facet, at, sum.coordinates, radius, weight * normal, weight * along_slip, sum.tangent);
  }

  StaticPatch ElasticSurface::on_ports(const Sum &sum) const
  {
    const auto &coordinates = sum.coordinates;
    StaticPatch result;
    std::vector<unsigned int> of_sum;
    for (unsigned int i = 0; i < coordinates.theta(); ++i)
      if (const unsigned int node = coordinates.nodes[i / 2]; node != FaceEdge<2>::held)
      {
        result.ports.push_back(2 * node + i % 2);
        of_sum.push_back(i);
      }
    for (unsigned int port = ports.rotation(); port < ports.size(); ++port)
    {
      result.ports.push_back(port);
      of_sum.push_back(coordinates.theta() + port - ports.rotation());
    }
    set_on_ports(
        of_sum, coordinates.x(), [&](const unsigned int i) { return sum.values[i]; },
        [&](const unsigned int i, const unsigned int j) { return sum.tangent(i, j); }, result);
    return result;
  }

  std::string ElasticSurface::objection() const
  {
    return beyond_face ? "the contact reaches the end of the cylinder's face" : std::string();
  }
} // namespace sprag
