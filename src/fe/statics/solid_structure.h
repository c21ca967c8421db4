// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/cell_stiffness.h"
#include "fe/statics/layered_compliance.h"
#include "fe/statics/sensor_forces.h"
#include "fe/statics/solid_body.h"
#include "fe/statics/static_interface.h"
#include "model/interface/interface_forces.h"

#include <optional>

namespace sprag
{
  /// A body at finite strain under forces f on its friction face, by the factors of its stiffness K without load: what its
  /// internal forces R differ from K u by are loads,
  ///   u = K^-1 (f + K u - R(u)).
  /// Displacements u are those of all degrees of freedom [mm]. Of the first rank.
  class FiniteStrain
  {
  public:
    /// The body must outlive this.
    explicit FiniteStrain(const SolidBody &body);

    /// Returns by how much a displacement falls short of what its own strain and the forces make of it,
    /// K^-1 (f + K u - R(u)) - u. Throws AnalysisError where an element turned inside out.
    dealii::Vector<double> strain_residual(const dealii::Vector<double> &displacement, const DofLoads &on_face);

    /// Returns the correction by a residual and the change of the forces with it.
    dealii::Vector<double> correction(const dealii::Vector<double> &strain_residual, const DofLoads &change) const;

  private:
    /// A cell with its degrees of freedom and stiffness.
    struct Cell
    {
      dealii::DoFHandler<3>::active_cell_iterator cell;
      std::vector<dealii::types::global_dof_index> dofs;
      const dealii::FullMatrix<double> *stiffness; ///< without load
    };

    void add(const DofLoads &on_face, std::vector<double> &loads) const;

    const SolidBody &body;
    const std::vector<unsigned int> surface; ///< the body's degrees of freedom on the faces
    CellStiffness<3> stiffness;
    CellElasticity<3> elasticity;
    std::vector<Cell> cells;
    dealii::Vector<double> cell_displacement;
  };

  /// Forces on the face of a lever, and the displacements of their dofs.
  using FaceSample = std::pair<DofLoads, dealii::Vector<double>>;

  /// One or both levers of a pair in three dimensions in statics, seen through candidate dofs of their faces. At finite
  /// strain the displacements of the whole body of each lever follow those of the interface among the coordinates. To be made and
  /// used by the first rank.
  class SolidStructure : public StaticInterface
  {
  public:
    /// The body must outlive this. `begin` and `end`: where on the face forces may act [mm].
    SolidStructure(const SolidBody &body, double begin, double end, const InterfaceLayout &layout, const JointSprings &springs);

    unsigned int n_coordinates() const
    {
      return finite ? first_body_coordinate(layout.levers) : StaticInterface::n_coordinates();
    }

    /// See StaticInterface; at finite strain sets the interface to where the bodies are.
    void set_faces(const DofLoads &forces, const DofSelection &near, dealii::Vector<double> &coordinates);

    Residual residual(const dealii::Vector<double> &coordinates, const InterfaceForces &forces, const DofSelection &near);
    dealii::Vector<double> correction(const Residual &residual, const InterfaceForces &forces, const DofSelection &near);

    /// Returns the displacements in each of some states; of a linear body by one back-substitution with the whole.
    std::vector<BodyDisplacements> body_displacements(const std::vector<StaticState> &states) const;

    /// Returns the forces of the sensors of a lever, see SensorForces [N].
    std::vector<double> sensor_forces(unsigned int lever, const dealii::Vector<double> &coordinates,
                                      const DofLoads &forces) const;

    /// Returns the sum of a lever's displacements by shares, in a state of it.
    double displacement(unsigned int lever, const DofLoads &shares, const dealii::Vector<double> &coordinates,
                        const DofLoads &forces) const;

    bool is_linear() const
    {
      return !finite;
    }

    const LayeredCompliance &face_compliance() const
    {
      return *compliance;
    }

    /// Returns a state's forces on the face of each lever and the displacements where they act.
    std::vector<FaceSample> samples(const dealii::Vector<double> &coordinates, const DofLoads &forces) const;

    /// The error of the compliance of the face of a linear body against a solve with the whole body, the worst of some
    /// states.
    struct Exactness
    {
      double displacement; ///< largest difference over the largest displacement [-]
      double work;         ///< of the forces on the differences over that on the displacements [-]
    };
    Exactness exactness(const std::vector<FaceSample> &samples) const;

  private:
    SolidStructure(const SolidBody &body, std::shared_ptr<LayeredCompliance> compliance, const InterfaceLayout &layout,
                   const JointSprings &springs);

    /// Index among the coordinates, at finite strain, of the first displacement of a lever's body.
    unsigned int first_body_coordinate(const unsigned int lever) const
    {
      return StaticInterface::n_coordinates() + lever * body.n_dofs();
    }

    dealii::Vector<double> lever_displacement(const dealii::Vector<double> &coordinates, unsigned int lever) const;

    const SolidBody &body;
    const std::vector<unsigned int> surface;             ///< the body's degrees of freedom on a lever's faces
    const std::shared_ptr<LayeredCompliance> compliance; ///< of a face; keeps the columns found
    const SensorForces sensors;
    mutable std::optional<FiniteStrain> finite; ///< of a body that is not linear
  };
} // namespace sprag
