#include "app/exported_files.hpp"

#include "arm/input_error.hpp"
#include "measured/files/atomic_file.hpp"
#include "report/json/json_document.hpp"
#include "report/progress.hpp"
#include "response/arm_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace flexarm::app {

namespace {

using Json = nlohmann::ordered_json;

/// Mean and standard deviation of a number over the samples that have it, without the nominal arm.
struct SampleMoments {
  int count = 0;
  double mean = 0.0;
  double deviation = 0.0;
};

SampleMoments moments_of(const samples::ArmSamples& drawn, std::size_t number) {
  SampleMoments made;
  double squares = 0.0;
  for (std::size_t k = 1; k < drawn.samples.size(); ++k) {
    const double value = drawn.samples[k].values[number];
    if (std::isnan(value)) continue;
    const double off = value - made.mean;
    made.mean += off / ++made.count;
    squares += off * (value - made.mean);
  }
  if (made.count > 1) made.deviation = std::sqrt(squares / (made.count - 1));
  return made;
}

std::string shown_set(const samples::ArmDistribution& set) {
  return set.effects.empty() ? "no identified effect" : set.effects;
}

int count_of(const samples::ArmSamples& drawn, std::size_t set) {
  const auto& all = drawn.samples;
  return static_cast<int>(std::count_if(all.begin() + 1, all.end(),
                                        [&](const auto& sample) { return sample.set == set; }));
}

}  // namespace

report::Table fmu_table(const fmu::FmuDescription& description) {
  report::Table table{"Variables of the FMU",
                      {{"variable"}, {"causality"}, {"start"}, {"std deviation"}, {"unit"}}};
  for (const fmu::FmuVariable& variable : description.variables) {
    if (variable.causality == fmu::Causality::independent) continue;
    const bool is_parameter = variable.causality == fmu::Causality::parameter;
    const auto deviation = description.standard_deviations.find(variable.name);
    table.add_row({variable.name, std::string(fmu::word_for(variable.causality)),
                   is_parameter ? fmt::format("{:.6g}", variable.start) : std::string(),
                   deviation == description.standard_deviations.end()
                       ? std::string()
                       : fmt::format("{:.2g}", deviation->second),
                   variable.unit});
  }
  return table;
}

Json fmu_json(const fmu::FmuDescription& description, int fmi, const std::string& file) {
  Json json = {{"file", file},
               {"fmi_version", fmt::format("{}.0", fmi)},
               {"token", description.settings.token},
               {"model_identifier", description.model_identifier},
               {"inner_step_s", description.settings.sample_time_s},
               {"static_correction", description.settings.static_correction},
               {"variables", Json::array()}};
  for (std::size_t i = 0; i < description.variables.size(); ++i) {
    const fmu::FmuVariable& variable = description.variables[i];
    const bool has_start = variable.causality == fmu::Causality::parameter ||
                           variable.causality == fmu::Causality::input;
    const auto deviation = description.standard_deviations.find(variable.name);
    json["variables"].push_back(
        {{"name", variable.name},
         {"value_reference", i},
         {"causality", std::string(fmu::word_for(variable.causality))},
         {"unit", variable.unit},
         {"start", has_start ? Json(variable.start) : Json(nullptr)},
         {"standard_deviation", deviation == description.standard_deviations.end()
                                    ? Json(nullptr)
                                    : Json(deviation->second)}});
  }
  return json;
}

void require_samples_file(const std::filesystem::path& path) {
  if (path.extension() != ".json" && path.extension() != ".mat") {
    throw arm::InputError(fmt::format("--state-space {}: unknown extension; allowed: .json, .mat",
                                      arm::shown(path.string())));
  }
  measured::require_writable(path);
}

