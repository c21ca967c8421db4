// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/face_contact_point.h"
#include "fe/contact/face_pair_rows.h"

#include <map>

namespace sprag
{
  /// An elastic cylinder below the lever's face, with the member functions of RigidCounterface. The points of the friction face
  /// are facets, see FacePair: pressure and traction are those of the facet's mean gap and slip. The dofs of the cylinder's nodes
  /// follow those of the lever's. Elements and points are indices in `face`.
  class ElasticCounterface
  {
  public:
    /// All must outlive the counterface; `face` are the lever's elements.
    ElasticCounterface(const FrictionFace<2> &lever, const FrictionFace<2> &cylinder, const FaceElements<2> &face,
                       const FaceProperties<2> &properties);

    void set_places(const StepPlaces &places, bool begins_anew);
    FaceElements<2>::Indices near_end() const
    {
      return near(end.at);
    }
    FaceElements<2>::Indices near_begin() const
    {
      return near(begin_side.at);
    }
    void begin_element(unsigned int element);
    bool place(FacePointState<2> &state) const;

    double gap_at_begin(const unsigned int point)
    {
      return places.moves() ? facets_at_begin(element).facets[point - first].gap : facet_at_end(point).gap;
    }

    void step(FacePointState<2> &state, const ContactHistory &history, const FaceStep &step, ContactSums &sums);
    void slide(FacePointState<2> &state, const SlidingState &sliding, const FrictionLaw &law, ContactSums &sums);
    void end_element(ContactSums &sums);
    FacePointRows rows(const FacePointState<2> &state);
    double slip(const FacePointState<2> &state);

  private:
    /// The facets of an element at one end of the step.
    struct Side
    {
      PairConfiguration at;
      ElementFacets element_facets;
      double first_slip = 0.; ///< slip coordinate of the cylinder's first node without load [mm]
    };

    double first_slip(const FaceConfiguration &at) const;
    FaceElements<2>::Indices near(const PairConfiguration &at) const;
    const ElementFacets &facets_at_begin(unsigned int element_index);
    double slip_at_begin(unsigned int point);

    double slip_at_end(const unsigned int point) const
    {
      return slip_coordinate(facet_at_end(point), places.end, end.first_slip, point);
    }

    double slip_coordinate(const Facet &facet, const FaceConfiguration &at, double slip_offset, unsigned int point) const;
    std::array<unsigned int, 2> neighbours(unsigned int point) const;
    double distance(unsigned int from, unsigned int to) const;
    double slope(unsigned int point) const;
    void prepare_sums();

    const Facet &facet_at_end(const unsigned int point) const
    {
      return end.element_facets.facets[point - first];
    }

    void add_tangent(const StepResponse<2> &response, const Facet &facet, double stretch, double run, double end_stretch);
    void add_shift(const Facet &facet, unsigned int point, const SlipShift &shift, double d_shift);
    dealii::Tensor<1, 4> on_lever(double normal, double along_slip, const FacetRows &rows) const;
    InterfaceCoordinates interface_coordinates() const;
    FacePointRows rows_on_dofs(const Facet &facet) const;
    dealii::Vector<double> change(const dealii::Vector<double> &from, const dealii::Vector<double> &to) const;

    const FaceElements<2> &face;
    const FaceProperties<2> &properties;
    const FacePair pair;
    const dealii::Point<2> first_node; ///< of the cylinder's face, about its centre
    StepPlaces places{};
    Side end;

    // State at the balance, if the forces of a step are those between its ends.
    Side balance_side;
    dealii::Vector<double> between; ///< displacements at the balance

    // State at the begin of the step, the same in all its iterations.
    Side begin_side;
    std::map<unsigned int, ElementFacets> begin_facets; ///< by elements

    // State of the present element.
    unsigned int element = 0;
    unsigned int first   = 0;       ///< of its points
    FaceElements<2>::Nodal nodal{}; ///< its displacements at the end
    bool has_forces  = false;
    bool at_face_end = false;
    PairCoordinates coordinates;
    FacetRows end_rows, balance_rows, at_left, at_right;
    dealii::Vector<double> force_row; ///< derivative of a force
    dealii::Vector<double> movement;  ///< in the step
    dealii::Vector<double> values;
    dealii::FullMatrix<double> tangent;
    FrictionParts<dealii::FullMatrix<double>> friction;
  };
} // namespace sprag
