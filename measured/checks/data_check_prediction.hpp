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

/// Reading less prediction, and the share of each regressor.
struct Regression {
  Eigen::VectorXd left;
  Eigen::VectorXd shares;
};

/// Least squares over samples [first, first + rows) of a signal.
Regression regress(const std::vector<Eigen::VectorXd>& values, std::size_t self,
                   const std::vector<Lagged>& regressors, Eigen::Index first, Eigen::Index rows);

}  // namespace flexarm::measured
