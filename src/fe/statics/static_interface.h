// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"
#include "fe/algebra/mumps.h"
#include "fe/body/elastic_body.h"
#include "model/interface/block_product.h"
#include "model/interface/interface_forces.h"
#include "model/interface/interface_layout.h"

#include <array>
#include <memory>

namespace sprag
{
  /// Linear springs at hub, support and the cylinder's slopes of a lever without inertia.
  struct JointSprings
  {
    double rotation = 0.;           ///< k [N mm/rad], > 0
    double support  = 0.;           ///< k_f a lever [N/mm], > 0; counts on a sprung support
    double arm      = 0.;           ///< length that turns a rotation into a movement [mm], > 0
    std::array<double, 2> slopes{}; ///< compliances of the cylinder's shaft [rad/(N mm)], >= 0; count where its axis is free
    double slope_arm = 0.;          ///< length that turns its slopes into movements [mm], > 0
  };

  /// Residual of the coordinates.
  struct Residual
  {
    dealii::Vector<double> values;
    double norm;                                                             ///< as a displacement or a force, hubs by their arm
    std::shared_ptr<const dealii::PETScWrappers::SparseMatrix> tangent = {}; ///< of structures that are factorised anew
  };

  /// Compliance between the displacements of a face's nodes, the body held at its hub [mm/N]. A contact meets few of them at a
  /// time: it is found in blocks of dofs that follow each other, where it is asked for, and kept. Dofs are numbers on the face.
  class FaceCompliance
  {
  public:
    virtual ~FaceCompliance() = default;

    unsigned int n_dofs() const
    {
      return ranges.empty() ? 0 : ranges.back().end;
    }

    /// Returns all dofs of the blocks that hold the selected dofs, increasing.
    DofSelection whole_blocks(const DofSelection &selected) const;

    /// Returns the compliance between dofs that make up whole blocks.
    dealii::FullMatrix<double> among(const DofSelection &whole_blocks);

    /// Serialises which blocks are known, where later ones depend on that.
    virtual void serialise_history(Archive &)
    {
    }

  protected:
    using BlockPair = std::pair<unsigned int, unsigned int>; ///< of rows and columns, first >= second

    /// Finds blocks, of which some are known, together.
    virtual void find_blocks(const std::vector<BlockPair> &)
    {
    }

    virtual dealii::FullMatrix<double> block(const BlockPair &rows_and_columns) = 0;

    /// Returns the number of the block that holds a dof.
    unsigned int containing_block(unsigned int dof) const;

    std::vector<NumberRange> ranges; ///< of the blocks' dofs
  };

  /// A state of levers without inertia, which it refers to.
  struct StaticState
  {
    const dealii::Vector<double> &coordinates;
    const DofLoads &forces; ///< on the interface
  };

  /// Displacement of all degrees of freedom of each lever's body in its axes [mm].
  using BodyDisplacements = std::vector<dealii::Vector<double>>;

  /// Returns what `displacement`(lever, coordinates) finds in each of some states.
  template <class Displacement>
  std::vector<BodyDisplacements> find_displacements(const std::vector<StaticState> &states, const unsigned int levers,
                                                    const Displacement &displacement)
  {
    std::vector<BodyDisplacements> result(states.size());
    for (std::size_t i = 0; i < states.size(); ++i)
      for (unsigned int lever = 0; lever < levers; ++lever)
        result[i].push_back(displacement(lever, states[i].coordinates));
    return result;
  }

  /// Returns forces on a lever's surface as columns of loads on its body.
  template <int dim>
  SparseColumns body_loads(const ElasticBody<dim> &body, const std::vector<DofLoads> &on_levers)
  {
    const auto surface = surface_dofs(body);
    SparseColumns result;
    for (const auto &acting : on_levers)
    {
      for (unsigned int i = 0; i < acting.dofs.size(); ++i)
        if (const unsigned int dof = surface[acting.dofs[i]]; !body.is_held(dof))
          result.add(dof, acting.values[i]);
      result.end_column();
    }
    return result;
  }

  /// Interface of linear levers on linear springs in statics, z = G f(z). The compliance G is dense on the faces of a lever and
  /// diagonal on hubs and support, which do not move a body in its own axes, and on the cylinder's slopes. It is known for
  /// candidate dofs in whole blocks, which change if others are looked at. Only dofs with forces carry tangents, so that a Newton
  /// correction is a dense solve of those, and the iterates are those of the full system. Coordinates: displacements of all dofs.
  /// `near` are the dofs that are looked at, which increase and hold those of the forces, of hubs and of the support.
  class StaticInterface
  {
  public:
    static constexpr bool has_candidates = true;

    /// `faces`: those of a lever in the order of their dofs, the same for both of a pair.
    StaticInterface(const InterfaceLayout &layout, const JointSprings &springs,
                    std::vector<std::shared_ptr<FaceCompliance>> faces);
    StaticInterface &operator=(StaticInterface &&) = delete;

    unsigned int n_coordinates() const
    {
      return layout.size();
    }

    /// Returns the index of the coordinate of a dof.
    unsigned int coordinate(const unsigned int dof) const
    {
      return dof;
    }

    const dealii::Vector<double> &interface_displacements(const dealii::Vector<double> &coordinates) const
    {
      return coordinates;
    }

    /// Sets the displacements of those dofs of the faces that are looked at to G f.
    void set_faces(const DofLoads &forces, const DofSelection &near, dealii::Vector<double> &coordinates);

    /// Returns G f - z. `face_displacements`: displacements of the whole faces in place of G f, of a body that is not linear.
    Residual residual(const dealii::Vector<double> &coordinates, const InterfaceForces &forces, const DofSelection &near,
                      const dealii::Vector<double> *face_displacements = nullptr);

    /// Returns the correction, 0 on dofs that are not looked at. Throws AnalysisError if the tangent is singular.
    dealii::Vector<double> correction(const Residual &residual, const InterfaceForces &forces, const DofSelection &near);

    /// Serialises the candidate dofs and what is known of the faces.
    void serialise_history(Archive &archive);

  protected:
    /// Returns the forces on the surface of a lever, with its dofs numbered as of one lever alone.
    DofLoads on_surface(const DofLoads &forces, unsigned int lever) const;

    /// Returns those of each lever in each of some states, state by state.
    std::vector<DofLoads> on_levers(const std::vector<StaticState> &states) const;

    /// Returns columns of `n` displacements, in the order of on_levers(), as those of the states.
    std::vector<BodyDisplacements> by_states(const std::vector<double> &columns, unsigned int n) const;

    const InterfaceLayout layout;

  private:
    void set_candidates(const DofSelection &selected);
    DofSelection look_at(const DofSelection &near);

    const JointSprings springs;
    const std::vector<std::shared_ptr<FaceCompliance>> faces;

    DofSelection candidates;        ///< dofs of known compliance, a place for each
    DofSelection requested;         ///< dofs for which they were chosen
    InterfaceCompliance compliance; ///< of the places
  };
} // namespace sprag
