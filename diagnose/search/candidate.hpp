#pragma once

#include "diagnose/search/hypothesis.hpp"

#include <Eigen/Core>

#include <set>
#include <string>
#include <vector>

namespace flexarm::diagnose {

/// An arm with some effects, none or several, at definite values: what is fitted.
struct Candidate {
  std::vector<Hypothesis> effects = {};
  std::vector<double> values = {};  ///< of all their parameters, effect after effect
  /// How many of their standard deviations the arm's uncertain numbers are off
  /// (arm::with_deviations).
  std::vector<double> nuisances = {};

  arm::Arm extend(const arm::Arm& arm) const;
  std::vector<SearchedParameter> parameters() const;

  /// What is fitted: nuisances, then values as places between their bounds
  /// (SearchedParameter::coordinate), and back; places beyond `kBeyond` outside 0 to 1 are taken
  /// for those.
  Eigen::VectorXd coordinates() const;
  void put(const Eigen::VectorXd& places);
  static constexpr double kBeyond = 0.25;

  /// "payload_mass + time_delay"; "nothing".
  std::string label() const;
  /// What the effects are, in whatever order: sensor_lag is another on each sensor.
  std::set<std::string> labels() const;
  /// That effect, on that sensor where it acts on one.
  bool has(const Hypothesis& hypothesis) const;
  /// That effect on whichever sensor: an arm has each effect once.
  bool has_effect(const std::string& effect) const;
  /// With one effect more, at these values; without the `index`-th.
  Candidate with(const Hypothesis& hypothesis, const std::vector<double>& its_values) const;
  Candidate without(std::size_t index) const;
  /// Returns how many parameters the effects before the `index`-th have.
  std::size_t values_before(std::size_t index) const;
  /// The values of the `index`-th effect alone.
  std::vector<double> values_of(std::size_t index) const;
};

}  // namespace flexarm::diagnose
