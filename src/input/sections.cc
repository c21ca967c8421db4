// SPDX-License-Identifier: GPL-3.0-only
#include "input/sections.h"

#include "base/append.h"
#include "input/section.h"
#include "scene/scene.h"

namespace sprag
{
  namespace
  {
    const Choices<AnalysisType> run_types = { { "quasi-static", AnalysisType::quasi_static },
                                              { "slope", AnalysisType::slope },
                                              { "transient", AnalysisType::transient },
                                              { "contact law", AnalysisType::contact_law },
                                              { "modal", AnalysisType::modal },
                                              { "stability", AnalysisType::stability },
                                              { "sprag slip", AnalysisType::sprag_slip },
                                              { "calibration", AnalysisType::calibration },
                                              { "isolation", AnalysisType::isolation } };
    const auto all_types                  = joined(run_types, { { "map", AnalysisType::map },
                                                                { "identification", AnalysisType::identification },
                                                                { "design", AnalysisType::design },
                                                                { "study", AnalysisType::study } });

    void analysis(Section section, SceneSettings &input)
    {
      AnalysisSettings &settings = input.scene.analysis;
      section.choice(
          "Type", settings.type, all_types,
          "quasi-static: the drive without inertia; slope: C_Q over mu or theta_0; transient: the drive with inertia; contact "
          "law: contact of rigid and beam fitted to finite elements; modal: vibration modes at one x; stability: growth of "
          "vibrations of the slide; sprag slip: the slide perturbed in time and followed to its limit cycle; calibration: parts "
          "that have a given k and J, and constants of the reduced models; isolation: a table on a moving base; map: stability "
          "over two parameters; identification: friction, spring and geometry from a measured stroke; design: the lever that "
          "meets demands; study: runs of any type but the three before at other values of parameters");
      section.choice("Model", input.model,
                     { { "auto", std::nullopt },
                       { "closed form", ModelType::closed_form },
                       { "rigid", ModelType::rigid },
                       { "beam", ModelType::beam },
                       { "condensed", ModelType::condensed },
                       { "finite element", ModelType::finite_element } },
                     "closed form: rigid lever with ideal contact and without mass (eqs. 4-9); rigid, beam, condensed (modes and "
                     "face shapes of the finite elements): with inertia; finite element: the deformable lever; auto: the "
                     "cheapest that meets Accuracy/Target");
      section.choice("Dimension", input.dimension, { { "auto", std::nullopt }, { "2", 2u }, { "3", 3u } },
                     "Dimension of the finite elements; auto: 3 where a probe in three dimensions differs by more than "
                     "Accuracy/Target, or 1 %, in one of Accuracy/Quantity");
      add_plane(section, settings, "Plane stress or plane strain of the lever; layer, cylinder and leaf spring have their own");
      section.choice("Solution", settings.solution, { { "automatic", Solution::automatic }, { "general", Solution::general } },
                     "automatic: one factorisation if the material is linear; general: a factorisation in every iteration");
      section.length("Step", settings.step, "Largest change of x in a step");
      section.length("Minimum step", settings.minimum_step, "Change of x below which the analysis gives up");
      section.number("Maximum deviation", settings.maximum_deviation, at_least(0.), "",
                     "Largest admissible deviation of P, Q and theta from the closed form; 0 admits any");
      section.number("Maximum energy residual", settings.maximum_residual, at_least(0.), "",
                     "Largest admissible gap in the energy balance in time, over the largest work done; 0 admits any");
      section.choice("Warnings", settings.warnings,
                     { { "report", WarningTreatment::report }, { "error", WarningTreatment::error } },
                     "report: a run with warnings prints and stores them; error: it fails as well");
    }

