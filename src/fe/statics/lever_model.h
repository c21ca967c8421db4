#pragma once

#include "fe/contact/augmentation.h"
#include "fe/contact/face_contact.h"
#include "fe/mesh/mesh.h"
#include "fe/statics/face_compliance.h"
#include "fe/statics/full_stiffness.h"
#include "model/hub_spring.h"
#include "model/model.h"

#include <functional>
#include <optional>
#include <variant>

namespace sprag
{
  /// The rotational spring at the hub.
  struct HubSpring
  {
    MomentLaw law;
    double rest = 0.; ///< inclination without moment [rad]
    double arm  = 1.; ///< length that turns a rotation into a movement [mm], > 0
  };

  /// What the moment of a rotational spring that feels more than one lever exceeds k phi by, k its linear stiffness and phi the
  /// turn of the lever it acts on.
  struct MomentExcess
  {
    double moment    = 0.; ///< against the turn [N mm]
    double stiffness = 0.; ///< what its stiffness exceeds k by [N mm/rad]
  };

  /// Automatic normal penalty over E/depth of the friction layer or, without one, of the first cells, where it is not that of a
  /// run without inertia.
  namespace penalty_over_layer
  {
    /// In time the penalty lies in series with the layer and slows the ringing: by 2.4 % at 12, by 0.25 % at this one. Linear
    /// elements would ring as they pass under such a contact.
    constexpr double in_time        = 120.;
    constexpr double in_time_linear = 12.;

    /// Hard contact, to which laws of the reduced models are fitted.
    constexpr double indentation = 1200.;
  } // namespace penalty_over_layer

  /// Everything that makes a meshed lever but its mesh.
  struct LeverProperties
  {
    BodyProperties body;
    Obstacle obstacle;
    std::function<double(double)> ideal_theta;        ///< inclination that first guesses follow, over x [rad]
    std::function<LeverPoint(double, double)> centre; ///< of the obstacle over x and theta
    double radius = 0.; ///< R of an elastic obstacle, 0 if it turns with the lever, see FacePair [mm]
    HubSpring spring;
    std::optional<double> support_stiffness; ///< k_f of a sprung support [N/mm], > 0; none: it is rigid
    FrictionLaw friction;
    ContactSettings contact;
    std::optional<double> penalty_factor; ///< of an automatic penalty, see contact_penalties()
    Solution solution       = Solution::automatic;
    double layer_thickness  = 0.;     ///< [mm]
    double interface_offset = 0.;     ///< e [mm]
    std::optional<Geometry> geometry; ///< of the damper, see static_terms(); none: another body on another path
  };

  LeverProperties lever_properties(const Scene &scene);

  /// The settings' penalties, or `over_layer` E/depth, or without it what suits mesh and layer of a run without inertia or of the
  /// augmented Lagrangian.
  ContactPenalties contact_penalties(const FrictionFace<2> &face, const ContactSettings &settings, double layer_thickness,
                                     const std::optional<double> &over_layer);

  /// The same of a body; with an elastic cylinder the softer of both faces counts.
  ContactPenalties contact_penalties(const ElasticBody<2> &body, const ContactSettings &settings, double layer_thickness,
                                     const std::optional<double> &over_layer);

  /// Meshed lever on its hub, rotational spring and support against a rigid obstacle or, where the body has a cylinder's face, an
  /// elastic one: Model in lever axes, which turn with the hub.
  class LeverModel : public Model
  {
  public:
    /// `triangulation` must outlive the model. Throws InputError for properties that exclude each other.
    LeverModel(const dealii::Triangulation<2> &triangulation, LeverProperties properties);

    State initial_state(const DrivePoint &drive) const override;
    void predict(State &trial, const State &accepted) const override;
    Unbalance evaluate(const State &trial, const State &accepted, FrictionMode mode) override;
    dealii::Vector<double> correction() override;

    /// evaluate() with another moment of the spring than that of the lever's own turn.
    Unbalance evaluate(const State &trial, const State &accepted, FrictionMode mode, const MomentExcess &spring);

    /// What a unit moment on the hub adds to the last correction() [1/(N mm)].
    dealii::Vector<double> moment_response();
    double movement(const dealii::Vector<double> &correction) const override;
    double length_scale() const override;
    double penetration() const override;
    std::string objection(const State &trial) const override;
    void augment(State &trial) const override;
    std::vector<ContactMemory> memory() const override;
    void observe(const State &trial, Row &row) const override;
    FacePoints face_points() const override;
    FaceState face_state(const State &trial) const override;

    unsigned int n_face_points() const;

    const ContactPenalties &penalties() const;

    const ElasticBody<2> &elastic_body() const;

    /// Displacement of all degrees of freedom at the last evaluation, in lever axes [mm].
    dealii::Vector<double> body_displacement(const State &state) const;

    /// Finds body_displacement() of the last evaluation when it is asked, also after the model has moved on.
    std::function<dealii::Vector<double>()> recovery(const State &state) const;

    /// Index of the hub's turn among the coordinates.
    unsigned int rotation() const;

    /// Of the hub from the spring's rest [rad].
    double turn(const State &state) const;

  private:
    void evaluate_contact(const State &trial, const State &accepted, FrictionMode mode);
    Unbalance unbalance(const State &trial, const PortForces &loads);
    const PortForces &forces_with(const MomentExcess &spring);
    double support_displacement(const State &state) const;
    double cylinder_energy() const;

    const LeverProperties properties;
    const ElasticBody<2> body;
    const PortLayout ports;
    FaceContact contact;
    const FaceMultipliers multipliers;
    std::variant<FaceCompliance, FullStiffness> system;
    HubSpringExcess excess;
    PortForces with_moment;             ///< of contact and a moment given
    std::vector<ContactMemory> begin;   ///< memory and multipliers of the last evaluation
    const PortForces *forces = nullptr; ///< of contact and spring beyond its linear part, at the last evaluation
  };
} // namespace sprag
