#pragma once

#include "fe/contact/face_contact_point.h"
#include "fe/solid/cylinder_in_lanes.h"

#include <optional>

namespace sprag
{
  /// Points of a friction face in a step in time, eight at once: their forces, see mean_response() and SurfaceContact. Points
  /// that touch neither at its beginning nor at its end take no part.
  class StepInLanes
  {
  public:
    using Patches = FacePatches<3>;
    using Memory  = std::vector<PointMemory<2>>;

    static constexpr unsigned int n_displacements = 3 * Patches::max_nodes;
    static constexpr unsigned int n_coordinates   = n_displacements + 4; ///< theta, x and slopes follow

    /// Generalised forces of a patch: along each axis those of its nodes, then of theta, x and the slopes.
    using Forces = std::array<double, n_coordinates>;

    /// Steady sliding round the cylinder in place of a step in time.
    struct Slide
    {
      double speed;       ///< [mm/s], != 0
      double coefficient; ///< of friction, signed as the speed
      double mu;
      bool rubs;
      double compliance; ///< of the springs of stick that keep energy [mm3/N]
    };

    /// What all points of a step have in common.
    struct Constants
    {
      RigidCylinder::Shape cylinder{};
      RigidCylinder::Pose begin, balance, end; ///< `balance`: where forces are balanced
      double share = 0.;                       ///< of the step until there
      StepContactLaw law;
      double surface_run  = 0.;
      double advance      = 0.; ///< of the drive [mm]
      unsigned int slopes = 0;
      std::optional<Slide> slide; ///< then `begin` and `balance` are as the end, and weights those of a step balanced there
    };

    /// `patches` must outlive it.
    explicit StepInLanes(const Patches &patches);
    ~StepInLanes();

    /// Forgets the points where the last step began. `memory`: of the points in contact there, by increasing point.
    void begin(Memory memory);

    bool begins_with(const Memory &memory) const;

    /// Sets what the following functions refer to.
    void set(const Constants &constants);

    /// Presses a patch from the displacements where the step begins to those where it ends. Adds its forces and returns whether
    /// it takes part; raises the largest compression of the springs [mm].
    bool press(unsigned int patch, const Patches::Nodal &from, const Patches::Nodal &to, Forces &forces, double &compression);

    /// Derivatives of these forces by the same coordinates at the end of the step.
    using Tangent = std::array<std::array<double, n_coordinates>, n_coordinates>;

    /// Returns them of a patch as it was pressed last.
    Tangent tangent(unsigned int patch) const;

    /// Works of the points of a patch in the step, and the energy of their springs at its end [N mm].
    struct Sums
    {
      double stored = 0.;
      double drive = 0., friction = 0., algorithmic = 0.;
      double creep = 0.; ///< the largest [mm]
    };

    /// Adds the works and the points of a patch as it was pressed last.
    void complete(unsigned int patch, Sums &sums, std::vector<FacePointState<3>> &points);

  private:
    struct Block;
    struct Begin;
    struct End;
    struct Friction;
    struct TangentSums;

    /// Ranges of blocks that belong to a patch.
    struct Range
    {
      unsigned int begin, end;
      bool is_placed; ///< where the step begins
    };

    void place(unsigned int patch, const Patches::Nodal &nodal);
    void recall(unsigned int patch);
    void find_friction(const Begin &begin, const End &end, unsigned int lane, Friction &result) const;
    void return_to_cone(const Begin &begin, const End &end, Friction &result) const;
    void slide_on(Begin &begin, End &end) const;
    void rub(const Begin &begin, const PlacesInLanes &ended, bool in_lanes, End &end) const;
    void add_point(unsigned int patch, unsigned int block, unsigned int lane, const std::array<double, 4> &force,
                   std::vector<FacePointState<3>> &points) const;

    const Patches &patches;
    std::vector<Range> ranges; ///< of the patches
    std::vector<Block> blocks;
    std::vector<Begin> begins; ///< of the blocks
    std::vector<End> ends;
    Memory remembered;
    Constants of;
  };
} // namespace sprag
