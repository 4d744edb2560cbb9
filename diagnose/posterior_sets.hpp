#pragma once

#include "diagnose/search/predicted_selection.hpp"
#include "diagnose/search/selection_options.hpp"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace flexarm::diagnose {

/// The estimate of a parameter, with its marginal distribution.
struct PosteriorParameter {
  std::string key;  ///< "effects.coulomb_friction.torque", "beam.youngs_modulus"
  double value = 0.0;
  double std_error = 0.0;  ///< as Cause and RefittedNumber have it
  std::string unit;
  /// Its logarithm is normal, of standard deviation std_error/|value|: where the fit used the
  /// logarithm. Else it is normal itself.
  bool is_logarithmic = false;
};

/// A set of effects that was fitted.
struct PosteriorSet {
  struct Effect {
    std::string name;
    std::string sensor;  ///< of an effect on one sensor
  };
  std::vector<Effect> effects;
  double probability = 0.0;  ///< posterior, of exactly this set; of all sets listed it sums up to 1
  /// Of its effects, then the uncertain numbers of the arm file.
  std::vector<PosteriorParameter> parameters;
  /// Of the estimates, in their order: of the logarithms where these are normal. By the inverse of
  /// J^T J of the fit.
  Eigen::MatrixXd correlation;
};

/// Returns the chosen set, with these standard errors, then the others by descending probability,
/// down to `kLeastSetProbability` of the sum; theirs are computed with `further_modes`
/// (standard_errors). After the deadline no further set is added.
std::vector<PosteriorSet> posterior_sets(const PredictedSelection& predicted,
                                         const std::vector<double>& errors_of_chosen,
                                         int further_modes, const Deadline& deadline);
inline constexpr double kLeastSetProbability = 0.01;

}  // namespace flexarm::diagnose
