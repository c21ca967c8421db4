// SPDX-License-Identifier: GPL-3.0-only
#include "program/resources.h"

#include "analytic/isolation.h"
#include "analytic/step_clock.h"
#include "base/errors.h"
#include "base/krylov_size.h"
#include "base/phase_timer.h"
#include "base/system/memory.h"
#include "base/text.h"
#include "program/recorder.h"
#include "scene/analysis_use.h"
#include "scene/contact_estimates.h"
#include "scene/held_slide.h"
#include "scene/lever_shape.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <ostream>

namespace sprag
{
  namespace
  {
    constexpr double formula_row_seconds = 4e-6;   ///< [s]
    constexpr double random_row_seconds  = 1.9e-5; ///< likewise, over a base that moves by many frequencies [s]
    constexpr double usual_calculation   = 3.3e-3; ///< that slowness() refers to [s]

    /// Sines, roots and divisions that wait for each other.
    double calculated()
    {
      double value = 0.5;
      for (unsigned int i = 0; i < 200000; ++i)
        value = std::sqrt(1. + std::sin(value)) / (1. + value);
      return value;
    }

    double shortest_calculation()
    {
      double shortest = 1.;
      for (unsigned int i = 0; i < 3; ++i)
      {
        const double begin = PhaseTimer::cpu_seconds();
        if (!(calculated() > 0.))
          break;
        shortest = std::min(shortest, PhaseTimer::cpu_seconds() - begin);
      }
      return shortest;
    }

    /// Elements over a length whose sizes grow by `growth` from `first` to `largest`.
    double graded(const double length, const double first, const double largest, const double growth)
    {
      const double growing = std::max(0., std::log(largest / first) / std::log(growth));
      const double grown   = first * (std::pow(growth, growing) - 1.) / (growth - 1.);
      if (grown > length)
        return std::log1p(length * (growth - 1.) / first) / std::log(growth);
      return growing + (length - grown) / largest;
    }

    double elements_along_face(const Scene &scene)
    {
      const double size        = scene.mesh.face_size;
      const double largest     = std::max(size, 0.15 * scene.lever.depth);
      const auto [first, last] = contact_surroundings(scene);
      const auto [begin, end]  = friction_face(scene);
      const double from        = std::clamp(first, begin, end);
      if (const auto grading = face_grading(scene))
        return graded(from - begin, grading->longest, largest, 1.2) + (grading->begin - from) / grading->longest +
               (grading->end - grading->begin) * std::log(grading->longest / grading->shortest) /
                   (grading->longest - grading->shortest) +
               graded(end - grading->end, grading->shortest, largest, 1.2);
      const double to = std::clamp(last, begin, end);
      return (to - from) / size + graded(from - begin, size, largest, 1.2) + graded(end - to, size, largest, 1.2);
    }

    /// Depth of the metal that carries the friction face and has rows of elements of its own [mm].
    double depth_under_face(const Scene &scene)
    {
      if (scene.plate.type == PlateType::on_sensors)
        return scene.plate.thickness;
      const bool has_flange = scene.analysis.dimension == 3 && scene.lever.outline == LeverOutline::frame;
      return has_flange ? scene.frame.flange : scene.lever.depth;
    }

    double rows_under_face(const Scene &scene)
    {
      const double size      = scene.mesh.face_size;
      const double thickness = scene.layer.thickness;
      const double depth     = depth_under_face(scene);
      const double first     = thickness > 0. ? std::max(2. * size, thickness) : size;
      return (thickness > 0. ? std::max(2., thickness / size) : 0.) +
             std::max(2., std::log1p(0.5 * depth / first) / std::log(1.5));
    }

    double coarse_size(const Scene &scene)
    {
      return std::max(scene.mesh.face_size, 0.15 * scene.lever.depth);
    }

    /// Rows of elements of a lever frame behind its front flange, along its depth.
    double rows_behind_flange(const Scene &scene)
    {
      const double coarse = coarse_size(scene), flange = scene.frame.flange;
      return std::max(2., (scene.lever.depth - 2. * flange) / coarse) + std::max(2., flange / coarse);
    }

