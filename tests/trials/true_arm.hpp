#pragma once

#include "arm/arm.hpp"
#include "arm/sensor.hpp"
#include "tests/trials/hub_torque.hpp"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace flexarm::trials {

/// An arm as it really is, in the simulator's own terms; causes change it (cause.hpp). All sums and
/// factors commute, so that the order of causes does not matter.
struct TrueArm {
  /// A massless rotational spring in the beam; at 0 it is between hub and beam.
  struct Spring {
    double position_m = 0.0;
    double stiffness_N_m_per_rad = 0.0;
    double damping_N_m_s_per_rad = 0.0;  ///< beside a spring that is alone there
  };
  /// A gear between the motor's rotor and the hub that the beam is on.
  struct Gear {
    double rotor_share = 0.0;  ///< of hub_inertia_kg_m2
    double stiffness_N_m_per_rad = 0.0;
    double damping_N_m_s_per_rad = 0.0;
  };
  /// A mass that is fixed to the beam.
  struct PointMass {
    double position_m = 0.0;
    double mass_kg = 0.0;
  };
  /// A mass on a spring and a damper beside each other, on the beam.
  struct AttachedMass {
    double position_m = 0.0;
    double mass_kg = 0.0;
    double stiffness_N_per_m = 0.0;
    double damping_N_s_per_m = 0.0;
  };
  /// A curve that the torque passes on its way; curves follow each other by `order`.
  struct TorqueCurve {
    int order = 0;
    std::function<double(double)> torque_N_m;
    double slope = 1.0;  ///< what stands for it in a frequency response
  };
  /// Between what a sensor is to show and what is recorded: its value is taken elsewhere along the
  /// beam, multiplied, delayed, lagged, shifted.
  struct SensorPath {
    arm::Sensor sensor;
    double moved_m = 0.0;  ///< a gauge's place, away from the hub
    double gain = 1.0;
    double delay_s = 0.0;
    double time_constant_s = 0.0;
    double offset = 0.0;
  };

  /// A sensor that reads a part of another one.
  struct CrossTalk {
    arm::Sensor from;
    arm::Sensor to;
    double factor = 0.0;  ///< in the unit of `to` over that of `from`
  };
  /// What carries the motor turns about its axis on a spring and a damper, as the torque reacts on
  /// it; sensors at the hub read the motion against it.
  struct TurningBase {
    double inertia_kg_m2 = 0.0;
    double stiffness_N_m_per_rad = 0.0;
    double damping_N_m_s_per_rad = 0.0;
  };
  /// A mass at the tip on a stiff spring that slips beyond a force.
  struct SlippingMass {
    double mass_kg = 0.0;
    double stiffness_N_per_m = 0.0;
    double damping_N_s_per_m = 0.0;
    double slip_N = 0.0;
  };

  double length_m = 0.0;
  double flexural_rigidity_N_m2 = 0.0;
  double linear_density_kg_per_m = 0.0;
  /// From the root to the tip the thickness falls by this part of its mean, evenly; rigidity goes
  /// with its cube, density with it. Shear keeps the mean.
  double taper = 0.0;
  double softening =
      0.0;  ///< part of the stiffness that is lost from begin to end of a run, evenly
  std::optional<double> width_m;
  std::optional<double> thickness_m;
  std::optional<double> shear_modulus_Pa;
  std::optional<double> shear_coefficient;  ///< empty: the beam is Euler and Bernoulli's
  std::vector<Spring> springs;
  std::vector<PointMass> point_masses;
  std::vector<AttachedMass> attached;
  double kelvin_voigt_s = 0.0;
  double air_damping_N_s_per_m2 = 0.0;
  double gravity_m_per_s2 = 0.0;  ///< along the arm, from the hub to the tip

  double hub_inertia_kg_m2 = 0.0;  ///< of rotor and hub together
  std::optional<Gear> gear;        ///< empty: rotor and hub are one
  double hub_radius_m = 0.0;       ///< from the axis to the beam
  double hub_damping_N_m_s_per_rad = 0.0;
  double hub_spring_N_m_per_rad = 0.0;

  double payload_kg = 0.0;
  double payload_inertia_kg_m2 = 0.0;  ///< about its centre of mass
  double payload_offset_m = 0.0;       ///< of its centre of mass beyond the tip

  /// The commanded torque on its way: delay, curves, lag, bias.
  double torque_delay_s = 0.0;
  std::vector<TorqueCurve> torque_curves;
  double torque_lag_s = 0.0;
  double torque_bias_N_m = 0.0;

  std::vector<MakeHubTorque> hub_torques;
  std::vector<FrictionSize> dry_frictions;
  /// Force per length on the beam by its velocity.
  std::vector<std::function<double(double velocity_m_per_s)>> beam_forces_N_per_m;
  std::vector<SensorPath> sensor_paths;  ///< of sensors that do not show what they should
  std::vector<CrossTalk> cross_talks;
  std::optional<TurningBase> base;
  std::optional<SlippingMass> slipping;

  /// Of the thickness over its mean.
  double thickness_ratio(double position_m) const {
    return 1.0 + taper * (0.5 - position_m / length_m);
  }
};

/// The arm as its file has it. Effects do not enter.
TrueArm true_arm(const arm::Arm& nominal);

/// The path of a sensor, which is added where there is none.
TrueArm::SensorPath& path_of(TrueArm& arm, const arm::Sensor& sensor);
/// The path of a sensor, or one that changes nothing.
TrueArm::SensorPath known_path(const TrueArm& arm, const arm::Sensor& sensor);
/// The sensors where they really are.
std::vector<arm::Sensor> really_placed(const TrueArm& arm, std::span<const arm::Sensor> sensors);

/// What the torque passes first.
namespace torque_curve_order {
inline constexpr int kGain = 1;
inline constexpr int kDeadZone = 2;
inline constexpr int kSaturation = 3;
}  // namespace torque_curve_order

}  // namespace flexarm::trials