samples::SampleExport sample_state_spaces(const samples::ParameterPosterior& posterior,
                                          const samples::StateSpaceSettings& settings, int count,
                                          std::uint64_t seed) {
  samples::SampleExport made{
      .posterior = posterior,
      .samples = samples::draw(posterior, static_cast<std::size_t>(count), seed),
      .state_space = {},
      .seed = seed};
  report::Progress progress("samples", count + 1);
  made.state_space = samples::state_spaces(made.samples, settings, [&] { progress.advance(); });
  for (const samples::ArmDistribution& set : posterior.sets) {
    for (const std::string& effect : response::nonlinear_effects(set.arm)) {
      auto& names = made.left_out_effects;
      if (std::ranges::find(names, effect) == names.end()) names.push_back(effect);
    }
  }
  return made;
}

void write_samples(const samples::SampleExport& made, const std::filesystem::path& path) {
  if (path.extension() == ".mat") {
    samples::write_samples_mat(made, path);
  } else {
    measured::write_atomically(
        path, report::json_document("flexarm.state_space_samples/1", samples::samples_json(made)));
  }
}

std::string samples_text(const samples::SampleExport& made) {
  report::Table sets{"Sets of effects", {{"effects"}, {"probability"}, {"samples"}}};
  for (std::size_t i = 0; i < made.posterior.sets.size(); ++i) {
    sets.add_row({shown_set(made.posterior.sets[i]),
                  fmt::format("{:.3f}", made.posterior.sets[i].probability),
                  std::int64_t{count_of(made.samples, i)}});
  }
  report::Table numbers{"Sampled numbers",
                        {{"number"}, {"nominal"}, {"mean"}, {"std deviation"}, {"unit"}}};
  for (std::size_t i = 0; i < made.samples.numbers.size(); ++i) {
    const auto [count, mean, deviation] = moments_of(made.samples, i);
    const double nominal = made.samples.samples.front().values[i];
    numbers.add_row({made.samples.numbers[i].key,
                     std::isnan(nominal) ? std::string() : fmt::format("{:.6g}", nominal),
                     count > 0 ? fmt::format("{:.6g}", mean) : std::string(),
                     count > 1 ? fmt::format("{:.2g}", deviation) : std::string(),
                     made.samples.numbers[i].unit});
  }
  std::string text = report::to_text(sets) + "\n";
  if (made.samples.numbers.empty()) {
    text += "note: the arm states no uncertainty: all samples are alike\n\n";
  } else {
    text += report::to_text(numbers) + "\n";
  }
  if (!made.left_out_effects.empty()) {
    text += report::to_paragraph(fmt::format("note: not linear, not in the state spaces: {}",
                                             fmt::join(made.left_out_effects, ", ")));
  }
  if (made.samples.rejected > 0) {
    text += report::to_paragraph(fmt::format(
        "note: {} draws out of the allowed ranges were drawn anew", made.samples.rejected));
  }
  for (const std::string& reason : made.posterior.left_out) {
    text += report::to_paragraph("note: a set of effects is left out: " + reason);
  }
  return text;
}

Json samples_summary_json(const samples::SampleExport& made, const std::string& file) {
  Json json = {{"file", file},
               {"seed", made.seed},
               {"samples", made.samples.samples.size() - 1},
               {"rejected_draws", made.samples.rejected},
               {"left_out_effects", made.left_out_effects},
               {"sets", Json::array()},
               {"numbers", Json::array()}};
  for (std::size_t i = 0; i < made.posterior.sets.size(); ++i) {
    json["sets"].push_back({{"effects", made.posterior.sets[i].effects},
                            {"probability", made.posterior.sets[i].probability},
                            {"samples", count_of(made.samples, i)}});
  }
  for (std::size_t i = 0; i < made.samples.numbers.size(); ++i) {
    const auto [count, mean, deviation] = moments_of(made.samples, i);
    const double nominal = made.samples.samples.front().values[i];
    json["numbers"].push_back({{"key", made.samples.numbers[i].key},
                               {"unit", made.samples.numbers[i].unit},
                               {"nominal", std::isnan(nominal) ? Json(nullptr) : Json(nominal)},
                               {"mean", count > 0 ? Json(mean) : Json(nullptr)},
                               {"std_deviation", count > 1 ? Json(deviation) : Json(nullptr)}});
  }
  return json;
}

}  // namespace flexarm::app
