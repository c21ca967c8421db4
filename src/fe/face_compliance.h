#pragma once

#include "fe/face_contact.h"
#include "fe/mumps.h"

namespace sprag
{
  /// The rotational spring at the hub.
  struct HubSpring
  {
    double stiffness; ///< k [N mm/rad], > 0
    double rest;      ///< inclination without moment [rad]
    double arm;       ///< length that turns a rotation into a movement [mm], > 0
  };

  /// Newton iteration for a linear body, factorised once. Coordinates: displacement of the face nodes (two entries a node) and
  /// hub rotation. With C the compliance of the face and f(u, theta) the contact forces, equilibrium is
  ///   u = C f,   k (theta - theta_0) = m.
  /// Only nodes under pressure carry stiffness, so a correction is a dense solve of those, and the iterates are those of the
  /// full system.
  class FaceCompliance
  {
  public:
    explicit FaceCompliance(const ElasticBody<2> &body);

    unsigned int n_coordinates() const;

    dealii::Vector<double> face_displacement(const dealii::Vector<double> &coordinates) const;

    /// Norm of the unbalance, as a displacement [mm].
    double unbalance(const dealii::Vector<double> &coordinates, const FaceContact &contact, const HubSpring &spring);

    /// Correction at the last unbalance().
    dealii::Vector<double> correction(const FaceContact &contact, const HubSpring &spring) const;

    /// Displacement of the whole body under the contact's forces, by one back-substitution.
    dealii::Vector<double> body_displacement(const dealii::Vector<double> &coordinates, const FaceContact &contact) const;

  private:
    /// Adds C `loads` (two a node) to `displacement`.
    void add_response(const std::vector<unsigned int> &nodes, const dealii::Vector<double> &loads,
                      dealii::Vector<double> &displacement) const;

    const ElasticBody<2> &body;
    Mumps factors;
    dealii::FullMatrix<double> compliance;
    dealii::Vector<double> mismatch; ///< C f - u, then (m - k (theta - theta_0)) / k
  };
} // namespace sprag
