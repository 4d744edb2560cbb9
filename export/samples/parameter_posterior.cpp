#include "export/samples/parameter_posterior.hpp"

#include "arm/arm_keys.hpp"
#include "arm/effect_label.hpp"
#include "arm/input_error.hpp"
#include "arm/uncertainties.hpp"
#include "effects/registry/vocabulary.hpp"
#include "response/arm_parts.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace flexarm::samples {

namespace {

using Eigen::Index;

const arm::ArmKey* find_key(const std::string& name) {
  const auto found = std::ranges::find(arm::arm_keys(), name, &arm::ArmKey::name);
  return found == arm::arm_keys().end() ? nullptr : &*found;
}

/// Adds what the arm states of its numbers and the set does not estimate, uncorrelated.
void add_stated(ArmDistribution& set) {
  const Index estimated = std::ssize(set.marginals);
  for (const auto& [name, relative] : set.arm.relative_uncertainties) {
    if (std::ranges::find(set.marginals, name, &Marginal::key) != set.marginals.end()) continue;
    const arm::ArmKey& key = *find_key(name);
    const double value = key.get(set.arm).value();
    set.marginals.push_back({name, value, relative * std::abs(value), key.unit, true});
  }
  const Index count = std::ssize(set.marginals);
  Eigen::MatrixXd correlation = Eigen::MatrixXd::Identity(count, count);
  if (estimated > 0) correlation.topLeftCorner(estimated, estimated) = set.correlation;
  set.correlation = std::move(correlation);
}

struct NamedEffect {
  std::string name;
  std::string sensor;
};

std::vector<NamedEffect> effects_of(const nlohmann::json& set) {
  std::vector<NamedEffect> made;
  for (const auto& effect : set.at("effects")) {
    made.push_back({effect.at("effect").get<std::string>(), effect.value("sensor", "")});
  }
  return made;
}

/// The effect without numbers; its definition is that of the arm, which a file may state, or of the
/// library.
arm::Effect bare(const NamedEffect& effect, const arm::Arm& extended_arm) {
  const auto own = extended_arm.effects.find(effect.name);
  if (own == extended_arm.effects.end()) return effects::effect(effect.name, {}, effect.sensor);
  arm::Effect made = own->second;
  made.sensor = effect.sensor;
  return made;
}

/// `identified` are the effects that the extended arm has beyond its file.
ArmDistribution read_set(const nlohmann::json& json, const arm::Arm& extended_arm,
                         const std::vector<NamedEffect>& identified) {
  ArmDistribution made{.effects = {}, .arm = extended_arm, .marginals = {}, .correlation = {}};
  made.probability = json.at("probability").get<double>();
  for (const NamedEffect& effect : identified) made.arm.effects.erase(effect.name);
  for (const NamedEffect& effect : effects_of(json)) {
    made.effects +=
        (made.effects.empty() ? "" : " + ") + arm::effect_label(effect.name, effect.sensor);
    made.arm.effects[effect.name] = bare(effect, extended_arm);
  }
  for (const auto& parameter : json.at("parameters")) {
    made.marginals.push_back(
        {parameter.at("key").get<std::string>(), parameter.at("value").get<double>(),
         parameter.at("std_error").get<double>(), parameter.at("unit").get<std::string>(),
         parameter.at("logarithmic").get<bool>()});
    put_number(made.arm, made.marginals.back().key, made.marginals.back().value);
  }
  const Index count = std::ssize(made.marginals);
  made.correlation = Eigen::MatrixXd::Identity(count, count);
  for (Index i = 0; i < count; ++i) {
    const auto& row = json.at("correlation").at(static_cast<std::size_t>(i));
    for (Index j = 0; j < count; ++j) {
      made.correlation(i, j) = row.at(static_cast<std::size_t>(j)).get<double>();
    }
  }
  arm::require_valid(made.arm);
  response::take_apart(made.arm);
  add_stated(made);
  return made;
}

}  // namespace

void put_number(arm::Arm& arm, const std::string& name, double value) {
  if (const arm::ArmKey* const key = find_key(name)) {
    arm::require_in_range(name, value, key->unit, key->range);
    key->set(arm, value);
    // What a rigidity or a density is used in place of must go on agreeing with it.
    arm::Arm alone = arm;
    alone.relative_uncertainties = {{name, 1.0}};
    arm.beam = arm::with_deviations(alone, std::vector{0.0}).beam;
    return;
  }
  for (auto& [effect_name, effect] : arm.effects) {
    for (const arm::EffectParameter& parameter : effect.definition->parameters) {
      if (fmt::format("effects.{}.{}", effect_name, parameter.name) != name) continue;
      arm::require_in_range(name, value, parameter.unit, parameter.range);
      effect.parameters[parameter.name] = value;
      return;
    }
  }
  throw arm::InputError(fmt::format("{}: not a number of the arm", arm::shown(name)));
}

ParameterPosterior posterior_of(const arm::Arm& arm) {
  ArmDistribution set{.effects = {}, .arm = arm, .marginals = {}, .correlation = {}};
  add_stated(set);
  return {{std::move(set)}};
}

ParameterPosterior posterior_of(const nlohmann::json& diagnosis, const arm::Arm& extended_arm) {
  if (!diagnosis.contains("posterior")) {
    throw arm::InputError("posterior: missing; diagnose again with this version of flexarm");
  }
  const auto& sets = diagnosis.at("posterior");
  if (sets.empty()) return posterior_of(extended_arm);
  const std::vector<NamedEffect> identified = effects_of(sets.at(0));
  ParameterPosterior made;
  double sum = 0.0;
  for (const auto& json : sets) {
    try {
      made.sets.push_back(read_set(json, extended_arm, identified));
      sum += made.sets.back().probability;
    } catch (const arm::InputError& error) {
      if (made.sets.empty()) throw;  // of the extended arm itself
      made.left_out.emplace_back(error.what());
    }
  }
  for (ArmDistribution& set : made.sets) set.probability /= sum;
  return made;
}

}  // namespace flexarm::samples
