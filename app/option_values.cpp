#include "app/option_values.hpp"

#include "diagnose/search/selection_options.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/checks/data_check.hpp"
#include "measured/spectra/estimator.hpp"

#include <algorithm>
#include <map>
#include <string_view>

namespace flexarm::app {

namespace {

using Words = std::vector<std::string>;

Words effect_names() {
  Words names;
  for (const auto& entry : effects::entries()) names.push_back(entry.definition->name);
  return names;
}

Words check_names() {
  Words names;
  for (const auto fault : measured::kFaults) names.push_back(measured::check_name(fault));
  return names;
}

template <class Values>
Words names_of(const Values& values) {
  Words names;
  for (const auto value : values) names.emplace_back(to_string(value));
  return names;
}

Words predictor_names() {
  Words names = names_of(diagnose::kPredictors);
  names.insert(names.begin(), "auto");
  return names;
}

/// An option has one meaning in all commands.
std::map<std::string_view, Words> words_by_name() {
  return {
      {"--accept", check_names()},
      {"--basis", {"legendre", "clamped_free", "pinned_free", "clamped_with_payload"}},
      {"--clock", {"stamped", "even"}},
      {"--join-grid", {"same", "first", "coarsest"}},
      {"--detrend", {"none", "mean", "line"}},
      {"--effects", effect_names()},
      {"--exclude", effect_names()},
      {"--figure", {"18", "19"}},
      {"--figure-format", {"svg", "pdf", "png"}},
      {"--formulation", {"exact_tf", "fem", "assumed_modes"}},
      {"--hide-effects", effect_names()},
      {"--hold", {"zero", "first"}},
      {"--initial", {"rest", "free"}},
      {"--input", names_of(measured::kResponseInputs)},
      {"--kind", {"time", "frf", "modal"}},
      {"--peaks", {"between", "on-line"}},
      {"--predictor", predictor_names()},
      {"--purpose", {"estimation", "validation"}},
      {"--refit", effect_names()},
      {"--sensor",
       {"hub_angle", "hub_velocity", "tip_acceleration", "tip_displacement", "tip_deflection",
        "strain@"}},
      {"--time-unit", {"s", "ms", "us"}},
      {"--to", {"csv", "uff58", "uff58b", "mat"}},
      {"--window", {"hann", "rectangular", "hamming", "blackman", "flat-top"}},
      {"NAME", effect_names()},
      {"SHELL", {"bash", "zsh", "fish"}},
  };
}

/// Text that is no file: expressions, names and lists of the user's own.
constexpr std::string_view kOwnText[] = {
    "--column",    "--compute", "--excitation", "--figure-size", "--font",         "--id",
    "--leave-out", "--name",    "--noise-of",   "--over",        "--quantisation", "--rows",
    "--run",       "--times",   "--validation", "PART"};

}  // namespace

OptionValues values_of(const OptionDescription& option) {
  if (option.value.empty()) return {};
  const std::string& name = option.names.back();
  static const auto words = words_by_name();
  if (const auto known = words.find(name); known != words.end()) {
    return {OptionValues::Kind::words, known->second};
  }
  if (option.value == kFileType) return {OptionValues::Kind::file};
  if (name == "--out") return {OptionValues::Kind::folder};
  const bool is_number = option.value == "FLOAT" || option.value == "INT" || option.value == "UINT";
  if (is_number || std::ranges::find(kOwnText, name) != std::ranges::end(kOwnText)) return {};
  return {OptionValues::Kind::file};
}

}  // namespace flexarm::app
