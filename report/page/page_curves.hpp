#pragma once

#include "report/page/page_document.hpp"

#include <complex>
#include <cstddef>
#include <string>
#include <vector>

namespace flexarm::report::page {

/// Evenly sampled numbers over their time.
Record record_of(const std::vector<double>& time_s, const std::vector<double>& values);

/// Whether any of them is finite.
bool has_number(const std::vector<double>& values);

/// The values with gaps where a logarithmic axis has no place for them.
std::vector<double> for_log_axis(std::vector<double> values);

/// The numbers in single precision, which is enough to draw them.
std::vector<float> as_singles(const std::vector<double>& values);

/// Of more than `kMostLines` lines (indices, ascending) those with the least and the greatest value
/// of each of many equal steps of the logarithm of frequency.
std::vector<std::size_t> thinned_lines(const std::vector<double>& frequency_Hz,
                                       const std::vector<double>& values,
                                       std::vector<std::size_t> lines);
inline constexpr std::size_t kMostLines = 1500;

/// A line, or points, over an axis.
Series curve(const std::string& label, Role role, std::vector<double> x, std::vector<double> y,
             Draw draw = Draw::line);

/// One response in a Bode diagram; all vectors of one length, the last two perhaps empty.
struct BodeCurve {
  std::string label;
  Role role = Role::measured;
  std::vector<double> frequency_Hz;
  std::vector<std::complex<double>> response;
  std::vector<double> relative_std = {};  ///< of |response|, and of the phase in rad
  std::vector<double> coherence = {};
};

/// Magnitude, phase and, where a curve has it, coherence. Lines at 0 Hz are left out, and in
/// magnitude and phase those that are not known (`is_known`), as where the torque has no power;
/// curves have gaps there and over frequencies that were not measured. They are thinned
/// (`thinned_lines`). `unit` is that of the response. Empty where no curve has a value.
std::vector<CurvesPanel> bode_panels(const std::string& unit, const std::vector<BodeCurve>& curves);

/// Whether something is known of a response at a line: its relative deviation, where there is one,
/// is at most `kMostRelativeStd`.
bool is_known(const std::vector<double>& relative_std, std::size_t line);
inline constexpr double kMostRelativeStd = 0.5;

/// The frequency axis of a Bode diagram.
Axis frequency_axis();

}  // namespace flexarm::report::page
