#include "export/samples/sampled_state_space.hpp"

#include "arm/input_error.hpp"
#include "response/formulation_maker.hpp"
#include "response/frequency/response_study.hpp"
#include "response/linear_chain.hpp"
#include "response/residual_mode.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tbb/parallel_for.h>

namespace flexarm::samples {

namespace {

using Eigen::Index;
using response::StateSpace;

response::Truncation truncation_of(const arm::Arm& arm, const StateSpaceSettings& settings) {
  response::ResponseOptions options;
  options.sensors = settings.sensors;
  const int roots = settings.modes.value_or(response::most_chosen_modes(settings.formulation)) + 1;
  const auto formulation = response::make_formulation(settings.formulation, arm, roots);
  const auto band = response::frequency_range(formulation, options);
  return response::truncation_in_frequency(
      formulation, settings.sensors, response::judged_frequencies_Hz(band.from_Hz, band.to_Hz),
      settings.static_correction,
      {settings.modes, response::most_chosen_modes(settings.formulation)});
}

StateSpace state_space_of(const arm::Arm& arm, const StateSpaceSettings& settings, int modes) {
  const response::ArmParts parts = response::take_apart(arm);
  const int roots = modes + (settings.static_correction ? 1 : 0);
  const auto formulation = response::make_formulation(settings.formulation, arm, roots);
  arm::ModalModel model = response::modal_model(formulation, modes, settings.sensors, {});
  if (settings.static_correction) {
    model = response::with_residual_mode(formulation, model, settings.sensors);
  }
  return response::state_space(model, settings.sensors, response::linear_chain(parts));
}

/// The system with these states, which contain its own.
StateSpace with_states(const StateSpace& system, const std::vector<std::string>& states) {
  const Index n = std::ssize(states);
  StateSpace made = system;
  made.states = states;
  made.a = -Eigen::MatrixXd::Identity(n, n);
  made.b = Eigen::MatrixXd::Zero(n, 1);
  made.c = Eigen::MatrixXd::Zero(system.c.rows(), n);
  std::vector<Index> places;
  for (const std::string& state : system.states) {
    places.push_back(std::ranges::find(states, state) - states.begin());
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto from = static_cast<Index>(i);
    for (std::size_t j = 0; j < places.size(); ++j) {
      made.a(places[i], places[j]) = system.a(from, static_cast<Index>(j));
    }
    made.b.row(places[i]) = system.b.row(from);
    made.c.col(places[i]) = system.c.col(from);
  }
  return made;
}

}  // namespace

SampledStateSpace state_spaces(const ArmSamples& samples, const StateSpaceSettings& settings,
                               const std::function<void()>& advance) {
  SampledStateSpace made;
  made.systems.resize(samples.samples.size());
  const arm::Arm& nominal = samples.samples.front().arm;
  for (const arm::Sensor& sensor : settings.sensors) arm::require_responsive(sensor, nominal);
  made.truncation = truncation_of(nominal, settings);
  tbb::parallel_for(std::size_t{0}, samples.samples.size(), [&](std::size_t k) {
    const arm::Arm& arm = samples.samples[k].arm;
    try {
      for (const arm::Sensor& sensor : settings.sensors) arm::require_responsive(sensor, arm);
      made.systems[k] = state_space_of(arm, settings, made.truncation.modes);
    } catch (const arm::InputError& error) {
      if (k == 0) throw;
      throw arm::InputError(fmt::format("sample {}: {}", k, error.what()), error.key());
    }
    if (advance) advance();
  });
  for (const StateSpace& system : made.systems) {
    for (const std::string& state : system.states) {
      if (std::ranges::find(made.states, state) == made.states.end()) made.states.push_back(state);
    }
  }
  for (StateSpace& system : made.systems) {
    if (system.states != made.states) system = with_states(system, made.states);
  }
  return made;
}

}  // namespace flexarm::samples
