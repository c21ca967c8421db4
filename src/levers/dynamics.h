// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/phase_timer.h"
#include "fe/dynamics/dynamic_face_lever.h"
#include "fe/dynamics/solid_dynamics.h"

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace sprag
{
  struct Scene;

  /// A meshed lever at rest, to be shared by models that differ in friction, damping, drive and contact.
  struct MeshedLever
  {
    Mesh triangulation;
    std::unique_ptr<const Body> body;
    FiniteElementBasis elements; ///< of the finite element model
    CondensedBases condensed;    ///< of the condensed one
    double cpu_seconds = 0.;     ///< that all this took
  };

  /// A scene's model in time at its fidelity.
  struct Dynamics
  {
    std::shared_ptr<const MeshedLever> lever; ///< null where there is no mesh in a plane
    std::shared_ptr<const SolidInTime> solid; ///< null where there is none in three dimensions
    MeshedDynamics meshed;                    ///< facts of the mesh, and the model that model() returns where there is a mesh
    std::unique_ptr<DynamicModel> reduced;

    DynamicModel &model() const
    {
      return reduced ? *reduced : *meshed.model;
    }

    ModeShape mode_shape(const Eigenmode &mode) const
    {
      auto result = model().mode_shape(mode);
      if (meshed.follow_edge)
        meshed.follow_edge(mode, result);
      return result;
    }
  };

  /// Returns whether one mesh, with its matrices and bases, serves the models of both scenes.
  bool share_mesh(const Scene &a, const Scene &b);

  /// Makes one model after another. What the next scene has in common with the last ones' meshes is not made again.
  class DynamicsMaker
  {
  public:
    /// Makes models; with `store_bases` condensed bases go to the cache on disk. The last `kept_meshes` meshed levers are kept.
    explicit DynamicsMaker(bool store_bases = true, std::size_t kept_meshes = 1);

    /// Throws InputError for a mesh that cannot be used, AnalysisError if a factorisation fails. Of a condensed
    /// scene's basis `fewer_modes` >= 1 keeps only so many of the lowest modes; the others act statically.
    Dynamics make(const Scene &scene, const std::optional<unsigned int> &fewer_modes = {});

    /// Measures the wall and CPU time spent on meshes and models.
    PhaseTimer &timer()
    {
      return time;
    }

    /// Returns the CPU time saved by using plane meshes and their bases again [s]. In three dimensions it is not counted.
    double seconds_saved() const
    {
      return saved;
    }

  private:
    const bool store;
    const std::size_t kept;
    // Meshed levers by their body_key(), the last one used first.
    std::deque<std::pair<std::string, std::shared_ptr<const MeshedLever>>> levers;
    std::pair<std::string, std::shared_ptr<const SolidInTime>> solid;
    double saved = 0.;
    PhaseTimer time;

    std::shared_ptr<const MeshedLever> find_meshed_lever(const Scene &scene);
    std::shared_ptr<const MeshedLever> make_lever(const Scene &scene, const std::string &key);
    Dynamics make_solid(const Scene &scene, unsigned int n_modes);
  };
} // namespace sprag
