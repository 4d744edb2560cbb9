#include "app/option_values.hpp"

#include "diagnose/search/selection_options.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/checks/data_check.hpp"
#include "measured/spectra/estimator.hpp"

#include <fmt/format.h>

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

/// "beam=": the number follows.
Words policy_names() {
  Words names;
  for (const auto& number : diagnose::policy_numbers())
    names.push_back(fmt::format("{}=", number.name));
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
      {"--frequency-unit", {"Hz", "rad/s"}},
      {"--hide-effects", effect_names()},
      {"--hold", {"zero", "first"}},
      {"--initial", {"rest", "free"}},
      {"--input", names_of(measured::kResponseInputs)},
      {"--kind", {"time", "frf", "modal"}},
      {"--magnitude", {"absolute", "dB"}},
      {"--nyquist", {"minus-one", "negative-frequencies"}},
      {"--peaks", {"between", "on-line"}},
      {"--policy", policy_names()},
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
    "--column",    "--compute", "--excitation", "--figure-size", "--font",     "--id",
    "--leave-out", "--name",    "--noise-of",   "--over",        "--own-rate", "--quantisation",
    "--rows",      "--run",     "--times",      "--validation",  "PART"};

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

std::string value_name(const OptionDescription& option) {
  if (option.value.empty()) return "";
  std::string name = "TEXT";
  if (option.value == "FLOAT") name = "NUMBER";
  if (option.value == "INT" || option.value == "UINT") name = "N";
  switch (values_of(option).kind) {
    case OptionValues::Kind::file:
      name = "FILE";
      break;
    case OptionValues::Kind::folder:
      name = "FOLDER";
      break;
    case OptionValues::Kind::words:
      name = "NAME";
      break;
    default:
      break;
  }
  // What is stated in the command line, although a file may state it as well.
  for (const char* form : {"KEY=VALUE", "NAME:UNIT", "Expression"}) {
    if (option.text.find(form) != std::string::npos) name = "TEXT";
  }
  return name + (option.is_list ? ",..." : "");
}

std::string text_with_default(const OptionDescription& option) {
  std::string value = option.default_value;
  if (value.starts_with('[') && value.ends_with(']')) value = value.substr(1, value.size() - 2);
  if (value.empty() || option.text.find("efault") != std::string::npos) return option.text;
  return fmt::format("{} [default: {}]", option.text, value);
}

}  // namespace flexarm::app
