#include "diagnose/unknown/port_responses.hpp"

#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "response/arm_parts.hpp"
#include "response/formulation_maker.hpp"
#include "response/frequency/frequency_response.hpp"
#include "response/linear_chain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <utility>

namespace flexarm::diagnose {

namespace {

using Complex = std::complex<double>;
using arm::SensorKind;
using Eigen::Index;

/// Of a term over the arm's own mass, inertia or compliance: small, so that modes stay where they
/// are; the difference that it makes keeps ten digits.
constexpr double kSmall = 1e-3;

/// Places inside the beam are kFirst to kParts - kFirst of so many parts.
constexpr int kParts = 20;
constexpr int kFirst = 2;

/// The arm with one effect more, which adds a linear term.
arm::Arm with_term(const arm::Arm& arm, std::function<void(arm::LinearTerms&)> add) {
  auto definition = std::make_shared<arm::EffectDefinition>();
  definition->name = "missing_force_probe";
  definition->linear_term = [add = std::move(add)](const arm::Effect&, const arm::Arm&,
                                                   arm::LinearTerms& terms) { add(terms); };
  arm::Arm made = arm;
  made.effects[definition->name] = {.definition = definition};
  return made;
}

PlacedTerm mass_at(double position_m, const arm::LinearArm& linear) {
  const auto term = [position_m](const arm::Arm& arm, double mass_kg) {
    return with_term(arm, [=](arm::LinearTerms& terms) {
      terms.masses.push_back({.position_m = position_m, .mass_kg = mass_kg});
    });
  };
  return {term, kSmall * linear.linear_density_kg_per_m * linear.length_m, 2};
}

PlacedTerm compliance_at(double position_m, const arm::LinearArm& linear) {
  const auto term = [position_m](const arm::Arm& arm, double compliance_rad_per_N_m) {
    return with_term(arm, [=](arm::LinearTerms& terms) {
      terms.springs.push_back(
          {.position_m = position_m, .stiffness_N_m_per_rad = 1.0 / compliance_rad_per_N_m});
    });
  };
  return {term, kSmall * linear.length_m / linear.flexural_rigidity_N_m2, 0};
}

PlacedTerm inertia_at_tip(const arm::LinearArm& linear) {
  const auto term = [](const arm::Arm& arm, double inertia_kg_m2) {
    return with_term(arm,
                     [=](arm::LinearTerms& terms) { terms.tip_inertia_kg_m2 += inertia_kg_m2; });
  };
  const double length_m = linear.length_m;
  return {term, kSmall * linear.linear_density_kg_per_m * length_m * length_m * length_m, 2};
}

bool carries(const arm::Arm& arm, const PlacedTerm& placed) {
  try {
    arm::linear_arm(placed.term(arm, placed.size));
  } catch (const arm::InputError&) {
    return false;
  }
  return true;
}

/// What is spread over all places with forces of that unit, which are in the order of their parts:
/// even, and growing from the root. Weights are those of the trapezoidal rule.
void add_spread(const std::string& what, std::string_view unit, std::vector<ForcePlace>& places) {
  std::vector<std::size_t> own;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].unit == unit) own.push_back(i);
  }
  if (own.size() < 2) return;
  ForcePlace even{ForcePort::beam, what, ""};
  ForcePlace growing{ForcePort::beam, what + ", growing from the root", ""};
  for (std::size_t i = 0; i < own.size(); ++i) {
    const double before = places[own[i > 0 ? i - 1 : i]].part;
    const double behind = places[own[i + 1 < own.size() ? i + 1 : i]].part;
    const double weight = 0.5 * (behind - before);
    even.spread.emplace_back(own[i], weight);
    growing.spread.emplace_back(own[i], weight * places[own[i]].part);
  }
  places.push_back(std::move(even));
  places.push_back(std::move(growing));
}

std::vector<ForcePlace> sensor_places(std::span<const arm::Sensor> sensors) {
  std::vector<ForcePlace> places;
  std::vector<arm::Sensor> of_hub;
  for (const arm::Sensor& sensor : sensors) {
    places.push_back({ForcePort::sensor,
                      "error of " + to_string(sensor),
                      std::string(arm::unit(sensor)),
                      {sensor}});
    if (is_collocated(sensor)) of_hub.push_back(sensor);
  }
  if (of_hub.size() > 1) {
    places.push_back(
        {ForcePort::sensor, "error of the hub angle that its sensors share", "rad", of_hub});
  }
  return places;
}

Complex raised(Complex s, int exponent) {
  Complex made = 1.0;
  for (int i = 0; i < exponent; ++i) made *= s;
  return made;
}

}  // namespace

std::string_view to_string(ForcePort port) {
  static constexpr std::array<std::string_view, 5> kNames = {"hub", "root", "beam", "tip",
                                                             "sensor"};
  return kNames.at(static_cast<std::size_t>(port));
}

