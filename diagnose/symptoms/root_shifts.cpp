#include "diagnose/symptoms/root_shifts.hpp"

#include "arm/input_error.hpp"
#include "compare/identification.hpp"
#include "diagnose/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

void add_table(const SymptomsInput& input, std::size_t run, const measured::ModalTable& table,
               std::vector<RootShift>& shifts) {
  const Observations& observations = input.problem.observations();
  const Experiment& experiment = input.problem.experiment();
  Index at = observations.first_of_run[run];
  const auto next = [&] {
    const double value = observations.values(at);
    const double deviation = observations.deviations(at);
    const RootNumber number{value, deviation, value - deviation * input.before(at),
                            value - deviation * input.after(at)};
    ++at;
    return number;
  };
  for (const ModalGroup& group : modal_groups(table)) {
    for (const std::size_t i : group.entries) {
      const auto& [own, data] = experiment.runs[run];
      RootShift shift{.run = own.id,
                      .payload_kg = arm_in(experiment, own).payload.mass_kg,
                      .zero_of = group.zeros_of,
                      .order = table[i].order.value(),
                      .frequency_Hz = {},
                      .damping_ratio = {}};
      if (table[i].frequency_Hz) shift.frequency_Hz = next();
      if (table[i].damping_ratio) shift.damping_ratio = next();
      shifts.push_back(shift);
    }
  }
}

/// The relative deviations that the diagnosis takes the responses of a run to have.
std::vector<std::vector<double>> response_deviations(const SymptomsInput& input, std::size_t run,
                                                     const measured::FrequencyRecord& record) {
  const Observations& observations = input.problem.observations();
  std::vector<std::vector<double>> made;
  Index at = observations.first_of_run[run];
  for (const auto& channel : record.channels) {
    auto& own = made.emplace_back();
    for (std::size_t k = 0; k < channel.response.size(); ++k, at += 2) {
      own.push_back(observations.deviations(at));
    }
  }
  return made;
}

std::vector<RootShift> fitted(const SymptomsInput& input, std::size_t run,
                              const measured::FrequencyRecord& record) {
  const Experiment& experiment = input.problem.experiment();
  const measured::Run& own = experiment.runs[run].run;
  measured::ModalFitOptions options;
  options.response_std = response_deviations(input, run, record);
  measured::ModalTable table;
  try {
    table = measured::modal_table(measured::fit_modes(record, options));
  } catch (const arm::InputError&) {
    return {};
  }
  std::vector<arm::Sensor> sensors;
  double top_Hz = 0.0;
  for (const auto& channel : record.channels) {
    sensors.push_back(channel.sensor);
    top_Hz = std::max(top_Hz, channel.frequency_Hz.back());
  }
  const arm::Arm arm = arm_in(experiment, own);
  arm::Arm extended = input.chosen.extend(experiment.arm);
  extended.payload = arm.payload;
  const double to_Hz = compare::needed_Hz(top_Hz);
  const auto before =
      compare::beside_analytical(table, compare::analytical_modes(arm, sensors, to_Hz));
  const auto after =
      compare::beside_analytical(table, compare::analytical_modes(extended, sensors, to_Hz));
  std::vector<RootShift> shifts;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const compare::IdentifiedRoot& root = before[i];
    const measured::ModalEntry& entry = root.measured;
    if (!root.order || !root.analytical_Hz || !entry.frequency_Hz || !entry.frequency_std_Hz) {
      continue;
    }
    RootShift shift;
    shift.run = own.id;
    shift.payload_kg = arm.payload.mass_kg;
    if (entry.feature == measured::Feature::zero) shift.zero_of = entry.sensor;
    shift.order = *root.order;
    shift.frequency_Hz =
        RootNumber{*entry.frequency_Hz,
                   std::hypot(*entry.frequency_std_Hz, kFitFrequency * *entry.frequency_Hz),
                   *root.analytical_Hz, after[i].analytical_Hz.value_or(NAN)};
    if (entry.damping_ratio && entry.damping_ratio_std && root.analytical_damping_ratio) {
      shift.damping_ratio = RootNumber{
          *entry.damping_ratio,
          std::hypot(*entry.damping_ratio_std, kFitDamping * *entry.damping_ratio),
          *root.analytical_damping_ratio, after[i].analytical_damping_ratio.value_or(NAN)};
    }
    shifts.push_back(shift);
  }
  return shifts;
}

}  // namespace

std::vector<RootShift> root_shifts(const SymptomsInput& input) {
  const auto& runs = input.problem.experiment().runs;
  std::vector<std::vector<RootShift>> by_run(runs.size());
  in_parallel(runs.size(), [&](std::size_t r) {
    if (const auto* table = std::get_if<measured::ModalTable>(&runs[r].data)) {
      add_table(input, r, *table, by_run[r]);
    } else if (const auto* record = std::get_if<measured::FrequencyRecord>(&runs[r].data)) {
      if (!record->input) by_run[r] = fitted(input, r, *record);
    }
  });
  std::vector<RootShift> shifts;
  for (const auto& own : by_run) shifts.insert(shifts.end(), own.begin(), own.end());
  return shifts;
}

}  // namespace flexarm::diagnose
