#include "response/frequency/response_study.hpp"

#include "arm/input_error.hpp"
#include "arm/rigid_hub.hpp"
#include "response/arm_parts.hpp"
#include "response/frequency/continuous_phase.hpp"
#include "response/frequency/modal_response.hpp"
#include "response/residual_mode.hpp"
#include "response/settings.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace flexarm::response {

namespace {

using Complex = std::complex<double>;

constexpr double kBelowFirstPole = 20.0;
constexpr double kBelowLowestPole = 5.0;

/// Decades around the corner of a hub without a beam: where its friction or its spring ends to act.
FrequencyGrid grid_of_hub(const AnyFormulation& formulation, const ResponseOptions& options) {
  constexpr double kDecades = 100.0;
  const double corner = std::abs(damped_poles(formulation, 1).lowest.second_rad_per_s);
  const double middle_Hz = corner > 0.0 ? corner / (2.0 * std::numbers::pi) : 1.0;
  FrequencyGrid grid;
  grid.from_Hz = options.from_Hz.value_or(middle_Hz / kDecades);
  grid.to_Hz = options.to_Hz.value_or(middle_Hz * kDecades);
  grid.points = options.points;
  return grid;
}

/// How many flexible poles it takes to have all below `to_Hz`.
int poles_up_to(const AnyFormulation& formulation, const ResponseOptions& options, double to_Hz) {
  int count = options.modes;
  while (count < kMostFeatures) {
    const auto known = poles(formulation, count).omega_rad_per_s;
    if (std::ssize(known) < count || known.back() > 2.0 * std::numbers::pi * to_Hz) break;
    count = std::min(2 * count, kMostFeatures);
  }
  return count;
}

std::vector<double> frequencies(const AnyFormulation& formulation, const ResponseOptions& options,
                                const ResponseStudy& study, const FrequencyGrid& grid) {
  if (!options.frequency_Hz.empty()) return options.frequency_Hz;
  std::vector<Complex> features = {study.damped_poles.lowest.first_rad_per_s};
  for (const auto& pair : study.damped_poles.flexible) features.push_back(pair.first_rad_per_s);
  const int count = static_cast<int>(study.damped_poles.flexible.size());
  if (count == 0) return refined_frequencies(grid, features);  // a rigid hub has no zeros
  for (const auto& sensor : options.sensors) {
    for (const auto& zero : zeros(formulation, sensor, count).s_rad_per_s) {
      if (zero.real() == 0.0) features.push_back(zero);
    }
  }
  return refined_frequencies(grid, features);
}

/// Gives both responses of a study their phases.
void add_phases(const AnyFormulation& formulation, const ResponseOptions& options,
                ResponseStudy& study) {
  const auto& frequency_Hz = study.response.frequency_Hz;
  int count = poles_up_to(formulation, options, frequency_Hz.back());
  const auto known = static_cast<int>(poles(formulation, count).omega_rad_per_s.size());
  if (known > 0) count = std::min(count, known);
  for (std::size_t k = 0; k < options.sensors.size(); ++k) {
    const auto reference = phase_reference(product_factors(formulation, options.sensors[k], count),
                                           study.chain, arm_of(formulation).damping.kelvin_voigt_s);
    for (auto* response :
         {&study.response, study.state_space_response ? &*study.state_space_response : nullptr}) {
      if (response == nullptr) continue;
      response->phase_deg.push_back(
          continuous_phase_deg(reference, frequency_Hz, response->values[k]));
    }
  }
}

FrequencyResponse response_of(const StateSpace& system, const std::vector<double>& frequency_Hz,
                              const FrequencyDone& done) {
  FrequencyResponse response;
  response.frequency_Hz = frequency_Hz;
  response.sensors = system.sensors;
  response.values.resize(system.sensors.size());
  for (const double frequency : frequency_Hz) {
    const auto outputs = frequency_response(system, on_imaginary_axis(frequency));
    for (std::size_t k = 0; k < outputs.size(); ++k) response.values[k].push_back(outputs[k]);
    done();
  }
  return response;
}

}  // namespace

FrequencyGrid frequency_range(const AnyFormulation& formulation, const ResponseOptions& options) {
  if (!arm::has_beam(arm_of(formulation))) return grid_of_hub(formulation, options);
  // The pole beyond those asked for, where the model has one.
  const auto pole_set = poles(formulation, options.modes + 1);
  const auto& known = pole_set.omega_rad_per_s;
  const bool has_next = std::ssize(known) > options.modes;
  const double last =
      has_next ? std::sqrt(known.back() * known[known.size() - 2]) : 1.2 * known.back();
  double lowest = known.front() / kBelowFirstPole;
  if (pole_set.lowest_omega_squared_rad2_per_s2 > 0.0) {
    lowest =
        std::min(lowest, std::sqrt(pole_set.lowest_omega_squared_rad2_per_s2) / kBelowLowestPole);
  }
  FrequencyGrid grid;
  grid.from_Hz = options.from_Hz.value_or(lowest / (2.0 * std::numbers::pi));
  grid.to_Hz = options.to_Hz.value_or(last / (2.0 * std::numbers::pi));
  grid.points = options.points;
  return grid;
}