    void geometry(Section section, Geometry &settings)
    {
      section.length("Cylinder radius", settings.cylinder_radius, "R, radius of the cylinder");
      section.number("Interface offset", settings.interface_offset, at_least(0.), "mm",
                     "e, distance from the pivot to the friction interface, at right angles to it; less than R");
      section.length("Pivot distance", settings.pivot_distance, "l, distance from the origin to the pivot along x; more than R");
      section.number("Pivot height", settings.pivot_height, any_number(), "mm",
                     "h, height of the pivot above the x-axis; less than R - e");
    }

    void drive(Section section, DriveSettings &settings)
    {
      section.choice(
          "Profile", settings.profile,
          { { "triangle", DriveProfile::triangle }, { "harmonic", DriveProfile::harmonic }, { "table", DriveProfile::table } },
          "Motion of the cylinder: constant speed, 1 - cos, or a file; a table needs no other number of the drive");
      section.number("Start", settings.start, at_least(0.), "mm", "x at the beginning");
      section.length("Stroke", settings.stroke, "x at the turning point, which is met exactly; more than Start");
      section.number("Speed", settings.speed, above(0.), "mm/s", "v, speed of the triangle or peak speed of the harmonic motion");
      section.number("Cycles", settings.cycles, { 0., 1e5, false, true }, "",
                     "Number of motions from Start to Stroke and back; 0.5: there only");
      section.number("Reversal duration", settings.reversal, at_least(0.), "s",
                     "T, time of a triangle in time from Speed to the opposite Speed, and from rest to Speed where Start = 0");
      auto table = section.only_with("Profile", "table");
      table.text("Table", settings.table, "File with the columns time [s] and x [mm], relative to the folder of this one",
                 Rule::Kind::file);
      table.number(
          "Smoothing", settings.smoothing, at_least(0.), "s",
          "Duration of a smoothing by parabolas with tricube weights (LOESS): each x of Table becomes that of the parabola that "
          "fits the rows within half of it best. Waves of this period keep 91 %, of half of it 29 %; 0: the rows as they are");
    }

    void friction(Section section, FrictionSettings &settings, FrictionLaw &law)
    {
      section.choice(
          "Law", settings.law,
          { { "Coulomb", FrictionChoice::coulomb },
            { "cork on aluminium", FrictionChoice::cork_on_aluminium },
            { "Stribeck", FrictionChoice::stribeck },
            { "table", FrictionChoice::table } },
          "Coulomb: constant; cork on aluminium: mu(v) by eqs. 13-15; Stribeck: falling from rest; table: from a file");
      section.only_with("Law", "Coulomb")
          .number("Coefficient", settings.coulomb.coefficient, at_least(0.), "", "mu of the Coulomb law");
      auto stribeck = section.only_with("Law", "Stribeck");
      stribeck.number("Static coefficient", settings.stribeck.at_rest, at_least(0.), "", "mu_s, friction coefficient at rest");
      stribeck.number("Kinetic coefficient", settings.stribeck.kinetic, at_least(0.), "", "mu_k, above Stribeck speed");
      stribeck.number("Stribeck speed", settings.stribeck.speed, above(0.), "mm/s",
                      "v_s, speed over which mu = mu_k + (mu_s - mu_k) exp(-(v/v_s)^delta) + c v falls");
      stribeck.number("Stribeck exponent", settings.stribeck.exponent, at_least(1.), "",
                      "delta; 1: mu falls most steeply at rest, 2: it is level there");
      stribeck.number("Viscous coefficient", settings.stribeck.viscous, at_least(0.), "s/mm", "c, growth of mu with speed");
      section.only_with("Law", "table")
          .text("Table", settings.table, "File with the columns speed [mm/s] and mu [-], relative to the folder of this one",
                Rule::Kind::file);
      section.choice("Speed", law.speed, { { "sliding", FrictionSpeed::sliding }, { "drive", FrictionSpeed::drive } },
                     "Speed that mu depends on: that of sliding, or that of the drive as in the paper");
      section.number("Factor", law.factor, at_least(0.), "", "Factor on mu of any law");
      section.number("Regularisation speed", law.regularisation_speed, at_least(0.), "mm/s",
                     "Sliding speed over which friction changes sign in time; 0: stick is resolved");
      section.number("Memory length", law.memory_length, above(0.), "mm",
                     "Path over which mu follows the speed where it falls with it, in time");
    }

