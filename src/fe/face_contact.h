#pragma once

#include "fe/elastic_body.h"
#include "model/circle.h"
#include "model/model.h"

#include <functional>

namespace sprag
{
  /// What the lever rubs against: kinematics of a point of the lever at drive position x and hub rotation theta, in the
  /// coordinates (displacement along xi, along eta, theta).
  using Obstacle = std::function<ContactKinematics<3>(const LeverPoint &point, double x, double theta)>;

  /// Resultant of the contact on the lever in lever axes.
  struct ContactResultant
  {
    double along;  ///< force along xi [N]
    double across; ///< force along eta [N]
    double moment; ///< work-conjugate to theta [N mm]
  };

  /// [N/mm^3], > 0
  struct ContactPenalties
  {
    double normal;
    double tangential;
  };

  /// Contact along the friction face, at its nodes: there a multiplier each can be met exactly. Weights are the nodes' shares of
  /// the face's area, which integrates a pressure of the elements' degree exactly.
  class FaceContact
  {
  public:
    FaceContact(std::vector<FaceNode<2>> nodes, Obstacle obstacle, FrictionLaw friction, Enforcement enforcement,
                ContactPenalties penalties);

    /// Tractions at the displacement (two entries a node) and rotation, in a step that began at `accepted`.
    void evaluate(const dealii::Vector<double> &displacement, double theta, const State &trial, const State &accepted,
                  FrictionMode mode);

    const std::vector<FaceNode<2>> &nodes() const;

    /// Nodes under pressure at the last evaluation, increasing, and their responses in the same order.
    const std::vector<unsigned int> &active() const;
    const std::vector<ContactResponse<3>> &responses() const;

    ContactResultant resultant() const;

    /// Largest overlap [mm] and largest p / penalty [mm].
    double penetration() const;
    double overlap() const;

    void augment(std::vector<ContactMemory> &memory) const;

    std::vector<ContactMemory> memory() const;

    /// Columns that follow from tractions and positions; `layer_thickness` [mm] tells what counts as indentation.
    void observe(double layer_thickness, Row &row) const;

    const ContactPenalties &penalties() const;

    FacePoints points() const;

    FaceState state(const DrivePoint &drive) const;

  private:
    double trial_pressure(unsigned int node) const;
    double contact_width() const;
    double indentation(double centre, double half_width, double layer_thickness) const;
    double cone_violation() const;
    double elastic_slip() const;

    const std::vector<FaceNode<2>> face;
    const Obstacle obstacle;
    const FrictionLaw friction;
    const Enforcement enforcement;
    const ContactPenalties stiffness;

    // Of the last evaluation.
    dealii::Vector<double> displacement;
    std::vector<ContactMemory> start; ///< memory and multipliers it used
    std::vector<double> gap;
    std::vector<double> slip;
    std::vector<unsigned int> active_nodes;
    std::vector<ContactResponse<3>> active_responses;
    double duration = 0.;
  };
} // namespace sprag