std::vector<ForcePlace> force_places(const arm::Arm& arm, std::span<const arm::Sensor> sensors) {
  const arm::Arm bare = response::take_apart(arm).linear;
  const arm::LinearArm linear = arm::linear_arm(bare);
  std::vector<ForcePlace> places = {{ForcePort::hub, "torque on the hub", "N m"}};
  const auto add = [&](ForcePort port, std::string what, std::string unit, double part,
                       PlacedTerm placed) {
    if (!carries(bare, placed)) return;
    places.push_back({port, std::move(what), std::move(unit), {}, part, std::move(placed)});
  };
  const auto at_m = [&](int part) { return part * linear.length_m / kParts; };
  const auto share = [](int part) { return static_cast<double>(part) / kParts; };
  add(ForcePort::root, "rotation between hub and beam", "rad", 0.0, compliance_at(0.0, linear));
  for (int part = kFirst; part <= kParts - kFirst; ++part) {
    add(ForcePort::beam, fmt::format("rotation in the beam at {:.3g} m", at_m(part)), "rad",
        share(part), compliance_at(at_m(part), linear));
  }
  add_spread("rotations along the beam in proportion to its curvature", "rad", places);
  for (int part = kFirst; part <= kParts - kFirst; ++part) {
    add(ForcePort::beam, fmt::format("force at {:.3g} m", at_m(part)), "N", share(part),
        mass_at(at_m(part), linear));
  }
  add(ForcePort::tip, "force at the tip", "N", 1.0, mass_at(linear.length_m, linear));
  add_spread("forces along the beam in proportion to its motion", "N", places);
  add(ForcePort::tip, "moment at the tip", "N m", 1.0, inertia_at_tip(linear));
  std::ranges::move(sensor_places(sensors), std::back_inserter(places));
  return places;
}

PortResponses::PortResponses(const arm::Arm& arm, std::vector<arm::Sensor> sensors,
                             std::vector<double> frequency_Hz)
    : sensors_(std::move(sensors)), frequency_Hz_(std::move(frequency_Hz)) {
  const response::ArmParts parts = response::take_apart(arm);
  arm_ = parts.linear;
  bare_ = to_hub_torque(arm_);
  const response::LinearChain chain = response::linear_chain(parts);
  const Index lines = std::ssize(frequency_Hz_);
  chains_.resize(std::ssize(sensors_), lines);
  actuator_.resize(lines);
  for (Index k = 0; k < lines; ++k) {
    actuator_(k) = response::actuator_response(chain, s(k));
    for (Index j = 0; j < chains_.rows(); ++j) {
      chains_(j, k) =
          response::reading_response(chain, sensors_[static_cast<std::size_t>(j)], s(k));
    }
  }
}

Complex PortResponses::s(Index line) const {
  return response::on_imaginary_axis(frequency_Hz_[static_cast<std::size_t>(line)]);
}

Eigen::MatrixXcd PortResponses::to_hub_torque(const arm::Arm& arm) const {
  std::vector<arm::Sensor> sensors = sensors_;
  sensors.push_back({SensorKind::hub_angle, 0.0});
  const auto made =
      response::frequency_response(response::formulation_of_fit(arm), {}, sensors, frequency_Hz_);
  Eigen::MatrixXcd responses(std::ssize(sensors), std::ssize(frequency_Hz_));
  for (Index j = 0; j < responses.rows(); ++j) {
    responses.row(j) =
        Eigen::RowVectorXcd::Map(made.values[static_cast<std::size_t>(j)].data(), responses.cols());
  }
  return responses;
}

Eigen::MatrixXcd PortResponses::of_sensor_error(const ForcePlace& place) const {
  Eigen::MatrixXcd made = Eigen::MatrixXcd::Zero(std::ssize(sensors_), std::ssize(frequency_Hz_));
  const bool is_shared = place.sensors.size() > 1;
  for (Index j = 0; j < made.rows(); ++j) {
    const arm::Sensor& sensor = sensors_[static_cast<std::size_t>(j)];
    if (std::ranges::find(place.sensors, sensor) == place.sensors.end()) continue;
    for (Index k = 0; k < made.cols(); ++k) {
      made(j, k) = is_shared ? raised(s(k), arm::derivative_order(sensor)) : Complex(1.0);
    }
  }
  return made;
}

Eigen::MatrixXcd PortResponses::to_placed(const PlacedTerm& placed) const {
  Eigen::MatrixXcd made = to_hub_torque(placed.term(arm_, placed.size)) - bare_;
  const Eigen::MatrixXcd more = to_hub_torque(placed.term(arm_, 2.0 * placed.size)) - bare_;
  const Index hub = bare_.rows() - 1;
  for (Index k = 0; k < made.cols(); ++k) {
    const Complex z = placed.size * raised(s(k), placed.power);
    const Complex squared = -0.5 / z / (1.0 / made(hub, k) - 1.0 / more(hub, k));
    made.col(k) *= std::sqrt(squared) / made(hub, k);
  }
  return made;
}

std::vector<Eigen::MatrixXcd> PortResponses::operator()(std::span<const ForcePlace> places) const {
  const Index sensors = chains_.rows();
  std::vector<Eigen::MatrixXcd> placed(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].placed.term) placed[i] = to_placed(places[i].placed);
  }
  std::vector<Eigen::MatrixXcd> made;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].port == ForcePort::sensor) {
      made.push_back(of_sensor_error(places[i]));
      continue;
    }
    Eigen::MatrixXcd values = bare_;
    if (places[i].placed.term) values = placed[i];
    if (!places[i].spread.empty()) values.setZero();
    for (const auto& [at, weight] : places[i].spread) {
      values += weight * placed[at] * placed[at].row(sensors).asDiagonal();
    }
    made.emplace_back(values.topRows(sensors).cwiseProduct(chains_));
  }
  return made;
}

Eigen::MatrixXcd PortResponses::of_command() const {
  return bare_.topRows(chains_.rows()).cwiseProduct(chains_) * actuator_.asDiagonal();
}

}  // namespace flexarm::diagnose