    /// Elements of a section that are not below the friction face: the lever behind a friction plate, the rest of a frame.
    double elements_elsewhere(const Scene &scene)
    {
      const bool is_frame = scene.lever.outline == LeverOutline::frame, has_plate = scene.plate.type == PlateType::on_sensors;
      const double coarse = coarse_size(scene), length = scene.lever.length, root = scene.frame.root;
      if (!is_frame)
        return has_plate ? std::ceil(length / coarse) * std::max(2., scene.lever.depth / coarse) : 0.;
      constexpr double around_hub = 8.;
      const double side           = frame_hub_radius + frame_wall;
      const double root_cells =
          (root + side) / coarse * scene.geometry.interface_offset / coarse + around_hub * 2. * (root + 3. * side) / coarse;
      return root_cells + (has_plate ? (length - root) / coarse * (2. + rows_behind_flange(scene))
                                     : elements_along_face(scene) * rows_behind_flange(scene));
    }

    double cylinder_elements(const Scene &scene)
    {
      if (scene.cylinder.type == CylinderType::rigid)
        return 0.;
      const double size = scene.cylinder.face_size, radius = scene.geometry.cylinder_radius;
      const double width = 2. * (0.1 * radius + scene.layer.thickness);
      return (width / size + 2. * graded(3. * radius, size, 0.26 * radius, 1.4)) *
             std::max(2., std::log1p(0.4 * (radius - scene.cylinder.inner_radius) / size) / std::log(1.4));
    }

    /// While their vector grows there are two of most.
    constexpr double row_bytes = 2. * sizeof(Row);
    constexpr double most_rows = 1e7;

    std::string step_parameter(const Scene &scene)
    {
      if (scene.analysis.type == AnalysisType::isolation)
        return "Isolation/Output step";
      return scene.analysis.type == AnalysisType::transient ? "Time/Step" : "Analysis/Step";
    }

    void require_row_limit(const Scene &scene)
    {
      const double rows = expected_rows(scene);
      if (rows <= most_rows)
        return;
      const bool is_table = scene.analysis.type == AnalysisType::isolation;
      throw InputError(scene.name + ".prm: " + (is_table ? "Isolation/Duration" : "the drive") + " and " + step_parameter(scene) +
                       " make " + rounded_text(rows) + (is_table ? " rows, of which" : " rows or more, of which") +
                       " a run may have " + rounded_text(most_rows) + ". Try longer steps" +
                       (is_table ? " or a shorter duration" : ", fewer cycles or a faster drive"));
    }

    /// Returns bytes a displacement, and copies of the face's square matrices that there are at the peak. Measured, see
    /// tests/run/resources.cc: within 1.3 times what those runs have.
    std::pair<double, double> compute_cost(const Scene &scene)
    {
      if (scene.analysis.type != AnalysisType::quasi_static)
      {
        if (scene.analysis.model == ModelType::finite_element)
          return { scene.analysis.type == AnalysisType::transient ? 16e3 : 10e3, 0. };
        const bool is_table = scene.analysis.type == AnalysisType::isolation; // two levers, which keep steps of some durations
        return { 2.5e3, scene.analysis.type == AnalysisType::modal ? 5.5 : is_table ? 24. : 17. };
      }
      return { is_factorised_once(scene) ? 2e3 : 5e3, 0. };
    }

    /// Matrices that processes share over those of one.
    constexpr double shared_over_whole = 1.2;

    /// Matrices of plate and bar over those of the plate.
    constexpr double bar_behind_plate = 1.5;

    /// Matrices of the interface that a lever in three dimensions keeps: a few, and one for each duration of its steps.
    constexpr double interface_matrices = 20.;

