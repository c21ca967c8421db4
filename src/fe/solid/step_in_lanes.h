#pragma once

#include "fe/contact/face_contact_point.h"
#include "fe/solid/cylinder_in_lanes.h"
#include "fe/solid/friction_in_lanes.h"
#include "fe/solid/patch_travel.h"

#include <optional>

namespace sprag
{
  /// Points of a friction face in a step, eight at once: their forces, see step_response() and SurfaceContact. In time points
  /// that touch neither where it begins nor where it ends take no part, without inertia those that do not where it ends. Blocks
  /// of eight that cannot have come to the cylinder are passed over, see PatchTravel.
  class StepInLanes
  {
  public:
    using Patches = FacePatches<3>;
    using Memory  = std::vector<PointMemory<2>>;

    static constexpr unsigned int n_displacements = 3 * Patches::max_nodes;
    static constexpr unsigned int n_frame         = 4; ///< theta, x and slopes
    static constexpr unsigned int n_coordinates   = n_displacements + n_frame;

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
      double share = 0.;                       ///< of the step until there; 1: `balance` is as the end
      StepContactLaw law;                      ///< balanced at the end: a step without inertia
      double surface_run  = 0.;
      double advance      = 0.; ///< of the drive; in time alone [mm]
      unsigned int slopes = 0;
      std::optional<Slide> slide; ///< then `begin` and `balance` are as the end, and weights those of a step balanced there

      // Without inertia, see StaticTerms.
      bool augmented     = false;
      double speed_ratio = 1.;
    };

    /// The face and its patches must outlive it.
    StepInLanes(const FrictionFace<3> &face, const Patches &patches);
    ~StepInLanes();

    /// Forgets the patches where the last step began. `memory`: of the points in contact there, by increasing point.
    void begin(Memory memory);

    bool begins_with(const Memory &memory) const;

    /// Sets what the following functions refer to.
    void set(const Constants &constants);

    bool is_placed(unsigned int patch) const;

    /// Places a patch where the step begins. `shifts`: of its points, see slip_shift(), with their slip where the slope is 0;
    /// none in time.
    void place(unsigned int patch, const Patches::Nodal &nodal, const std::vector<SlipShift> &shifts = {});

    /// Presses a patch, which is placed, at the displacements where the step ends. Adds its forces and returns whether it takes
    /// part; raises the largest compression of the springs, with multipliers the pressure over their stiffness [mm].
    bool press(unsigned int patch, const Patches::Nodal &to, Forces &forces, double &compression);

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

    /// Adds the works of a patch as it was pressed last; in time alone.
    void add_works(unsigned int patch, Sums &sums) const;

    /// The largest pressure on its points [MPa].
    double largest_pressure(unsigned int patch) const;

    /// Adds its points, all or those of blocks that take part.
    void add_points(unsigned int patch, bool all, std::vector<FacePointState<3>> &points) const;

  private:
    struct Block;
    struct Begin;
    struct End;
    struct Pressed;
    struct TangentSums;

    /// The blocks of a patch, made when it is met first, and the place of its first one in `begins` and `ends`.
    struct Blocks
    {
      std::vector<Block> all;
      unsigned int first = dealii::numbers::invalid_unsigned_int; ///< where it is placed
      PatchTravel travel{ 0., 0. };
      Patches::Nodal begin; ///< where the step begins
    };

    void make_blocks(unsigned int patch);
    Pressed pressed(unsigned int patch, unsigned int block) const;
    void place_block(const Block &block, const Patches::Nodal &nodal, Begin &begin) const;
    void recall(unsigned int patch);
    bool passes_over(const Blocks &of_patch, unsigned int b) const;
    LaneMask rub_in_time(const Begin &begin, const End &end, FrictionInLanes &result) const;
    TrialInLanes trial_at_end(const Begin &begin, const End &end) const;
    void slide_on(const End &end, FrictionInLanes &result) const;
    LaneMask rub(const Begin &begin, const End &end, FrictionInLanes &result) const;
    void rub_alone(const Begin &begin, const End &end, unsigned int lane, FrictionInLanes &result) const;
    void find_friction(const Begin &begin, End &end) const;
    void find_slip(const Begin &begin, const PlacesInLanes &ended, End &end) const;
    void find_shift(const Block &block, const Begin &begin, const PlacesInLanes &ended, const Patches::Nodal &nodal,
                    End &end) const;
    void press_in_time(const PlacesInLanes &ended, Begin &begin, End &end) const;
    void press_at_end(const Block &block, const PlacesInLanes &ended, const Patches::Nodal &nodal, const Begin &begin,
                      End &end) const;
    void add_slope_of_slip(unsigned int patch, Tangent &tangent) const;
    void set_point(const Block &block, const Begin &begin, const End &end, unsigned int lane, const std::array<double, 4> &force,
                   FacePointState<3> &state) const;

    const FrictionFace<3> &face;
    const Patches &patches;
    std::vector<Blocks> blocks; ///< of the patches
    std::vector<unsigned int> placed;
    unsigned int n_placed = 0; ///< blocks of these
    std::vector<Begin> begins; ///< of them, and room for more
    std::vector<End> ends;
    Memory remembered;
    Constants of;
    std::vector<FrictionPiece> law; ///< of its friction, none where each point is looked at by itself
  };
} // namespace sprag
