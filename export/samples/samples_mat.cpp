#include "export/samples/sample_files.hpp"
#include "measured/files/mat_file.hpp"

#include <cstddef>
#include <utility>

namespace flexarm::samples {

namespace {

using measured::MatMatrix;
using measured::MatStrings;

/// A variable of a MATLAB 5 file has less.
constexpr std::size_t kLargestMat_bytes = std::size_t{1} << 31U;

measured::MatPages pages_of(const std::vector<response::StateSpace>& systems,
                            Eigen::MatrixXd response::StateSpace::*matrix) {
  const Eigen::MatrixXd& first = systems.front().*matrix;
  measured::MatPages pages{static_cast<std::size_t>(first.rows()),
                           static_cast<std::size_t>(first.cols()),
                           systems.size(),
                           {}};
  for (const response::StateSpace& system : systems) {
    const Eigen::MatrixXd& one = system.*matrix;
    pages.values.insert(pages.values.end(), one.data(), one.data() + one.size());
  }
  return pages;
}

}  // namespace

void write_samples_mat(const SampleExport& exported, const std::filesystem::path& path) {
  const auto& samples = exported.samples;
  const auto& systems = exported.state_space.systems;
  const std::size_t count = systems.size();
  MatMatrix delays{1, count, {}};
  MatMatrix output_delays{systems.front().sensors.size(), count, {}};
  MatMatrix sets{1, count, {}};
  MatMatrix values{samples.numbers.size(), count, {}};
  for (std::size_t k = 0; k < count; ++k) {
    const auto& of_outputs = systems[k].output_delay_s;
    delays.values.push_back(systems[k].delay_s);
    output_delays.values.insert(output_delays.values.end(), of_outputs.begin(), of_outputs.end());
    sets.values.push_back(static_cast<double>(samples.samples[k].set) + 1.0);
    const std::vector<double>& its = samples.samples[k].values;
    values.values.insert(values.values.end(), its.begin(), its.end());
  }
  MatStrings sensors;
  MatStrings units;
  for (const arm::Sensor& sensor : systems.front().sensors) {
    sensors.push_back(arm::to_string(sensor));
    units.emplace_back(arm::unit(sensor));
  }
  MatStrings numbers;
  MatStrings number_units;
  for (const SampledNumber& number : samples.numbers) {
    numbers.push_back(number.key);
    number_units.push_back(number.unit);
  }
  MatStrings effects;
  MatMatrix probabilities{exported.posterior.sets.size(), 1, {}};
  for (const ArmDistribution& set : exported.posterior.sets) {
    effects.push_back(set.effects);
    probabilities.values.push_back(set.probability);
  }
  measured::write_mat_file({{"A", pages_of(systems, &response::StateSpace::a)},
                            {"B", pages_of(systems, &response::StateSpace::b)},
                            {"C", pages_of(systems, &response::StateSpace::c)},
                            {"D", pages_of(systems, &response::StateSpace::d)},
                            {"delay_s", std::move(delays)},
                            {"output_delay_s", std::move(output_delays)},
                            {"states", exported.state_space.states},
                            {"sensors", std::move(sensors)},
                            {"units", std::move(units)},
                            {"values", std::move(values)},
                            {"numbers", std::move(numbers)},
                            {"number_units", std::move(number_units)},
                            {"set", std::move(sets)},
                            {"sets", std::move(effects)},
                            {"probability", std::move(probabilities)},
                            {"left_out_effects", exported.left_out_effects},
                            {"seed", MatMatrix{1, 1, {static_cast<double>(exported.seed)}}}},
                           path, kLargestMat_bytes);
}

}  // namespace flexarm::samples