    void lever(Section section, Lever &settings)
    {
      section.choice("Outline", settings.outline, { { "bar", LeverOutline::bar }, { "frame", LeverOutline::frame } },
                     "bar: constant depth on a rigid hub; frame: the two parts of a lever frame");
      section.length("Length", settings.length, "Distance from the pivot to the tip");
      section.length("Depth", settings.depth, "Depth of the metal, without the friction layer");
      section.length("Width", settings.width, "Width out of plane");
      add_material(section, settings, " of the metal");
      section.choice("Material", settings.material,
                     { { "linear", MaterialModel::linear }, { "neo-Hookean", MaterialModel::neo_hookean } },
                     "Law of lever and friction layer; linear: small strain; neo-Hookean: finite strain, in plane strain or "
                     "three dimensions");
      section.number("Moment of inertia", settings.moment_of_inertia, above(0.), "t mm2",
                     "J, moment of inertia about the pivot of all that turns with the hub; densities are scaled to it");
      section.choice("Inertia", settings.inertia,
                     { { "scaled", InertiaSource::scaled }, { "as built", InertiaSource::as_built } },
                     "scaled: densities are scaled to Moment of inertia; as built: the moment of inertia follows from densities");
      section.number("Hub inertia", settings.hub_inertia, at_least(0.), "t mm2",
                     "Moment of inertia about the pivot of the parts that turn with the rigid hub");
      section.number("Tip mass", settings.tip_mass, at_least(0.), "t", "Mass at the tip, on the neutral axis");
      section.number_or_auto("Neutral axis offset", settings.neutral_axis_offset, any_number(), "mm",
                             "e_a, distance from the pivot to the neutral axis of rigid and beam; auto: e + layer + Depth/2; 0: "
                             "each contact point is on an arm e");
      const Interval share = { 0., 1., true, false };
      section.number("Modal damping", settings.modal_damping, share, "",
                     "Damping ratio of each bending mode of the lever out of contact");
      section.number("Mass damping", settings.mass_damping, at_least(0.), "1/s",
                     "Rayleigh damping over the mass, added to Modal damping");
      section.number("Stiffness damping", settings.stiffness_damping, at_least(0.), "s",
                     "Rayleigh damping over the lever's stiffness, added to Modal damping");
    }

    void friction_layer(Section section, FrictionLayer &settings)
    {
      section.number("Thickness", settings.thickness, at_least(0.), "mm", "Thickness of the cork sheet; 0: none");
      add_material(section, settings, " of the layer");
      add_plane(section, settings,
                "Plane stress or strain of the layer: bonded to a lever much wider than it is thick, it cannot contract across");
      section.number_or_auto(
          "Strength", settings.strength, above(0.), "MPa",
          "Pressure from which the layer's cells give way, for a warning; auto: 0.04 E of a cork, none for nu > 0.2");
    }

    void support(Section section, Support &settings)
    {
      section.choice("Type", settings.type, { { "rigid", SupportType::rigid }, { "sprung", SupportType::sprung } },
                     "rigid: the frame of the pivot stands still; sprung: it moves along x, and the rest of this section counts");
      section.number("Mass", settings.mass, above(0.), "t", "m_f, mass of the frame without the lever");
      section.number("Stiffness", settings.stiffness, above(0.), "N/mm", "k_f, stiffness of the force sensor behind the frame");
      section.number("Damping", settings.damping, { 0., 1., true, false }, "", "Damping ratio of frame and lever on the sensor");
    }

