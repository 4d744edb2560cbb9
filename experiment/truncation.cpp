#include "experiment/truncation.hpp"

#include "response/frequency/frequency_response.hpp"
#include "response/frequency/modal_response.hpp"
#include "response/time/arm_simulator.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <span>

namespace flexarm::experiment {

namespace {

/// The torque of a run from its first one on, or the reference of its loop.
std::span<const double> estimated_part(const PlannedRun& run) {
  if (run.controller) {
    const std::span<const double> reference = run.reference.values;
    return reference.first(std::min(reference.size(), kEstimatedSamples));
  }
  const std::span<const double> torque = run.torque.torque_N_m;
  const auto first = std::ranges::find_if(torque, [](double value) { return value != 0.0; });
  const auto after = torque.subspan(static_cast<std::size_t>(first - torque.begin()));
  return after.first(std::min(after.size(), kEstimatedSamples));
}

/// Readings of the beginning of a time run, a row a sample and a column a sensor.
Eigen::MatrixXd readings(const PlannedRun& run, const PayloadModel& model,
                         const std::vector<arm::Sensor>& sensors,
                         const response::SimulationOptions& stepping) {
  const response::ArmSimulator simulator(model.model, model.parts, sensors, stepping);
  const auto part = estimated_part(run);
  if (part.empty()) return {};
  if (!run.controller) return simulator.readings(part);
  return simulator.closed_loop_readings({*run.controller, {part.begin(), part.end()}}).readings;
}

std::vector<double> truncation_in_time(const PlannedRun& run, const PayloadModel& coarse,
                                       const PayloadModel& fine,
                                       const std::vector<arm::Sensor>& sensors,
                                       const response::SimulationOptions& stepping) {
  const Eigen::MatrixXd few = readings(run, coarse, sensors, stepping);
  const Eigen::MatrixXd many = readings(run, fine, sensors, stepping);
  std::vector<double> errors(sensors.size(), 0.0);
  if (few.size() == 0) return errors;
  for (std::size_t k = 0; k < sensors.size(); ++k) {
    const auto column = [&](const Eigen::MatrixXd& all) {
      return std::span(all.col(static_cast<Eigen::Index>(k)).data(),
                       static_cast<std::size_t>(all.rows()));
    };
    errors[k] = response::truncation_estimate(column(few), column(many));
  }
  return errors;
}

/// ||G_n - G||/||G|| over the frequencies of a stepped sine, a pole of an undamped arm left out.
std::vector<double> truncation_of_sine(const response::SteppedSine& sine,
                                       const PayloadModel& model,
                                       const std::vector<arm::Sensor>& sensors) {
  std::vector<double> difference(sensors.size(), 0.0);
  std::vector<double> size(sensors.size(), 0.0);
  for (const double frequency_Hz : frequencies_Hz(sine)) {
    const auto s = response::on_imaginary_axis(frequency_Hz);
    const auto exact = response::transfer_functions(model.chosen.formulation, sensors, s);
    const auto modal = response::modal_response(model.model, sensors, s);
    for (std::size_t k = 0; k < sensors.size(); ++k) {
      if (!std::isfinite(std::abs(exact[k])) || !std::isfinite(std::abs(modal[k]))) continue;
      difference[k] += std::norm(modal[k] - exact[k]);
      size[k] += std::norm(exact[k]);
    }
  }
  std::vector<double> errors;
  for (std::size_t k = 0; k < sensors.size(); ++k) {
    errors.push_back(difference[k] == 0.0 ? 0.0 : std::sqrt(difference[k] / size[k]));
  }
  return errors;
}

}  // namespace

std::vector<double> truncation(const std::vector<PlannedRun>& runs, PayloadModels& models,
                               int modes, response::SimulationOptions stepping) {
  const auto& sensors = models.sensors();
  std::vector<double> largest(sensors.size(), 0.0);
  for (const auto& run : runs) {
    const PayloadModel& coarse = models.of(run.payload, modes);
    std::vector<double> errors;
    if (run.stepped_sine) {
      errors = truncation_of_sine(*run.stepped_sine, coarse, sensors);
    } else {
      stepping.sample_time_s = run.time_s.at(1) - run.time_s.at(0);
      errors = truncation_in_time(run, coarse, models.of(run.payload, 2 * modes), sensors, stepping);
    }
    std::ranges::transform(errors, largest, largest.begin(),
                           [](double error, double most) { return std::max(error, most); });
  }
  return largest;
}

response::ModeChoice needed_modes(const std::vector<PlannedRun>& runs, PayloadModels& models,
                                  const response::SimulationOptions& stepping,
                                  const std::function<void(int modes)>& trying) {
  // Twice as many modes, and one more for the residual mode.
  const int most =
      std::min(response::kMostChosenModes, (models.formulation().most_roots() - 1) / 2);
  const std::vector<double> tolerance(models.sensors().size(), response::kTruncationTolerance);
  return response::choose_modes(
      [&](int modes) {
        if (trying) trying(modes);
        return truncation(runs, models, modes, stepping);
      },
      tolerance, most);
}

}  // namespace flexarm::experiment
