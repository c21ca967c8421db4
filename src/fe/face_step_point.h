#pragma once

#include "fe/face_contact.h"
#include "fe/face_patches.h"
#include "model/contact_step.h"
#include "model/linearisation.h"
#include "model/port_layout.h"

namespace sprag
{
  /// Constants of the contact of a meshed lever in time.
  struct FaceStepProperties
  {
    Geometry geometry;
    PortLayout ports;
    double rest_inclination = 0.; ///< theta without moment [rad]
    ContactPenalties penalties{};
    FrictionLaw friction;
    double layer_thickness = 0.; ///< [mm]
  };

  /// What the last evaluation found at a point of the friction face.
  struct FacePointState
  {
    unsigned int index = 0;
    unsigned int patch = 0;
    LeverPoint position{}; ///< deformed
    double gap         = 0.;
    double slip_change = 0.;
    double pressure    = 0.; ///< at the end
    double traction    = 0.;
    double mu          = 0.;
    bool slipping      = false;
    dealii::Tensor<1, 4> end_force; ///< on the lever per area: along xi, along eta, about the pivot, and along x on the drive
    ContactMemory memory;
  };

  /// Forces and their tangent on some ports.
  struct FacePatchForces
  {
    std::vector<unsigned int> ports; ///< in any order
    dealii::Vector<double> values;
    dealii::FullMatrix<double> tangent;
  };

  /// A coordinate of a patch that is a port.
  struct FaceCoordinate
  {
    unsigned int index;
    unsigned int port;
    double sign; ///< of the coordinate along the port
  };

  /// From values and tangent over the coordinates of a patch.
  template <class Values, class Tangent>
  FacePatchForces forces_on_ports(const std::vector<FaceCoordinate> &coordinates, const Values &values, const Tangent &tangent)
  {
    const auto n = static_cast<unsigned int>(coordinates.size());
    FacePatchForces result{ {}, dealii::Vector<double>(n), dealii::FullMatrix<double>(n, n) };
    for (unsigned int i = 0; i < n; ++i)
    {
      const auto &row = coordinates[i];
      result.ports.push_back(row.port);
      result.values[i] = row.sign * values(row.index);
      for (unsigned int j = 0; j < n; ++j)
        result.tangent(i, j) = row.sign * coordinates[j].sign * tangent(row.index, coordinates[j].index);
    }
    return result;
  }

  /// Derivatives of a point's gap and slip, and of its slip speed at ports at rest over the cylinder's, by some ports.
  struct FacePointRows
  {
    double weight; ///< area [mm^2]
    std::vector<unsigned int> ports;
    dealii::Vector<double> gap;
    dealii::Vector<double> slip;
    dealii::Vector<double> stretch;
  };

  /// Sums over the points of an evaluation.
  struct FaceStepSums
  {
    double compression     = 0.;    ///< largest [mm]
    double stored          = 0.;    ///< energy
    double force_on_circle = 0.;    ///< generalised, of the position x, in the step [N]
    bool beyond_face       = false; ///< whether the contact reaches the end of what can be touched
    StepWork work;
    std::vector<FacePatchForces> loaded;
  };

  /// Where a step begins and ends, and at which share of it forces are balanced.
  struct FaceStepPlaces
  {
    FaceConfiguration begin;
    FaceConfiguration end;
    double balance = 1.;

    /// Whether beginning and end differ.
    bool moves() const
    {
      return begin.displacement != end.displacement || begin.x != end.x;
    }

    double balanced(const double at_begin, const double at_end) const
    {
      return (1. - balance) * at_begin + balance * at_end;
    }
  };

  /// What a point's response to a step is in state and sums, its forces apart.
  template <int n>
  void record(const StepResponse<n> &response, const double slip_change, const double weight, const double run,
              FacePointState &state, FaceStepSums &sums)
  {
    state.slip_change  = slip_change;
    state.pressure     = response.pressure;
    state.traction     = response.traction;
    state.mu           = response.mu;
    state.slipping     = response.slipping;
    state.memory       = response.memory;
    state.memory.point = state.index;

    sums.stored += weight * response.energy;
    sums.work.drive += weight * response.mean_traction * run;
    sums.work.friction += weight * response.friction;
    sums.work.algorithmic += weight * response.algorithmic;
    sums.work.creep = std::max(sums.work.creep, response.creep);
  }

  /// Derivative of the forces per area p G - t S of steady sliding, G and S the rows of gap and slip:
  ///   normal G G + coupled S G + tangential S S + gap_curvature dG/dq + slip_gradient dS/dq + by_speed S dv/dq,
  /// v what the slip speed is at ports at rest.
  struct SlidingTangent
  {
    double normal        = 0.;
    double coupled       = 0.;
    double tangential    = 0.;
    double gap_curvature = 0.;
    double slip_gradient = 0.;
    double by_speed      = 0.;
  };

  /// Sets tractions from the state's gap < 0 and slip and adds them to the sums; returns the part of the tangent asked for.
  SlidingTangent slide(const FaceStepProperties &properties, const FrictionLaw &law, const SlidingState &sliding, double weight,
                       FacePointState &state, FaceStepSums &sums);
} // namespace sprag