    void contact(Section section, SceneSettings &input)
    {
      ContactSettings &settings = input.scene.contact;
      section.choice("Enforcement", input.enforcement,
                     { { "auto", std::nullopt },
                       { "penalty", Enforcement::penalty },
                       { "augmented Lagrangian", Enforcement::augmented_lagrangian } },
                     "Method against overlap of cylinder and lever; auto: augmented Lagrangian without inertia for a linear "
                     "lever of degree 2 with Penalty = auto, else penalty");
      section.number_or_auto("Penalty", settings.penalty, above(0.), "N/mm3",
                             "Pressure over overlap; auto: from mesh and layer, stiffer in time at degree 2");
      section.number_or_auto("Tangential penalty", settings.tangential_penalty, above(0.), "N/mm3",
                             "Friction traction over elastic slip; auto: equal to the normal one");
      section.length("Penetration tolerance", settings.penetration_tolerance,
                     "Change of a multiplier over the penalty at which augmentation ends, in the augmented Lagrangian");
      section.integer("Maximum augmentations", settings.maximum_augmentations, { 1., 1000. },
                      "Largest number of augmentations in a step of the augmented Lagrangian");
      section.choice(
          "Type", settings.type, { { "compliant", ContactType::compliant }, { "ideal", ContactType::ideal } },
          "Contact of rigid and beam, as all below; compliant: P = k delta^n + c delta'; ideal: always closed (rigid only)");
      section.number("Stiffness", settings.stiffness, above(0.), "N/mm^n", "k of P = k delta^n, over the whole width");
      section.number("Exponent", settings.exponent, { 1., 3. }, "", "n of P = k delta^n");
      section.number("Damping", settings.damping, { 0., 1., true, false }, "",
                     "Damping ratio of the lever's inertia on the contact");
      section.number_or_auto("Tangential stiffness", settings.tangential_stiffness, above(0.), "N/mm",
                             "Friction over elastic slip in stick; auto: from the shear of the layer");
    }

    void time(Section section, TimeSettings &settings, std::optional<double> &tolerance)
    {
      section.number("Step", settings.step, above(0.), "s", "First time step, or every one if the step is fixed");
      section.number_or_auto(
          "Tolerance", tolerance, at_least(0.), "",
          "Error of P aimed at, over its largest quasi-static value; 0: fixed step; auto: 5e-3, or 0 where Step is given");
      section.number("Spectral radius", settings.spectral_radius, { 0., 1. }, "",
                     "Spectral radius of the generalised-alpha method at infinite frequency; 1: no algorithmic damping");
    }

    void condensed(Section section, CondensedSettings &settings)
    {
      section.integer("Modes", settings.modes, { 1., 1e4 }, "Vibration modes of the lever out of contact");
      section.text("Cache", settings.cache,
                   "Folder of stored bases, relative to the folder of this file; empty: the user's cache folder");
    }

    void mesh(Section section, SceneSettings &input)
    {
      MeshSettings &settings = input.scene.mesh;
      section.number_or_auto(
          "Face size", input.face_size, above(0.), "mm",
          "Element length along the friction face; auto: 0.25 where Analysis/Type is quasi-static or transient, else 0.5");
      section.number_or_auto(
          "Faces in contact", input.faces_in_contact, { 0., 20. }, "",
          "Least number of elements across the contact. Where it is narrow, those of the built-in bar are shorter than Face "
          "size, down to a quarter; 0: none shorter; auto: without inertia 4, of degree 1 5, else 0");
      section.integer("Degree", settings.degree, { 1., 2. }, "Degree of the polynomials of an element");
      section.integer("Elements across", settings.elements_across, { 1., 200. }, "Elements over the width, in three dimensions");
      section.number("Growth across", settings.growth_across, { 1., 3. }, "",
                     "Width of an element over that of its neighbour, from both edges to the middle, in three dimensions");
      section.text("File", settings.file, "A .geo or .msh file instead of the built-in lever, relative to the folder of this one",
                   Rule::Kind::file);
    }

    void output(Section section, OutputSettings &settings)
    {
      section.choice("Fields", settings.fields,
                     { { "none", FieldOutput::none },
                       { "turning points", FieldOutput::turning_points },
                       { "interval", FieldOutput::interval } },
                     "turning points: fields where P is largest and at and behind reversals; interval: in between too");
      section.length("Field interval", settings.field_interval, "Travel of x between written fields");
    }

