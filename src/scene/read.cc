#include "scene/read.h"

#include "base/csv.h"
#include "base/errors.h"
#include "base/text.h"
#include "scene/check.h"
#include "scene/sections.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

namespace sprag
{
  namespace
  {
    /// Reports the mistakes met on the way to a scene against the parameters they come from.
    class SceneReader
    {
    public:
      SceneReader(const std::string &file, const std::vector<std::string> &overrides);

      Scene scene();

    private:
      SceneSettings input;
      std::vector<Parameter> parameters;
      Settings settings;

      void store();
      void make_drive();
      void make_friction();
      void check();
      void use_table(const std::string &parameter, const std::string &file, const std::function<void(const TwoColumns &)> &use);
      void resolve(const std::string &parameter, std::string &path);
      void report(const std::string &parameter, const std::string &rule);
      bool doubtful(const std::string &parameter) const;
    };

    SceneReader::SceneReader(const std::string &file, const std::vector<std::string> &overrides)
        : parameters(scene_parameters(input))
        , settings(read_settings(file, overrides, parameters))
    {
    }

    Scene SceneReader::scene()
    {
      store();
      make_drive();
      make_friction();
      check();
      if (!settings.mistakes.empty())
        throw InputError(settings.mistakes);
      input.scene.name            = std::filesystem::path(settings.file).stem().string();
      input.scene.parameters_text = parameters_text(parameters, settings.given);
      return input.scene;
    }

    void SceneReader::store()
    {
      for (const auto &parameter : parameters)
        if (const auto given = settings.given.find(full_name(parameter)); given != settings.given.end())
          parameter.store(given->second.value);
      input.scene.slope.maximum_inclination = input.maximum_inclination * std::acos(-1.) / 180.;
      resolve("Drive/Table", input.drive.table);
      resolve("Friction/Table", input.friction.table);
      resolve("Mesh/File", input.scene.mesh.file);
    }

    /// The printed parameters hold absolute paths, so that they can be read back from anywhere.
    void SceneReader::resolve(const std::string &parameter, std::string &path)
    {
      if (path.empty())
        return;
      const auto folder                  = std::filesystem::absolute(settings.file).parent_path();
      path                               = (folder / path).lexically_normal().string();
      settings.given.at(parameter).value = path;
    }

    void SceneReader::make_drive()
    {
      const DriveSettings &drive = input.drive;
      if (drive.profile == DriveProfile::table)
        return use_table("Drive/Table", drive.table,
                         [this](const auto &table) { input.scene.drive = Drive(table.first, table.second); });
      if (drive.stroke > drive.start)
        input.scene.drive = Drive(drive.profile, drive.start, drive.stroke, drive.speed, drive.cycles);
      else if (!doubtful("Drive/Stroke") && !doubtful("Drive/Start"))
        report("Drive/Stroke", "must be more than Start = " + rounded_text(drive.start) + " mm");
    }

    void SceneReader::make_friction()
    {
      const FrictionSettings &friction = input.friction;
      FrictionLaw &law                 = input.scene.friction;
      law.speed                        = friction.speed;
      switch (friction.law)
      {
      case FrictionChoice::coulomb:
        law.law = CoulombFriction{ friction.coefficient };
        break;
      case FrictionChoice::cork_on_aluminium:
        law.law = CorkOnAluminium{};
        break;
      case FrictionChoice::table:
        use_table("Friction/Table", friction.table,
                  [&law](const auto &table) { law.law = TabulatedFriction(table.first, table.second); });
        break;
      }
    }

    void SceneReader::use_table(const std::string &parameter, const std::string &file,
                                const std::function<void(const TwoColumns &)> &use)
    {
      if (file.empty())
        return report(parameter, "must name a file");
      try
      {
        use(read_two_columns(file));
      }
      catch (const InputError &error)
      {
        for (const auto &message : error.messages)
          report(parameter, message);
      }
    }

    void SceneReader::check()
    {
      for (const auto &violation : violations(input.scene))
      {
        const auto known = [this](const auto &name) { return !doubtful(name); };
        if (known(violation.parameter) && std::all_of(violation.others.begin(), violation.others.end(), known))
          report(violation.parameter, violation.rule);
      }
    }

    void SceneReader::report(const std::string &parameter, const std::string &rule)
    {
      add_mistake(settings, parameters, parameter, rule);
      settings.doubtful.insert(parameter);
    }

    bool SceneReader::doubtful(const std::string &parameter) const
    {
      return settings.doubtful.count(parameter) > 0;
    }
  } // namespace

  Scene read_scene(const std::string &file, const std::vector<std::string> &overrides)
  {
    return SceneReader(file, overrides).scene();
  }

  std::string default_parameters_text()
  {
    SceneSettings defaults;
    return parameters_text(scene_parameters(defaults), {});
  }
} // namespace sprag