    /// Modes, and matrices of the part of the face where a contact in three dimensions may come.
    double solid_mode_bytes(const Scene &scene, const double displacements, const double n_interface)
    {
      if (scene.analysis.type == AnalysisType::quasi_static)
        return 0.;
      const auto [begin, end] = contact_range(scene);
      const double reached    = n_interface * std::min(1., (end - begin) / scene.mesh.face_size / elements_along_face(scene));
      const bool has_two      = scene.analysis.type == AnalysisType::isolation || scene.pair.type == PairType::full;
      const double kept       = (has_two ? 2. : 1.) * interface_matrices;
      const double sought_in  = 2. * most_columns(scene.condensed.modes); // these and their inertia
      return 8. * (sought_in * displacements + kept * reached * reached);
    }

    /// Bytes of the factors of a whole body in three dimensions, over displacements^(4/3).
    constexpr double factor_bytes = 99.;

    /// Bytes of all matrices of a body in three dimensions, likewise.
    constexpr double solid_bytes = 215.;

    double matrix_bytes(const Scene &scene)
    {
      const auto [displacements, n_interface] = expected_size(scene);
      if (scene.analysis.dimension == 3)
        return solid_bytes * std::pow(displacements, 4. / 3.) + solid_mode_bytes(scene, displacements, n_interface);
      const double levers       = scene.pair.type == PairType::full && !is_factorised_once(scene) ? 2. : 1.;
      const auto [each, copies] = compute_cost(scene);
      const double bar          = scene.plate.type == PlateType::none ? 1. : bar_behind_plate;
      return levers * bar * (each * displacements + copies * 8. * n_interface * n_interface);
    }

    // Files with factors have these sizes and limits.
    constexpr double kept_in_files       = 0.9; ///< of the factors: some are in memory while they are found
    constexpr double disk_share          = 1.1; ///< free on the disk, over their size
    constexpr std::size_t longest_folder = 240; ///< that the solver takes

    /// Bytes free where a folder is or would be made; none where files would take memory themselves.
    double free_on_disk(std::filesystem::path folder)
    {
      std::error_code none;
      folder = std::filesystem::absolute(folder, none);
      while (!std::filesystem::exists(folder, none) && folder.has_relative_path())
        folder = folder.parent_path();
      return bytes_free_on_disk(folder.string());
    }

    std::string gigabytes(const double bytes)
    {
      return formatted(bytes < 99.5e9 ? "%.2g GB" : "%.3g GB", bytes / 1e9);
    }

    double library_memory(const Scene &scene)
    {
      if (follows_formulas(scene))
        return 0.013e9;
      return needs_mesh(scene) ? 0.19e9 : 0.16e9;
    }

    /// The check models of condensed finite elements keep the model of the slides beside that in time.
    double design_memory(Scene scene)
    {
      scene.analysis.model = is_checked_by_mesh(scene) ? ModelType::condensed : ModelType::beam;
      scene.analysis.type  = AnalysisType::stability;
      return library_memory(scene) + 2. * matrix_bytes(scene);
    }
  } // namespace

  double slowness()
  {
    static const double found = shortest_calculation() / usual_calculation;
    return found;
  }

  ExpectedCost formula_cost(const Scene &scene)
  {
    const bool is_random = scene.analysis.type == AnalysisType::isolation && scene.isolation.base == BaseMotionType::random;
    const double row     = is_random ? random_row_seconds : formula_row_seconds;
    return { slowness() * (formula_start_seconds + row * expected_rows(scene)), expected_memory(scene), {} };
  }

  void print_cost(std::ostream &stream, const ExpectedCost &cost)
  {
    stream << "Cost:         about ";
    if (cost.unknown.empty())
      stream << formatted(cost.cpu_seconds < 99.5 ? "%.2g" : "%.0f", cost.cpu_seconds) << " s of CPU time, ";
    stream << formatted("%.2g", cost.bytes / 1e9) << " GB";
    stream << (cost.unknown.empty() ? "" : "; how long is not told: " + cost.unknown) << '\n';
  }