    void slope(Section section, SlopeSettings &settings, double &maximum_inclination)
    {
      section.choice("Sweep", settings.sweep,
                     { { "coefficient", SlopeSweep::coefficient }, { "inclination", SlopeSweep::inclination } },
                     "coefficient: C_Q over mu (Fig. 10); inclination: C_Q over theta_0 for a list of e/R at one mu (Fig. 11)");
      section.integer("Number of points", settings.n_points, { 2., 1e6 }, "Points of each curve");
      section.number("Maximum coefficient", settings.maximum_coefficient, above(0.), "", "Largest mu of the sweep over mu");
      section.number("Maximum inclination", maximum_inclination, between(0., 90.), "deg",
                     "Largest theta_0 of the sweep over theta_0");
      section.numbers("Offset ratios", settings.offset_ratios, { 0., 1., true, false }, "", "e/R of the curves over theta_0");
    }

    void stability(Section section, StabilitySettings &settings)
    {
      section.number_or_auto("Position", settings.position, at_least(0.), "mm",
                             "x at which the slide is held, between the ends of the drive; auto: the whole stroke for a verdict, "
                             "the drive's largest x for modal and sprag slip");
      section.choice(
          "Direction", settings.direction,
          { { "forward", Direction::forward }, { "backward", Direction::backward }, { "both", Direction::both } },
          "Direction of the motion, away from x = 0 or back; both: both for a verdict, backward for modal and sprag slip");
      section.integer("Modes", settings.modes, { 1., 1000. }, "Lowest modes to be reported, beside any unstable one");
      section.choice("Damping", settings.damping, { { "on", true }, { "off", false } },
                     "Damping of lever, support and contact; off: none, friction keeps its dependence on speed");
      section.choice(
          "Contact", settings.contact,
          { { "open", HeldContact::open }, { "frictionless", HeldContact::frictionless }, { "stuck", HeldContact::stuck } },
          "Contact of a modal analysis: none, without friction, or stuck to the cylinder");
      section.text("Critical", settings.critical,
                   "Parameters whose critical values are sought, at which the slide loses stability or jams: list of "
                   "SECTION/NAME FROM TO, separated by semicolons, as in Lever/Depth 3 mm 20 mm; auto: friction factor, x, speed "
                   "and, where it needs no new mesh, depth; none");
      section.text(
          "Ranges", settings.ranges,
          "Ranges of uncertain parameters, as Contact/Damping 0.01 0.1: list of SECTION/NAME FROM TO as for Critical. Verdicts, "
          "maps and critical values are then the worst of the scene, all combinations of the ranges' ends, and values inside "
          "each range; none");
      section.choice("Roles", settings.roles, { { "on", true }, { "off", false } },
                     "on: the slide is judged again without flexure, inertia, mu'(v), support and damping, one by one");
    }

    void map(Section section, MapSettings &settings)
    {
      const auto axis = [&](const std::string &which, ParameterRange &range)
      {
        section.text(which + " parameter", range.name, "SECTION/NAME of the parameter, as with --set");
        section.number(which + " from", range.from, any_number(), "of " + which + " parameter", "Value at the first point");
        section.number(which + " to", range.to, any_number(), "of " + which + " parameter", "Value at the last point");
        section.integer(which + " points", range.points, { 2., 10000. }, "Points of the grid, both ends included");
      };
      axis("First", settings.first);
      axis("Second", settings.second);
      section.integer("Coarsest", settings.coarsest, { 1., 1024. },
                      "Distance between points of the grid where nothing changes, a power of 2; 1: every point");
      section.integer("Bisections", settings.bisections, { 0., 40. }, "Bisections between points on both sides of a boundary");
    }

