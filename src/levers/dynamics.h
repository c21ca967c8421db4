#pragma once

#include "base/phase_timer.h"
#include "fe/dynamics/dynamic_face_lever.h"

#include <memory>
#include <string>

namespace sprag
{
  /// A meshed lever at rest, to be shared by models that differ in friction, damping, drive and contact.
  struct MeshedLever
  {
    Mesh triangulation;
    std::unique_ptr<const Body> body;
    FiniteElementBasis elements; ///< of the finite element model
    CondensedBases condensed;    ///< of the condensed one
  };

  /// A scene's model in time at its fidelity.
  struct Dynamics
  {
    std::shared_ptr<const MeshedLever> lever; ///< null where there is no mesh
    MeshedDynamics meshed;                    ///< facts of the mesh; its model is `model`'s owner there
    std::unique_ptr<DynamicModel> reduced;

    DynamicModel &model() const
    {
      return reduced ? *reduced : *meshed.model;
    }
  };

  /// Returns whether one mesh, with its matrices and bases, serves the models of both scenes.
  bool share_mesh(const Scene &a, const Scene &b);

  /// Makes one model after another. What the next scene has in common with the last one's mesh is not made again.
  class DynamicsMaker
  {
  public:
    /// Makes models; with `store_bases` condensed bases go to the cache on disk.
    explicit DynamicsMaker(bool store_bases = true);

    /// Throws InputError for a mesh that cannot be used, AnalysisError if a factorisation fails.
    Dynamics make(const Scene &scene);

    /// Measures the wall and CPU time spent on meshes and models.
    PhaseTimer &timer()
    {
      return time;
    }

  private:
    const bool store;
    std::string last_key;
    std::shared_ptr<const MeshedLever> last;
    PhaseTimer time;
  };
} // namespace sprag
