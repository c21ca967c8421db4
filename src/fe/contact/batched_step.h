// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/cylinder_point.h"
#include "fe/contact/element_travel.h"
#include "fe/contact/face_contact_point.h"
#include "fe/contact/point_block.h"

#include <functional>

namespace sprag
{
  /// Points of a friction face in a step, eight at once: their forces, whose derivatives come from dual numbers. In time points
  /// that touch neither where the step begins nor where it ends take no part, else those that do not where it ends. Blocks of
  /// eight that cannot have come to the cylinder are passed over, see ElementTravel.
  template <int dim>
  class BatchedStep
  {
  public:
    using Elements = FaceElements<dim>;
    using Indices  = typename Elements::Indices;
    using Nodal    = typename Elements::Nodal;
    using History  = std::vector<ContactHistory>;

    static constexpr int slips                    = dim - 1; ///< round the cylinder and, in space, along its axis
    static constexpr unsigned int n_displacements = dim * Elements::max_nodes;
    static constexpr unsigned int n_frame         = 4; ///< theta, x and slopes
    static constexpr unsigned int n_coordinates   = n_displacements + n_frame;

    /// Generalised forces of an element: along each axis those of its nodes, then of theta, x and the slopes.
    using Forces = std::array<double, n_coordinates>;

    /// Kind of the step.
    enum class Kind
    {
      in_time,
      at_end, ///< without inertia: forces are those where it ends
      slide,  ///< steady sliding round the cylinder, which begins as it ends
      touch   ///< at rest without force
    };

    /// Steady sliding.
    struct Slide
    {
      double speed                        = 1.; ///< of the cylinder's surface [mm/s], != 0
      ContactFriction friction            = ContactFriction::sliding;
      const dealii::Vector<double> *rates = nullptr; ///< of the interface, which add to the slip
      double x_rate = 0., theta_rate = 0.;           ///< of the cylinder and of the lever by them
      AxisSlopes slope_rates = {};
    };

    /// The part of the forces of a slide that a tangent is of.
    enum class Part
    {
      all,
      pressure,
      friction,
      friction_rate ///< by the rates of the coordinates
    };

    /// Constants that all points of a step have in common.
    struct Constants : StepTerms
    {
      RigidCylinder::Pose begin, balance, end; ///< `balance`: where forces are balanced
      double share        = 1.;                ///< of the step until there; 1: `balance` is as the end
      Kind kind           = Kind::at_end;
      double advance      = 0.; ///< of the drive; in time alone [mm]
      unsigned int slopes = 0;
      Slide slide         = {};
    };

    /// All of these must outlive it.
    BatchedStep(const Elements &grid, const RigidCylinder &cylinder);
    ~BatchedStep();

    /// Forgets the elements where the last step began. `history`: of the points in contact there, by increasing point.
    void begin(History history);

    bool begins_with(const History &history) const
    {
      return history == begin_history;
    }

    /// Sets what the following functions refer to.
    void set(const Constants &constants);

    bool is_placed(const unsigned int element) const
    {
      return blocks[element].first != dealii::numbers::invalid_unsigned_int;
    }

    /// Places an element where the step begins. `shifts`: of its points, see slip_shift(), with their slip where the slope is 0;
    /// none in time.
    void place(unsigned int element, const Nodal &nodal, const std::vector<SlipShift> &shifts = {});

    /// Presses an element, which is placed, at the displacements where the step ends. Adds its forces and returns whether it
    /// takes part; raises the largest penetration of the springs, with multipliers the pressure over their stiffness [mm].
    bool press(unsigned int element, const Nodal &to, Forces &forces, double &penetration);

    /// Derivatives of these forces by the same coordinates at the end of the step.
    using Tangent = std::array<std::array<double, n_coordinates>, n_coordinates>;

    /// Takes the tangent of an element, by its number among some.
    using TakeTangent = std::function<void(unsigned int, const Tangent &)>;

    /// Calls `take` for elements as they were pressed last.
    void find_tangents(const Indices &elements, Part part, const TakeTangent &take) const;

    /// Adds works of the points of an element in the step, and the energy of their springs at its end, as it was pressed
    /// last. Returns the largest pressure in it [MPa].
    double add_sums(unsigned int element, ContactSums &sums) const;

    /// Adds its points, all or those of blocks that take part.
    void add_points(unsigned int element, bool all, std::vector<FacePointState<dim>> &points) const;

  private:
    struct Block;
    struct Begin;
    template <class N>
    struct End;
    template <int slopes>
    struct TangentSums;

    /// The blocks of an element, made when it is met first, and the place of its first one in `begins`.
    struct Blocks
    {
      std::vector<Block> all;
      unsigned int first = dealii::numbers::invalid_unsigned_int; ///< where it is placed
      ElementTravel<dim> travel{ 0., 0. };
      Nodal begin; ///< where the step begins
    };

    void make_blocks(unsigned int element);
    void place_block(const Block &block, const Nodal &nodal, Begin &begin) const;
    void recall(unsigned int element);
    bool passes_over(const Blocks &group, unsigned int b) const;
    template <bool in_time, class N, class Pose>
    void respond(const Block &block, const Begin &begin, const Pose &pose, const Nodal &nodal, Part part, End<N> &end) const;
    template <class N>
    void slide_on(const Block &block, Part part, End<N> &end) const;
    Several<Batch, slips> slip_rates(const Block &block) const;
    void evaluate(const Block &block, const Begin &begin, const Nodal &nodal, End<Batch> &end) const;
    template <int slopes, bool in_time>
    void find_element_tangents(const Indices &elements, Part part, const TakeTangent &take) const;
    void set_point(const Block &block, const Begin &begin, const End<Batch> &end, unsigned int lane,
                   FacePointState<dim> &state) const;

    const Elements &grid;
    const RigidCylinder &cylinder;
    std::vector<Blocks> blocks; ///< of the elements
    std::vector<unsigned int> placed;
    unsigned int n_placed = 0; ///< blocks of these
    std::vector<Begin> begins; ///< of them, and spare ones
    History begin_history;
    Constants data;
  };
} // namespace sprag
