#pragma once

#include "laws/friction.h"
#include "scene/apparatus.h"
#include "scene/design.h"
#include "scene/drive.h"
#include "scene/identification.h"
#include "scene/isolation.h"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace sprag
{
  // A scene is plain data: what there is and what is done to it, at no particular fidelity.
  // Units: mm, N, s, tonne, rad (so MPa and mJ). All forces and stiffnesses are per lever over its whole width.

  enum class AnalysisType
  {
    quasi_static,
    slope,
    transient,
    contact_law,    ///< indentation by finite elements, from which the contact law of the reduced models is fitted
    modal,          ///< undamped modes of the lever at one x, out of contact or in it
    stability,      ///< eigenvalues of the steady slide, what feeds them, and where it loses stability or jams
    map,            ///< the same over a grid of two parameters
    sprag_slip,     ///< the steady slide perturbed, in time, against its eigenvalue; limit cycles
    calibration,    ///< leaf thickness and added mass for a given k and J; constants of the reduced models for a mesh
    isolation,      ///< a table on a spring and a damper over a base that moves
    identification, ///< friction, spring and geometry from a measured stroke
    design,         ///< the lever that meets demands, and the best of them by an aim
    study           ///< any of these but map and design, run after run at other values of the parameters
  };

  enum class ModelType
  {
    closed_form,
    rigid,     ///< rotation of a rigid lever
    beam,      ///< Hermite beam elements
    condensed, ///< vibration modes and static face shapes of the finite elements
    finite_element
  };

  inline bool is_meshed(const ModelType model)
  {
    return model == ModelType::condensed || model == ModelType::finite_element;
  }

  /// Returns whether the model has a few coordinates and no mesh, so that it is judged in no time.
  inline bool is_reduced(const ModelType model)
  {
    return model == ModelType::rigid || model == ModelType::beam;
  }

  enum class PlaneState
  {
    stress,
    strain
  };

  enum class Solution
  {
    automatic, ///< factorise once where the material is linear
    general    ///< assemble and factorise in every Newton iteration
  };

  /// What a run does with the warnings that it has.
  enum class WarningTreatment
  {
    report, ///< print and store them
    error   ///< and fail
  };

  struct AnalysisSettings
  {
    AnalysisType type         = AnalysisType::quasi_static;
    ModelType model           = ModelType::finite_element;
    unsigned int dimension    = 2;
    PlaneState plane          = PlaneState::stress;
    Solution solution         = Solution::automatic;
    double step               = 1.;   ///< largest change of x in a step [mm], > 0
    double minimum_step       = 1e-6; ///< smallest change of x tried before the analysis gives up [mm], > 0
    double maximum_deviation  = 0.;   ///< largest admissible deviation from the closed form [-]; 0: any
    double maximum_residual   = 1e-3; ///< largest admissible energy residual over the largest work done [-]; 0: any
    WarningTreatment warnings = WarningTreatment::report;
  };

  /// Figure 1 of the paper; the lever lies on the far side of the cylinder seen from the x-axis.
  struct Geometry
  {
    double cylinder_radius  = 56.;   ///< R [mm], > 0
    double interface_offset = 45.6;  ///< e [mm], 0 <= e < R: pivot to friction interface
    double pivot_distance   = 185.5; ///< l [mm], > R: origin to pivot along x
    double pivot_height     = 0.;    ///< h [mm], pivot above the x-axis
  };

  enum class MaterialModel
  {
    linear,
    neo_hookean,
    st_venant_kirchhoff ///< of leaf springs
  };

  enum class InertiaSource
  {
    scaled,  ///< densities scaled so that the moment of inertia is met
    as_built ///< densities as they are; the moment of inertia follows
  };

  struct Lever
  {
    LeverOutline outline     = LeverOutline::bar;
    double length            = 210.;
    double depth             = 20.; ///< metal only [mm]
    double width             = 40.;
    double young_modulus     = 70000.;
    double poisson_ratio     = 0.33;
    double density           = 2.7e-9;                ///< [t/mm^3]
    MaterialModel material   = MaterialModel::linear; ///< of lever and friction layer
    double moment_of_inertia = 6.45;                  ///< J about the pivot, arm and tip mass included [t mm^2]
    InertiaSource inertia    = InertiaSource::scaled;
    double hub_inertia       = 0.;             ///< of what turns with the rigid hub, about the pivot [t mm^2], >= 0
    double tip_mass          = 0.;             ///< at the neutral axis [t]
    std::optional<double> neutral_axis_offset; ///< e_a [mm], from the pivot; none: e + layer + depth/2
    double modal_damping     = 0.01;           ///< of critical, on each bending mode of the free lever
    double mass_damping      = 0.;             ///< Rayleigh: C = this M + ... [1/s]
    double stiffness_damping = 0.;             ///< Rayleigh: ... + this K, the rotational spring left out [s]
  };

  struct FrictionLayer
  {
    double thickness     = 1.; ///< [mm], >= 0; 0: no layer
    double young_modulus = 20.;
    double poisson_ratio = 0.;
    double density       = 2e-10;   ///< [t/mm^3], scaled together with the lever's
    std::optional<double> strength; ///< pressure at which its cells give way [MPa]; none: 0.04 times its Young's modulus
  };

  enum class ContactType
  {
    compliant,
    ideal ///< rigid lever always in contact, theta from the drive
  };

  enum class Enforcement
  {
    penalty,
    augmented_lagrangian
  };

  struct ContactSettings
  {
    Enforcement enforcement = Enforcement::penalty;
    std::optional<double> penalty;             ///< [N/mm^3], > 0; none: chosen from mesh and layer
    std::optional<double> tangential_penalty;  ///< [N/mm^3], > 0; none: equal to the normal one
    double penetration_tolerance       = 1e-6; ///< augmented Lagrangian: largest overlap left [mm], > 0
    unsigned int maximum_augmentations = 20;

    // Contact of the reduced models (rigid, beam): P = k delta^n + c delta'.
    ContactType type = ContactType::compliant;
    double stiffness = 2000.;                   ///< k [N/mm^n], > 0
    double exponent  = 1.;                      ///< n, >= 1
    double damping   = 0.02;                    ///< of critical, of the lever's inertia on the contact, see contact_time()
    std::optional<double> tangential_stiffness; ///< in stick [N/mm]; none: from the layer's shear
  };

  enum class SupportType
  {
    rigid,
    sprung ///< the pivot frame moves along x
  };

  /// Pivot frame between lever and force sensor. Mass, stiffness and damping count only when sprung.
  struct Support
  {
    SupportType type = SupportType::rigid;
    double mass      = 2e-3;  ///< m_f [t], > 0
    double stiffness = 5000.; ///< k_f [N/mm], > 0
    double damping   = 0.02;  ///< of critical of frame and lever on k_f
  };

  /// Time integration by the generalised-alpha method.
  struct TimeSettings
  {
    double step      = 5e-5; ///< first step, or every step [s], > 0
    double tolerance = 5e-3; ///< of the adaptive step: error of P aimed at, over its largest quasi-static value; 0: fixed step
    double spectral_radius = 0.8; ///< at infinite frequency, 0 ... 1
  };

  /// Basis of the condensed model.
  struct CondensedSettings
  {
    unsigned int modes = 20; ///< vibration modes of the free lever, > 0
    std::string cache;       ///< folder of stored bases; empty: the user's cache folder
  };

  struct MeshSettings
  {
    double face_size        = 0.5; ///< element length along the friction face [mm], > 0
    double faces_in_contact = 0.;  ///< least number of faces across the contact, see face_grading(), >= 0
    unsigned int degree     = 2;   ///< 1 or 2
    std::string file;              ///< user's .geo or .msh; empty: the built-in lever

    // In three dimensions.
    unsigned int elements_across = 10;  ///< over the width, > 0
    double growth_across         = 1.2; ///< of an element over the one beside it, from the edges to the middle, >= 1
  };

  enum class FieldOutput
  {
    none,
    turning_points, ///< at every reversal and at the end
    interval        ///< at every `field_interval` of travel too
  };

  struct OutputSettings
  {
    FieldOutput fields    = FieldOutput::turning_points;
    double field_interval = 5.; ///< [mm], > 0
  };

  enum class SlopeSweep
  {
    coefficient, ///< C_Q over mu at the scene's geometry (Fig. 10)
    inclination  ///< C_Q over th0 for a list of e/R at the scene's mu (Fig. 11)
  };

  struct SlopeSettings
  {
    SlopeSweep sweep                  = SlopeSweep::coefficient;
    unsigned int number_of_points     = 121;
    double maximum_coefficient        = 1.2;
    double maximum_inclination        = 1.0471975511965976; ///< [rad]
    std::vector<double> offset_ratios = { 0., 0.2, 0.4, 0.6, 0.8 };
  };

  enum class Direction
  {
    forward,
    backward
  };

  /// What holds cylinder and lever together in undamped modes.
  enum class HeldContact
  {
    open,
    frictionless,
    stuck
  };

  /// Linearised vibration about a steady slide held at one x.
  struct StabilitySettings
  {
    std::optional<double> position; ///< x [mm]; none: the drive's largest
    Direction direction  = Direction::backward;
    unsigned int modes   = 10;                        ///< reported, lowest first, > 0
    bool damping         = true;                      ///< false: no damping of lever, support and contact
    HeldContact contact  = HeldContact::frictionless; ///< of modal analyses
    std::string critical = "auto";                    ///< parameters searched for critical values, see critical_searches()
    bool roles           = true;                      ///< whether flexure, inertia ... are left out in turn
  };

  /// A parameter by its --set name, over a range.
  struct ParameterRange
  {
    std::string name;
    double from         = 0.;
    double to           = 0.;
    unsigned int points = 2; ///< ends included
  };

  struct MapSettings
  {
    ParameterRange first{ "Friction/Factor", 0.5, 2., 33 };
    ParameterRange second{ "Lever/Depth", 3., 25., 33 };
    unsigned int coarsest   = 4; ///< intervals of the grid between points of the first level, a power of 2
    unsigned int bisections = 3; ///< of each edge that a boundary crosses
  };

  /// A parameter by its --set name and the values that it takes, as texts.
  struct VariedParameter
  {
    std::string name;
    std::vector<std::string> values;
  };

  /// How a study combines the values of several parameters.
  enum class Combination
  {
    grid, ///< each value of one with each of the others
    list  ///< the first values of all, then the second ones, ...
  };

  /// Runs of one analysis of the scene at other values of its parameters.
  struct StudySettings
  {
    AnalysisType type   = AnalysisType::quasi_static; ///< of each run
    std::string vary    = "Friction/Factor = 0.5 ... 1.5 : 5";
    Combination combine = Combination::grid;
    std::string reference; ///< settings of the run that the others are compared with; empty: none

    // What the texts say, see variation_of().
    std::vector<VariedParameter> varied;
    std::vector<VariedParameter> reference_values; ///< one value each
  };

  /// Perturbation of a held slide in time, and its limit cycles up and down the stroke.
  struct SpragSlipSettings
  {
    double initial                = 1e-6; ///< amplitude over the mean overlap, > 0
    double final                  = 1e-3; ///< up to which growth is fitted; a stable slide begins there
    unsigned int steps_per_period = 128;
    double longest_growth         = 2.;  ///< [s]
    double settling               = 0.3; ///< at each x, before the cycle is told [s]
    unsigned int continuation     = 14;  ///< intervals up and down the stroke; 0: none
    std::optional<double> turn;          ///< x at which the continuation turns; none: the drive's smallest
  };

  enum class AddedMass
  {
    hub, ///< Lever/Hub inertia
    tip  ///< Lever/Tip mass
  };

  /// What the meshed parts are made to have.
  struct CalibrationSettings
  {
    std::optional<double> stiffness;         ///< k [N mm/rad] by the leaf spring's thickness; none: the leaf as it is
    std::optional<double> moment_of_inertia; ///< J [t mm^2] by added mass; none: as it is
    AddedMass mass = AddedMass::hub;
  };

  /// How accurate results are to be. Settings that a file leaves open follow from it.
  struct AccuracySettings
  {
    double target          = 0.;         ///< relative error wanted [-]; 0: nothing follows from it
    std::string quantity   = "auto";     ///< names of quantities of /accuracy, separated by commas
    double budget          = 0.;         ///< CPU time that a run may take [s]; 0: any
    bool is_model_open     = false;      ///< Analysis/Model = auto
    bool is_dimension_open = false;      ///< Analysis/Dimension = auto
    std::vector<std::string> quantities; ///< those meant

    bool is_asked_for() const
    {
      return target > 0. || budget > 0.;
    }

    /// Whether something of the scene is to be chosen before it is run.
    bool leaves_open() const
    {
      return is_dimension_open || is_asked_for();
    }
  };

  struct Scene
  {
    AnalysisSettings analysis;
    Geometry geometry;
    Drive drive;
    FrictionLaw friction;
    Lever lever;
    FrictionLayer layer;
    LeverFrameShape frame;
    FrictionPlate plate;
    Cylinder cylinder;
    RotationalSpring spring;
    MirroredPair pair;
    Support support;
    TimeSettings time;
    CondensedSettings condensed;
    ContactSettings contact;
    MeshSettings mesh;
    OutputSettings output;
    SlopeSettings slope;
    StabilitySettings stability;
    MapSettings map;
    StudySettings study;
    SpragSlipSettings sprag_slip;
    CalibrationSettings calibration;
    IsolationSettings isolation;
    DesignSettings design;
    IdentificationSettings identification;
    AccuracySettings accuracy;
    std::string name; ///< file name without folder and ending

    /// Every parameter as it was read, by "Section/Name", files with absolute paths; null for a scene that was not read.
    std::shared_ptr<const std::map<std::string, std::string>> parameters;

    std::set<std::string> given; ///< "Section/Name" of the parameters that were given rather than left at their defaults
  };
} // namespace sprag
