#pragma once

#include "measured/checks/data_check_signal.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace flexarm::measured {

/// Each signal less its mean, in its standard deviations.
std::vector<Eigen::VectorXd> standardised(std::span<const CheckedSignal> signals);

/// What a sample is predicted from: a signal `lag` samples later.
struct Lagged {
  std::size_t signal = 0;
  int lag = 0;
};

/// How many samples on either side predict one.
struct Reach {
  int own = 0;
  int torque = 0;
  int others = 0;
  bool others_at_once = true;  ///< whether the other sensors at the same sample do
};

/// What a sample of the signal `self` is predicted from: usable signals around it, itself without
/// this sample. `reach.torque` is of another signal than the torque.
std::vector<Lagged> regressors_around(std::size_t self, const std::vector<bool>& usable,
                                      const Reach& reach);

/// Reading less prediction, and the share of each regressor.
struct Regression {
  Eigen::VectorXd left;
  Eigen::VectorXd shares;
};

/// Least squares over samples [first, first + rows) of a signal.
Regression regress(const std::vector<Eigen::VectorXd>& values, std::size_t self,
                   const std::vector<Lagged>& regressors, Eigen::Index first, Eigen::Index rows);

}  // namespace flexarm::measured