int roots_needed(const arm::Arm& arm, const ResponseOptions& options) {
  if (!arm::has_beam(arm)) return options.modes + 1;
  const bool is_chosen = options.state_space && !options.state_space_modes;
  const int least = is_chosen ? kMostRoots : options.modes + 1;
  // Poles that a soft root, a crack, masses on the beam and shear bring down or add at most.
  constexpr int kSofter = 5;
  constexpr double kMost = 1e9;
  double highest_Hz = options.to_Hz.value_or(0.0);
  if (!options.frequency_Hz.empty()) highest_Hz = options.frequency_Hz.back();
  const double lambda = std::sqrt(std::max(0.0, 2.0 * std::numbers::pi * highest_Hz) /
                                  arm::omega_scale_rad_per_s(arm));
  const double below = std::min(std::ceil(lambda / std::numbers::pi), kMost);
  return std::max(least, static_cast<int>(below) + kSofter);
}

ResponseStudy study_response(const arm::Arm& arm, const AnyFormulation& formulation,
                             const ResponseOptions& options) {
  arm::require_count(options.modes);
  for (const auto& sensor : options.sensors) arm::require_valid(sensor, arm);
  const auto grid = frequency_range(formulation, options);
  if (options.frequency_Hz.empty()) {
    logarithmic_frequencies(grid);  // throws for limits that make no grid
  } else {
    require_ascending(options.frequency_Hz, "frequency");
  }

  ResponseStudy study;
  study.left_out = nonlinear_effects(arm);
  study.chain = linear_chain(take_apart(arm));
  std::erase_if(study.chain.sensor_chains, [&](const SensorChain& chain) {
    return std::ranges::find(options.sensors, chain.sensor) == options.sensors.end();
  });
  study.poles = poles(formulation, options.modes);
  study.damped_poles = damped_poles(formulation, poles_up_to(formulation, options, grid.to_Hz));
  study.modes = modal_model(formulation, options.modes, options.sensors, {});
  for (std::size_t k = 0; k < options.sensors.size(); ++k) {
    study.products.push_back(product_factors(formulation, options.sensors[k], options.modes));
    study.fractions.push_back(partial_fractions(study.modes, k));
  }
  const auto frequency_Hz = frequencies(formulation, options, study, grid);
  const auto all = static_cast<double>((options.state_space ? 2 : 1) * frequency_Hz.size());
  std::size_t computed = 0;
  const FrequencyDone done = [&] {
    ++computed;
    if (options.progress) options.progress(static_cast<double>(computed) / all);
  };
  study.response =
      frequency_response(formulation, study.chain, options.sensors, frequency_Hz, done);
  for (const auto& sensor : options.sensors) {
    study.resonances.push_back(resonances(formulation, study.chain, sensor, study.damped_poles,
                                          frequency_Hz.front(), frequency_Hz.back()));
  }
  if (!options.state_space) {
    add_phases(formulation, options, study);
    return study;
  }
  const auto judged_Hz = options.frequency_Hz.empty()
                             ? judged_frequencies_Hz(grid.from_Hz, grid.to_Hz)
                             : options.frequency_Hz;
  study.truncation =
      truncation_in_frequency(formulation, options.sensors, judged_Hz, options.static_correction,
                              {options.state_space_modes, most_chosen_modes(name(formulation))});
  auto model = modal_model(formulation, study.truncation->modes, options.sensors, {});
  study.truncation->modes = static_cast<int>(model.modes.size()) - 1;
  if (options.static_correction) {
    model = with_residual_mode(formulation, model, options.sensors);
    study.residual_mode = std::ssize(model.modes) > study.truncation->modes + 1;
  }
  study.state_space = state_space(model, options.sensors, study.chain);
  study.state_space_response = response_of(*study.state_space, frequency_Hz, done);
  add_phases(formulation, options, study);
  return study;
}

std::vector<StateSpaceError> state_space_errors(const ResponseStudy& study) {
  std::vector<StateSpaceError> errors;
  if (!study.state_space_response) return errors;
  for (std::size_t k = 0; k < study.response.values.size(); ++k) {
    std::vector<double> relative;
    StateSpaceError found;
    for (std::size_t i = 0; i < study.response.frequency_Hz.size(); ++i) {
      const Complex exact = study.response.values[k][i];
      const double error =
          std::abs(study.state_space_response->values[k][i] - exact) / std::abs(exact);
      if (!std::isfinite(error)) continue;
      relative.push_back(error);
      if (error < found.largest) continue;
      found.largest = error;
      found.largest_at_Hz = study.response.frequency_Hz[i];
    }
    std::ranges::sort(relative);
    if (!relative.empty()) found.median = relative[relative.size() / 2];
    errors.push_back(found);
  }
  return errors;
}

}  // namespace flexarm::response
