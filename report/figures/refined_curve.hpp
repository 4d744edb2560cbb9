#pragma once

#include "report/figures/figure.hpp"

#include <complex>
#include <functional>
#include <vector>

namespace flexarm::report {

struct ResponseCurve {
  std::vector<double> frequency_Hz;
  std::vector<std::complex<double>> response;
};

/// A response at frequencies that draw it: evenly spaced on the axis' scale, and halved on between
/// neighbours whose values differ by more than a tenth of the larger one, some ten times at most.
/// A lightly damped pole or zero turns the value between two points, so that none is passed over
/// unless a pole and a zero lie in one of a thousand steps together. 0 < from < to.
ResponseCurve refined_curve(const std::function<std::complex<double>(double frequency_Hz)>& value,
                            double from_Hz, double to_Hz, Scale scale);

}  // namespace flexarm::report
