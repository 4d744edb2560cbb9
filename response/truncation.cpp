#include "response/truncation.hpp"

#include "arm/rigid_hub.hpp"
#include "response/formulation_maker.hpp"
#include "response/frequency/frequency_grid.hpp"
#include "response/frequency/frequency_response.hpp"
#include "response/frequency/modal_response.hpp"
#include "response/residual_mode.hpp"
#include "response/settings.hpp"
#include "response/time/single_modes.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>

namespace flexarm::response {

namespace {

using Eigen::Index;

/// Errors of keeping 0, 1, ... flexible modes of `model`: a row a number, a column a sensor.
Eigen::MatrixXd errors_in_time(const arm::ModalModel& model, std::span<const arm::Sensor> sensors,
                               std::span<const double> torque_N_m, double period_s,
                               TorqueHold hold) {
  const auto modes = static_cast<Index>(model.modes.size());
  const auto outputs = static_cast<Index>(sensors.size());
  std::vector<std::vector<double>> sums(sensors.size(), std::vector<double>(torque_N_m.size()));
  Eigen::MatrixXd sizes(modes + 1, outputs);
  sizes.row(modes).setZero();
  for (Index i = modes; i-- > 0;) {
    add_readings_of_mode(sums, model, static_cast<std::size_t>(i), sensors, torque_N_m, period_s,
                         hold);
    for (Index j = 0; j < outputs; ++j) {
      const auto& sum = sums[static_cast<std::size_t>(j)];
      sizes(i, j) = Eigen::VectorXd::Map(sum.data(), std::ssize(sum)).norm();
    }
  }
  // With n flexible modes kept, those from n + 1 on are left out.
  Eigen::MatrixXd errors = sizes.bottomRows(modes);
  for (Index j = 0; j < outputs; ++j) {
    if (sizes(0, j) > 0.0) errors.col(j) /= sizes(0, j);
  }
  return errors;
}

std::vector<double> row_of(const Eigen::MatrixXd& errors, Index row) {
  const Eigen::VectorXd values = errors.row(row);
  return {values.begin(), values.end()};
}

/// The fewest modes from `fewest` to `most` with which no error is above `tolerance`, or the most
/// that there are.
int fewest_within(const Eigen::MatrixXd& errors, double tolerance, int fewest, int most) {
  const int last = std::min(most, static_cast<int>(errors.rows()) - 1);
  int modes = fewest;
  while (modes < last && (errors.row(modes).array() > tolerance).any()) ++modes;
  return modes;
}

/// The samples from the first torque on.
std::span<const double> judged_samples(std::span<const double> torque_N_m) {
  const auto first = std::ranges::find_if(torque_N_m, [](double value) { return value != 0.0; });
  const auto from = torque_N_m.subspan(static_cast<std::size_t>(first - torque_N_m.begin()));
  return from.first(std::min(from.size(), kMostJudgedSamples));
}

/// So many times as many modes as are kept are known, for the tail of those left out.
constexpr int kTail = 4;

/// One of 1, 2, 3, 4, 6, 8, 12, 16, 24, ...: residual modes take some milliseconds each.
int next_count(int count) {
  if (count < 4) return count + 1;
  int power = 1;
  while (2 * power <= count) power *= 2;
  return count == power ? count + power / 2 : 2 * power;
}

}  // namespace

double Truncation::largest_error() const {
  return errors.empty() ? 0.0 : *std::ranges::max_element(errors);
}

int most_chosen_modes(std::string_view formulation) {
  return formulation == exact_tf::ExactArm::kName ? kMostChosenModes
                                                  : std::min(kMostChosenModes, kMostRoots - 1);
}

Truncation truncation_in_time(const arm::Arm& arm, std::span<const arm::Sensor> sensors,
                              std::span<const double> torque_N_m, double period_s, TorqueHold hold,
                              const ModeCount& count) {
  const AnyFormulation formulation = formulation_of_fit(arm);
  Truncation made{count.given.value_or(1), std::vector<double>(sensors.size(), 0.0), !count.given};
  if (!arm::has_beam(arm_of(formulation))) return made;
  const auto judged = judged_samples(torque_N_m);
  constexpr int kFirst = 32;  // modes
  const int needed = count.given.value_or(count.most);
  const int most_known =
      std::max({kFirst, std::min(kTail * needed, kTail * kMostChosenModes), 2 * needed});
  for (int known = count.given ? most_known : kFirst;; known = std::min(2 * known, most_known)) {
    const auto model = modal_model(formulation, known, sensors, {});
    const Eigen::MatrixXd errors = errors_in_time(model, sensors, judged, period_s, hold);
    const int last = static_cast<int>(errors.rows()) - 1;
    const int modes = std::min(count.given.value_or(fewest_within(errors, kTruncationTolerance,
                                                                  kFewestChosenModes, count.most)),
                               std::max(last, 1));
    if (!count.given && kTail * modes > known && known < most_known && known <= last) continue;
    made.modes = modes;
    if (modes > last) return made;
    made.errors = row_of(errors, modes);
    const auto visible = static_cast<std::size_t>(fewest_within(errors, kVisiblePart, 0, modes));
    made.visible_Hz = model.modes[visible].omega_rad_per_s / (2.0 * std::numbers::pi);
    return made;
  }
}

bool is_linear(const ArmParts& parts) {
  return parts.hub.friction.empty() && parts.hub.smooth.empty() && parts.beam_forces.empty();
}

int affordable_modes(const ArmParts& parts, std::size_t samples, int least, int most) {
  constexpr double kProducts = 4e9;
  constexpr double kOfNonlinearArm = 1e9;
  const double states = std::sqrt((is_linear(parts) ? kProducts : kOfNonlinearArm) /
                                  std::max(1.0, static_cast<double>(samples)));
  return static_cast<int>(
      std::clamp(states / 2.0, static_cast<double>(least), static_cast<double>(most)));
}

Truncation truncation_in_frequency(const AnyFormulation& formulation,
                                   std::span<const arm::Sensor> sensors,
                                   std::span<const double> frequency_Hz, bool static_correction,
                                   const ModeCount& count) {
  Truncation made{count.given.value_or(1), std::vector<double>(sensors.size(), 0.0), !count.given};
  if (!arm::has_beam(arm_of(formulation))) return made;
  std::vector<std::vector<std::complex<double>>> whole;
  for (const double frequency : frequency_Hz) {
    whole.push_back(transfer_functions(formulation, sensors, on_imaginary_axis(frequency)));
  }
  for (int modes = count.given.value_or(kFewestChosenModes);;
       modes = std::min(next_count(modes), count.most)) {
    arm::ModalModel model = modal_model(formulation, modes, sensors, {});
    const bool is_last = static_cast<int>(model.modes.size()) - 1 < modes;
    if (static_correction) model = with_residual_mode(formulation, model, sensors);
    std::vector<double> sums(sensors.size(), 0.0);
    std::vector<double> counted(sensors.size(), 0.0);
    for (std::size_t f = 0; f < whole.size(); ++f) {
      const auto at = modal_response(model, sensors, on_imaginary_axis(frequency_Hz[f]));
      for (std::size_t k = 0; k < at.size(); ++k) {
        const double error = std::abs(at[k] - whole[f][k]) / std::abs(whole[f][k]);
        if (!std::isfinite(error)) continue;
        sums[k] += error * error;
        counted[k] += 1.0;
      }
    }
    for (std::size_t k = 0; k < sums.size(); ++k) {
      made.errors[k] = counted[k] > 0.0 ? std::sqrt(sums[k] / counted[k]) : 0.0;
    }
    made.modes = modes;
    if (count.given || is_last || modes >= count.most || made.is_within_tolerance()) return made;
  }
}

std::vector<double> judged_frequencies_Hz(double from_Hz, double to_Hz) {
  constexpr int kPoints = 60;
  return logarithmic_frequencies({.from_Hz = from_Hz, .to_Hz = to_Hz, .points = kPoints});
}

}  // namespace flexarm::response
