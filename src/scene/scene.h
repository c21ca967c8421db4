#pragma once

#include "laws/friction.h"
#include "scene/drive.h"

#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  // A scene is plain data: what there is and what is done to it, at no particular fidelity.
  // Units: mm, N, s, tonne, rad (so MPa and mJ). All forces and stiffnesses are per lever over its whole width.

  enum class AnalysisType
  {
    quasi_static,
    slope
  };

  enum class ModelType
  {
    closed_form,
    finite_element
  };

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

  struct AnalysisSettings
  {
    AnalysisType type        = AnalysisType::quasi_static;
    ModelType model          = ModelType::finite_element;
    unsigned int dimension   = 2;
    PlaneState plane         = PlaneState::stress;
    Solution solution        = Solution::automatic;
    double step              = 1.;   ///< largest change of x in a step [mm], > 0
    double minimum_step      = 1e-6; ///< smallest change of x tried before the analysis gives up [mm], > 0
    double maximum_deviation = 0.;   ///< largest admissible deviation from the closed form [-]; 0: any
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
    neo_hookean
  };

  struct Lever
  {
    double length          = 210.;
    double depth           = 20.; ///< metal only [mm]
    double width           = 40.;
    double young_modulus   = 70000.;
    double poisson_ratio   = 0.33;
    double density         = 2.7e-9;                ///< [t/mm^3]
    MaterialModel material = MaterialModel::linear; ///< of lever and friction layer
  };

  struct FrictionLayer
  {
    double thickness     = 1.; ///< [mm], >= 0; 0: no layer
    double young_modulus = 20.;
    double poisson_ratio = 0.;
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
  };

  struct MeshSettings
  {
    double face_size    = 0.5; ///< element length along the friction face [mm], > 0
    unsigned int degree = 2;   ///< 1 or 2
    std::string file;          ///< user's .geo or .msh; empty: the built-in lever
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

  struct Scene
  {
    AnalysisSettings analysis;
    Geometry geometry;
    Drive drive;
    FrictionLaw friction;
    Lever lever;
    FrictionLayer layer;
    double spring_stiffness = 7.40e4; ///< k [N mm/rad], > 0
    ContactSettings contact;
    MeshSettings mesh;
    OutputSettings output;
    SlopeSettings slope;
    std::string name;            ///< file name without folder and ending
    std::string parameters_text; ///< every parameter as used, in .prm form
  };
} // namespace sprag
