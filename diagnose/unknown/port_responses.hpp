#pragma once

#include "arm/arm.hpp"
#include "arm/sensor.hpp"

#include <Eigen/Core>

#include <complex>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flexarm::diagnose {

/// Where a force that the model lacks may act.
enum class ForcePort {
  hub,     ///< a torque on the hub
  root,    ///< a rotation between hub and beam
  beam,    ///< a transverse force, or a rotation between the beam's parts, inside the beam
  tip,     ///< a transverse force or a moment at the tip
  sensor,  ///< an error of one sensor's reading, or of the hub's angle and velocity together
};
/// "hub", "root", "beam", "tip", "sensor".
std::string_view to_string(ForcePort port);

/// A small term of the linear arm at a place: `term(arm, size)` is the arm with it. It answers the
/// motion y of its place by the force -z y, z = size s^power.
struct PlacedTerm {
  std::function<arm::Arm(const arm::Arm& arm, double size)> term;
  double size = 0.0;  ///< small beside the arm's own
  int power = 0;      ///< 2 for a mass and an inertia, 0 for a compliance
};

/// One way in which a force may act: on the hub, on sensors, at a place, or spread along the beam.
struct ForcePlace {
  ForcePort port = ForcePort::hub;
  std::string what;                       ///< "torque on the hub", "force at 0.192 m"
  std::string unit;                       ///< of the force: "N m", "rad", "N", the sensor's
  std::vector<arm::Sensor> sensors = {};  ///< that err; ForcePort::sensor
  double part = 0.0;                      ///< of the beam's length that it is from the root
  PlacedTerm placed = {};                 ///< ForcePort::root, tip, beam at a place
  /// Weights of other places, by their indices in the list, the forces at which are in proportion
  /// to the motion or moment there; empty but for what is spread along the beam. `unit` is then
  /// empty: such a force has no size of its own.
  std::vector<std::pair<std::size_t, double>> spread = {};
};

/// All places of an arm with a beam and these sensors. In the beam: a force and a rotation at each
/// twentieth of its length from 0.1 to 0.9; forces along it in proportion to its motion, as a wrong
/// mass makes them, and rotations in proportion to its curvature, as a wrong stiffness does, each
/// even and growing linearly from root to tip. Left out is what the arm cannot carry: a second
/// rotation inside the beam.
std::vector<ForcePlace> force_places(const arm::Arm& arm, std::span<const arm::Sensor> sensors);

/// What the sensors of one arm read per unit of force at its ports, on lines f, with the linear
/// part of the arm's sensor effects. By exact_tf, so that no mode is left out.
///
/// A force at a place is had from a term that acts there. With H(s) the responses to the hub
/// torque, u(s) those to a unit force at the place, v(s) the place's motion per hub torque, and
/// g(s) that per force at the place, the arm with the term has the responses
///
///     H_z = H - u v/(1/z + g),                                   (Sherman and Morrison)
///
/// for a z of any size: the difference is parallel to u at each frequency, to rounding. By
/// reciprocity v is the hub angle's entry of u. So, D_z being the difference of hub angles,
///
///     v^2 = -(1/z_1 - 1/z_2)/(1/D_1 - 1/D_2),     u = v (H_z - H)/D_z,
///
/// up to a sign, which is the same at every sensor. A compliance has the moment there in the place
/// of the motion, and u is per rotation imposed. Under gravity a mass has weight, and this is
/// approximate. What is spread is the sum of w u v over its places, w the weight times the spacing
/// of the places: to first order, for the motion that the hub torque makes.
class PortResponses {
 public:
  /// `arm` has the run's payload and a beam; effects that are not linear are left out. Throws
  /// InputError for an arm that cannot be computed.
  PortResponses(const arm::Arm& arm, std::vector<arm::Sensor> sensors,
                std::vector<double> frequency_Hz);

  /// For each of `places` sensors x lines, of the sensors' units per unit of the place's force.
  std::vector<Eigen::MatrixXcd> operator()(std::span<const ForcePlace> places) const;
  /// Sensors x lines, per commanded torque: the linear part of the torque's path included.
  Eigen::MatrixXcd of_command() const;

 private:
  // Without sensor effects; the hub angle in a row behind the sensors.
  Eigen::MatrixXcd to_hub_torque(const arm::Arm& arm) const;
  Eigen::MatrixXcd to_placed(const PlacedTerm& placed) const;

  Eigen::MatrixXcd of_sensor_error(const ForcePlace& place) const;
  std::complex<double> s(Eigen::Index line) const;

  arm::Arm arm_;
  std::vector<arm::Sensor> sensors_;
  std::vector<double> frequency_Hz_;
  Eigen::MatrixXcd bare_;
  Eigen::MatrixXcd chains_;    // sensors x lines
  Eigen::VectorXcd actuator_;  // a line each
};

}  // namespace flexarm::diagnose
