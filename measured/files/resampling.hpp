#pragma once

#include <vector>

namespace flexarm::measured {

/// Values of a signal at other times, ascending and within those of its samples; `times_s` ascend,
/// two or more.

/// Of a signal that is held from sample to sample: its mean over each step of `period_s` from
/// there, which keeps its integral.
std::vector<double> held_means(const std::vector<double>& times_s,
                               const std::vector<double>& values, const std::vector<double>& at_s,
                               double period_s);

/// Of a signal that is linear between samples.
std::vector<double> linear_values(const std::vector<double>& times_s,
                                  const std::vector<double>& values,
                                  const std::vector<double>& at_s);

/// Of a smooth signal: the cubic through the four nearest samples (Lagrange's form), where samples
/// closer than 0.3 of `period_s` count as one, their mean.
std::vector<double> cubic_values(const std::vector<double>& times_s,
                                 const std::vector<double>& values, const std::vector<double>& at_s,
                                 double period_s);

}  // namespace flexarm::measured
