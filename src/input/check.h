// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <string>
#include <vector>

namespace sprag
{
  struct Scene;

  /// A rule between parameters that a scene breaks.
  struct Violation
  {
    std::string parameter;           ///< "Section/Name" of the one to be changed
    std::vector<std::string> others; ///< that the rule also depends on
    std::string rule;                ///< "must be ..."
  };

  /// Finds everything wrong with a scene that no single parameter shows: the cylinder must fit the lever and not reach the pivot,
  /// the contact must stay on the lever, the closed form must not lock, settings must not exclude each other. Each parameter
  /// alone is assumed to be in range.
  std::vector<Violation> violations(const Scene &scene);

  /// Collects the rules that are broken.
  struct Rules
  {
    std::vector<Violation> broken;

    void need(const bool kept, const std::string &parameter, const std::vector<std::string> &others, const std::string &rule)
    {
      if (!kept)
        broken.push_back({ parameter, others, rule });
    }
  };

  /// Returns the stiffest normal penalty that the face of a built-in mesh takes [N/mm^3]: some 20 times the automatic one without
  /// inertia, ten times that in time. Beyond that single points between the nodes carry the pressure on more and more of the way,
  /// then Newton's method fails, and a slide that is there is not found.
  double largest_penalty(const Scene &scene);

  /// Checks that penalties are not stiffer than the friction face of a built-in mesh takes.
  void check_penalty(const Scene &scene, Rules &rules);

  /// Checks whether lever frame, friction plate, force sensors and guide can be built. With a mesh of the user's own it checks
  /// only what does not depend on the built-in outlines.
  void check_plate(const Scene &scene, bool own_mesh, Rules &rules);

  /// Checks that frame and plate of a built-in outline leave the cylinder its way. The drive must be in range.
  void check_sweep(const Scene &scene, Rules &rules);

  // The following check the dimensions of a leaf spring, of an elastic cylinder, what is calibrated, and a full pair.
  void check_spring(const Scene &scene, Rules &rules);
  void check_cylinder(const Scene &scene, Rules &rules);
  void check_calibration(const Scene &scene, Rules &rules);
  void check_pair(const Scene &scene, Rules &rules);

  /// Checks that three dimensions can be had for the scene, and the cylinder's place and shape across the width. To be called
  /// for scenes of three dimensions.
  void check_solid(const Scene &scene, Rules &rules);

  /// Checks the lever and the way of a measured stroke. The geometry must be in range.
  void check_identification(const Scene &scene, Rules &rules);

  /// Checks table, damper and base of an isolation system. The geometry must be in range.
  void check_isolation(const Scene &scene, Rules &rules);

  /// Checks what a design takes as it is. The lever is looked at where it is found, as it may lie anywhere within its bounds.
  void check_design(const Scene &scene, Rules &rules);
} // namespace sprag