  ExpectedSize expected_size(const Scene &scene)
  {
    if (!needs_mesh(scene) || !scene.mesh.file.empty())
      return {};
    const double p = scene.mesh.degree, n = elements_along_face(scene), rows = rows_under_face(scene);
    if (scene.analysis.dimension == 3)
    {
      const double across = 3. * (p * static_cast<double>(planes_across(scene).size() - 1) + 1.);
      return { across * ((p * n + 1.) * (p * rows + 1.) + p * p * elements_elsewhere(scene)), across * (p * n + 1.) };
    }
    return { 2. * (p * n + 1.) * (p * rows + 1.) + 2. * p * p * cylinder_elements(scene), 2. * (p * n + 1.) };
  }

  double expected_rows(const Scene &scene)
  {
    if (scene.analysis.type == AnalysisType::quasi_static)
      return path_length(scene.drive) / scene.analysis.step;
    if (scene.analysis.type == AnalysisType::isolation)
      return scene.isolation.duration / output_step(scene.isolation);
    if (scene.analysis.type != AnalysisType::transient)
      return 0.;
    const bool adaptive =
        scene.time.tolerance > 0. && scene.analysis.model != ModelType::closed_form && scene.contact.type != ContactType::ideal;
    return scene.drive.duration() / scene.time.step / (adaptive ? std::exp2(largest_doublings) : 1.);
  }

  double expected_memory(const Scene &scene, const unsigned int processes)
  {
    if (scene.analysis.type == AnalysisType::design)
      return design_memory(scene);
    const double rows = expected_rows(scene) * row_bytes;
    if (shares_body(scene))
      return processes * library_memory(scene) + (processes == 1 ? 1. : shared_over_whole) * matrix_bytes(scene) + rows;
    return processes * (library_memory(scene) + matrix_bytes(scene)) + rows;
  }

  std::optional<FactorFiles> factor_files(const Scene &scene, const unsigned int processes, const std::string &folder)
  {
    const double needed        = expected_memory(scene, processes);
    const auto available       = available_memory();
    const bool can_be_in_files = scene.analysis.dimension == 3 && scene.analysis.type == AnalysisType::quasi_static;
    if (!can_be_in_files || folder.empty() || needed <= available.bytes)
      return std::nullopt;
    FactorFiles result{ (std::filesystem::path(folder) / ".sprag-factors").string(), needed, available, 0.,
                        factor_bytes * std::pow(expected_size(scene).displacements, 4. / 3.) };
    result.memory_with_files = needed - kept_in_files * result.bytes;
    const bool fits          = result.memory_with_files <= available.bytes && disk_share * result.bytes <= free_on_disk(folder) &&
                      result.folder.size() < longest_folder;
    return fits ? std::optional(result) : std::nullopt;
  }

  std::string to_text(const FactorFiles &files)
  {
    return "in memory alone the run would need about " + gigabytes(files.memory) + ", and " + gigabytes(files.available.bytes) +
           " are " + files.available.reason + ": the factors of the whole lever are kept in files, " + gigabytes(files.bytes) +
           " in " + files.folder + ", and the run needs about " + gigabytes(files.memory_with_files);
  }

  void require_memory(const Scene &scene, const unsigned int processes, const std::string &folder)
  {
    require_row_limit(scene);
    const double needed  = expected_memory(scene, processes);
    const auto available = available_memory();
    if (needed <= available.bytes || factor_files(scene, processes, folder))
      return;
    const double rows     = expected_rows(scene) * row_bytes;
    const std::string has = ": the run needs about " + gigabytes(needed) + " of memory, and " + gigabytes(available.bytes) +
                            " are " + available.reason + ". ";
    if (rows > needed / 2.)
      throw InputError(scene.name + ".prm: Drive/Cycles and " + step_parameter(scene) + " make " +
                       rounded_text(expected_rows(scene)) + " rows" + has + "Try fewer cycles or longer steps");
    throw InputError(scene.name + ".prm: Mesh/Face size = " + mm(scene.mesh.face_size) + has +
                     (processes > 1 ? "Try a larger one, or fewer processes (--jobs)" : "Try a larger one"));
  }
} // namespace sprag
