#include "analysis/run_stability.h"

#include "analysis/recorder.h"
#include "analysis/report.h"
#include "analysis/vibration_report.h"
#include "base/errors.h"
#include "scene/held_slide.h"

#include <iostream>

namespace sprag
{
  namespace
  {
    /// Of the distance searched: reduced models cost nothing.
    double tolerance_of(const Scene &scene)
    {
      const ModelType model = scene.analysis.model;
      return model == ModelType::rigid || model == ModelType::beam ? 1e-8 : 1e-3;
    }

    std::vector<CriticalValue> all_critical(const Scene &scene, DynamicsMaker &maker)
    {
      std::vector<CriticalValue> result;
      const auto searches = critical_searches(scene);
      for (const auto &range : searches.value_or(std::vector<ParameterRange>()))
      {
        const auto found = critical_values(scene, range, tolerance_of(scene), maker);
        result.insert(result.end(), found.begin(), found.end());
      }
      return result;
    }

    /// A result file without a table.
    class Output
    {
    public:
      Output(const Scene &scene, const RunOptions &options)
          : quiet(options.quiet)
          , file((prepare_folder(options.folder), options.folder + "/result.h5"), scene.parameters_text, {}, {})
      {
      }

      void finish(std::vector<Entry> summary, const std::string &status, DynamicsMaker &maker, const std::vector<Group> &groups)
      {
        summary.push_back({ "status", status, "", "how the run ended" });
        file.finish(summary, process_entries(maker.timer()), groups);
      }

      const bool quiet;

    private:
      ResultFile file;
    };

    struct Vibrations
    {
      std::vector<Entry> summary;
      std::vector<Group> groups;
    };

    Vibrations modal(const Scene &scene, DynamicsMaker &maker, const bool quiet)
    {
      Scene undamped             = scene;
      undamped.stability.damping = false;
      undamped                   = held_scene(undamped);
      const auto friction        = scene.stability.contact == HeldContact::stuck ? ContactFriction::stuck : ContactFriction::none;
      const auto dynamics        = maker.make(undamped);
      auto &model                = dynamics.model();
      const auto slide           = model.hold(held_drive(undamped), friction);
      if (!slide)
        throw AnalysisError("no equilibrium at x = " + std::to_string(held_drive(undamped).x) +
                            " mm. Try another Stability/Position.");
      const bool in_contact = scene.stability.contact != HeldContact::open;
      const auto modes      = reported(model.vibrations(*slide, in_contact, scene.stability.modes), scene.stability.modes);
      if (!quiet)
        print_modes(std::cout, modes);
      Vibrations result;
      for (std::size_t i = 0; i < modes.size(); ++i)
        result.summary.push_back({ "frequency_" + std::to_string(i + 1), modes[i].mode.eigenvalue.imag() / (2. * M_PI), "Hz",
                                   "of the undamped mode" });
      result.groups = { mode_group(modes, model) };
      return result;
    }

    void append(std::vector<Entry> &all, const std::vector<Entry> &more)
    {
      all.insert(all.end(), more.begin(), more.end());
    }

    Vibrations stability(const Scene &scene, DynamicsMaker &maker, const bool quiet)
    {
      Vibrations result;
      SlideStability found;
      {
        const Scene held    = held_scene(scene);
        const auto dynamics = maker.make(held);
        found               = judge(dynamics.model(), held_drive(scene), scene.stability.modes);
        const auto modes    = reported(found.modes, scene.stability.modes);
        result.groups       = { mode_group(modes, dynamics.model()) };
        result.summary      = slide_entries(found);
        if (!quiet)
        {
          print_summary(std::cout, result.summary);
          print_modes(std::cout, modes);
        }
      }
      if (scene.stability.roles)
      {
        const auto told = roles(scene, found, maker);
        append(result.summary, role_entries(told));
        if (!quiet)
          print_roles(std::cout, found, told);
      }
      if (scene.stability.critical != "none")
      {
        const auto critical = all_critical(scene, maker);
        append(result.summary, critical_entries(critical));
        if (!quiet)
          print_critical(std::cout, critical);
      }
      return result;
    }
  } // namespace

  void run_vibrations(const Scene &scene, const RunOptions &options)
  {
    require_writable(options.folder);
    DynamicsMaker maker;
    const bool undamped = scene.analysis.type == AnalysisType::modal;
    const auto found    = undamped ? modal(scene, maker, options.quiet) : stability(scene, maker, options.quiet);
    Output(scene, options).finish(found.summary, "completed", maker, found.groups);
  }
} // namespace sprag
