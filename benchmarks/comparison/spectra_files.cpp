// Writes the record of spectra_benchmark and flexarm's spectra of it into a folder as raw doubles,
// with a description in JSON, for spectra_scipy.py.
#include "benchmarks/comparison/raw_files.hpp"
#include "benchmarks/spectra_case.hpp"
#include "measured/spectra/frequency_response.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <iostream>

int main(int argc, char** argv) {
  using namespace flexarm;
  using benchmarks::write_json;
  using benchmarks::write_raw;
  if (argc != 2) {
    std::cerr << "usage: spectra_files FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  const auto record = benchmarks::spectra_record();
  const auto plan = benchmarks::spectra_plan();
  std::vector<measured::Signal> outputs;
  for (const auto& channel : record.channels) outputs.push_back({channel.values});
  const double period_s = measured::sampling_period_s(record);
  const auto spectra = measured::cross_spectra({record.torque_N_m}, outputs, period_s, plan);
  write_raw(folder / "torque.f64", record.torque_N_m);
  write_raw(folder / "torque-power.f64", spectra.input);
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const std::string name = "channel-" + std::to_string(i);
    write_raw(folder / (name + ".f64"), record.channels[i].values);
    write_raw(folder / (name + "-power.f64"), spectra.outputs[i]);
    write_raw(folder / (name + "-cross.c128"), spectra.cross[i]);
    write_raw(folder / (name + "-coherence.f64"), measured::estimate(spectra, i).coherence);
  }
  write_json(folder / "case.json", {{"channels", outputs.size()},
                                    {"sampling_frequency_Hz", 1.0 / period_s},
                                    {"segment_samples", plan.segment_samples},
                                    {"shift_samples", plan.shift_samples}});
  return 0;
}
