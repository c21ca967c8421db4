#pragma once

#include "fe/face_compliance.h"

namespace sprag
{
  /// Newton iteration for any material: assembles and factorises at every iterate. Coordinates: displacement of all degrees of
  /// freedom of the body and hub rotation.
  class FullStiffness
  {
  public:
    explicit FullStiffness(const ElasticBody<2> &body);

    unsigned int n_coordinates() const;

    dealii::Vector<double> face_displacement(const dealii::Vector<double> &coordinates) const;

    /// Norm of the unbalanced forces [N].
    double unbalance(const dealii::Vector<double> &coordinates, const FaceContact &contact, const HubSpring &spring);

    /// Correction at the last unbalance(). Throws AnalysisError if the factorisation fails.
    dealii::Vector<double> correction(const FaceContact &contact, const HubSpring &spring);

    dealii::Vector<double> body_displacement(const dealii::Vector<double> &coordinates, const FaceContact &contact) const;

  private:
    /// Coordinate of the i-th of the contact forces.
    unsigned int index_of(const ContactForces &forces, unsigned int i) const;

    const ElasticBody<2> &body;
    Mumps factors;
    dealii::PETScWrappers::SparseMatrix matrix;
    dealii::Vector<double> residual; ///< forces of the contact less those of body and spring
  };
} // namespace sprag