    void study(Section section, StudySettings &settings)
    {
      section.choice("Type", settings.type, run_types, "Analysis of each run");
      section.text("Vary", settings.vary,
                   "Values of parameters: list of SECTION/NAME = VALUES, separated by semicolons. Values are separated by "
                   "commas; FIRST ... LAST : NUMBER are so many from FIRST to LAST, at equal ratios with log behind it");
      section.choice("Combine", settings.combine, { { "grid", Combination::grid }, { "list", Combination::list } },
                     "grid: each value of one parameter with each of the others; list: the first of all, the second of all, ...");
      section.text("Reference", settings.reference,
                   "Settings of one more run, from which the errors of the others are taken: list of SECTION/NAME = VALUE, "
                   "separated by semicolons; empty: none");
    }

    void sprag_slip(Section section, SpragSlipSettings &settings)
    {
      const Interval share = { 0., 1., false, false };
      section.number("Initial amplitude", settings.initial, share, "",
                     "Amplitude of the perturbation of the contact's overlap, over its mean");
      section.number("Final amplitude", settings.final, share, "",
                     "Amplitude up to which the growth is fitted, more than Initial; a stable slide decays from it");
      section.integer("Steps per period", settings.steps_per_period, { 16., 1e5 }, "Time steps in a period of the mode");
      section.number("Longest growth", settings.longest_growth, above(0.), "s", "Time limit of the growth to Final amplitude");
      section.number("Settling time", settings.settling, above(0.), "s", "Time at each x before a limit cycle is judged");
      section.integer("Continuation", settings.continuation, { 0., 1000. },
                      "Intervals of x, from Stability/Position to Turn and back; 0: Stability/Position only");
      section.number_or_auto("Turn", settings.turn, at_least(0.), "mm",
                             "x at which the continuation turns; auto: the drive's smallest x");
    }

    void accuracy(Section section, AccuracySettings &settings)
    {
      section.number("Target", settings.target, { 0., 0.5 }, "",
                     "Relative error of Quantity aimed at: the program chooses model, mesh, step and modes that the file does "
                     "not give; 0: no choice");
      section.text("Quantity", settings.quantity,
                   "Quantities that Target applies to: list of P, Q, loop_area, largest_pressure, contact_width, largest_stress "
                   "without inertia, growth_rate, frequency of held slides, P, overshoot, frequency in time; auto: P, Q, "
                   "loop_area, or growth_rate, frequency, or P");
      section.number("Budget", settings.budget, at_least(0.), "s",
                     "CPU time that the run may take, within which the program chooses the most accurate settings; 0: any");
    }
  } // namespace

  std::string to_word(const AnalysisType type)
  {
    return word_for(all_types, type);
  }

  std::vector<Parameter> scene_parameters(SceneSettings &settings)
  {
    Scene &scene = settings.scene;
    std::vector<Parameter> all;
    analysis({ all, "Analysis" }, settings);
    geometry({ all, "Geometry" }, scene.geometry);
    drive({ all, "Drive" }, settings.drive);
    friction({ all, "Friction" }, settings.friction, scene.friction);
    lever({ all, "Lever" }, scene.lever);
    friction_layer({ all, "Friction layer" }, scene.layer);
    add_apparatus_parameters(scene, all);
    support({ all, "Support" }, scene.support);
    contact({ all, "Contact" }, settings);
    time({ all, "Time" }, scene.time, settings.time_tolerance);
    mesh({ all, "Mesh" }, settings);
    condensed({ all, "Condensed" }, scene.condensed);
    output({ all, "Output" }, scene.output);
    slope({ all, "Slope" }, scene.slope, settings.maximum_inclination);
    stability({ all, "Stability" }, scene.stability);
    map({ all, "Map" }, scene.map);
    study({ all, "Study" }, scene.study);
    sprag_slip({ all, "Sprag slip" }, scene.sprag_slip);
    add_analysis_parameters(scene, all);
    accuracy({ all, "Accuracy" }, scene.accuracy);
    return all;
  }
} // namespace sprag
