// SPDX-License-Identifier: GPL-3.0-only
#include "run/quasi_static_probes.h"

#include "analysis/accuracy/sample_changes.h"
#include "analysis/accuracy/slide_samples.h"
#include "base/append.h"
#include "fe/mesh/mesh.h"
#include "run/coarser_scene.h"
#include "scene/scene.h"

#include <algorithm>

namespace sprag
{
  namespace
  {
    constexpr unsigned int samples_of_stroke = 6, samples_in_space = 3;

    std::vector<Row> rows_at(const std::vector<double> &times, const std::vector<Row> &rows)
    {
      std::vector<Row> result;
      for (const Row &row : rows)
        if (std::find(times.begin(), times.end(), row[Column::time]) != times.end())
          result.push_back(row);
      return result;
    }

    std::vector<double> times_of(const std::vector<Row> &rows)
    {
      std::vector<double> result;
      for (const Row &row : rows)
        result.push_back(row[Column::time]);
      return result;
    }

    /// Sets the samples of a run, and returns them with the rows of its passage through stick between.
    std::vector<Row> choose_rows(const std::vector<Row> &rows, const unsigned int of_stroke, const std::vector<double> &times,
                                 Probes &probes)
    {
      probes.run     = slide_samples(rows, of_stroke, times);
      probes.passage = passage_rows(rows);
      auto chosen    = times_of(probes.run);
      append(chosen, times_of(probes.passage));
      return rows_at(chosen, rows);
    }

    void set_coarse(const std::vector<Row> &rows, Probes &probes)
    {
      probes.coarse         = rows_at(times_of(probes.run), rows);
      probes.coarse_passage = rows_at(times_of(probes.passage), rows);
    }

    void set_soft(const std::vector<Row> &rows, Probes &probes)
    {
      probes.soft         = rows_at(times_of(probes.run), rows);
      probes.soft_passage = rows_at(times_of(probes.passage), rows);
    }

    /// Gives a model its own penalties back.
    template <class Levers>
    struct OwnPenalties
    {
      Levers &levers;
      const ContactPenalties penalties = levers.penalties();

      ~OwnPenalties()
      {
        levers.use_penalties(penalties);
      }
    };

    /// The samples in the run's own model with a softer penalty, where that says anything.
    template <class Levers>
    std::vector<Row> with_softer_penalty(const Scene &scene, Levers &levers, const std::vector<Row> &samples, const double start,
                                         const QuasiStaticSettings &settings)
    {
      const bool augments = scene.contact.enforcement == Enforcement::augmented_lagrangian;
      if (augments && !scene.contact.tangential_penalty)
        return {};
      const OwnPenalties<Levers> own{ levers };
      const auto &penalties = own.penalties;
      levers.use_penalties({ augments ? penalties.normal : penalties.normal / softer, penalties.tangential / softer });
      return repeated(levers, samples, start, settings);
    }
  } // namespace

  Probes plane_probes(const Scene &scene, StaticLever<2> &levers, const std::vector<Row> &rows,
                      const QuasiStaticSettings &settings, const std::vector<StressSample> &stresses)
  {
    Probes result;
    const auto times   = times_of(stresses);
    const double start = rows.front()[Column::x];
    const auto chosen  = choose_rows(rows, samples_of_stroke, times, result);
    Mesh mesh;
    const Scene coarse = with_coarser_mesh(with_penalties(scene, levers.penalties(), 1.));
    make_mesh(coarse, mesh);
    StaticLever<2> on_coarse(mesh, coarse);
    StressComparison stress(on_coarse, stresses);
    set_coarse(repeated(on_coarse, chosen, start, settings,
                        [&](const State &state, const Row &row, const Evaluation &) { stress.look_at(state, row); }),
               result);
    result.stress = stress.changes();
    result.pressure_with_stress =
        result.stress ? relative_change("largest_pressure", rows_at(times, result.run), rows_at(times, result.coarse)) : 0.;
    set_soft(with_softer_penalty(scene, levers, chosen, start, settings), result);
    return result;
  }

  Probes solid_probes(const Scene &scene, SolidBody &body, StaticLever<3> &lever, const std::vector<Row> &rows,
                      const QuasiStaticSettings &settings)
  {
    Probes result;
    const double start = rows.front()[Column::x];
    const auto chosen  = choose_rows(rows, samples_in_space, {}, result);
    set_soft(with_softer_penalty(scene, lever, chosen, start, settings), result);
    body.release_factors(); // before there are others
    Mesh mesh;
    const Scene coarse = with_coarser_mesh(with_penalties(scene, lever.penalties(), 1.));
    make_mesh(coarse, mesh);
    const SolidBody coarse_body(coarse, mesh);
    StaticLever<3> on_coarse(coarse_body, coarse);
    set_coarse(repeated(on_coarse, chosen, start, settings), result);
    return result;
  }
} // namespace sprag
