#pragma once

#include "arm/arm.hpp"

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace flexarm::samples {

/// The marginal distribution of a number of the arm or a parameter of an effect.
struct Marginal {
  std::string key;  ///< "beam.youngs_modulus", "effects.coulomb_friction.torque"
  double value = 0.0;
  double std_error = 0.0;
  std::string unit;
  bool is_logarithmic = false;  ///< its logarithm is normal, of deviation std_error/|value|
};

/// What the arm may be: one set of effects, with the joint distribution of its parameters.
struct ArmDistribution {
  std::string effects;  ///< those identified: "coulomb_friction + time_delay"; may be empty
  arm::Arm arm;         ///< at the values of the marginals
  double probability = 1.0;
  std::vector<Marginal> marginals;
  Eigen::MatrixXd correlation;  ///< of the logarithms where these are normal
};

/// The nominal arm first; probabilities sum up to 1.
struct ParameterPosterior {
  std::vector<ArmDistribution> sets;
  std::vector<std::string> left_out = {};  ///< why the arm cannot be given some other sets
};

/// Of the uncertainties that an arm file states: independent, log-normal.
ParameterPosterior posterior_of(const arm::Arm& arm);

/// Returns the posterior of a diagnosis (`flexarm.diagnosis/3`) and its extended arm. Numbers that
/// it did not estimate have the uncertainty that the arm states. Throws InputError for a document
/// without that key, and nlohmann::json::exception for one of another form.
ParameterPosterior posterior_of(const nlohmann::json& diagnosis, const arm::Arm& extended_arm);

/// Gives the arm another value of such a number. Throws InputError for a number that it does not
/// have, and a value that is out of its range.
void put_number(arm::Arm& arm, const std::string& key, double value);

}  // namespace flexarm::samples
