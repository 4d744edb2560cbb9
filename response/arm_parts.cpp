#include "response/arm_parts.hpp"

#include "arm/effects.hpp"
#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "arm/rigid_hub.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <variant>

namespace flexarm::response {

namespace {

arm::InputError not_modelled(const std::string& effect, arm::Port port, const char* why) {
  return arm::InputError(fmt::format("effects.{}: port {}: {}", effect, arm::to_string(port), why),
                         "effects." + effect);
}

/// Adds a stage behind those that are there.
struct StageAdder {
  Actuator& actuator;
  const std::string& effect;

  void operator()(const arm::Delay& delay) const { actuator.delay_s += delay.delay_s; }
  void operator()(const arm::PiecewiseLinear& map) const {
    if (actuator.lag_s > 0.0 && !map.is_proportional()) {
      throw not_modelled(effect, arm::Port::torque_path,
                         "a nonlinearity after a lag is not modelled");
    }
    if (map != arm::PiecewiseLinear()) actuator.maps.push_back(map);
  }
  void operator()(const arm::Lag& lag) const {
    if (actuator.lag_s > 0.0 && lag.time_constant_s > 0.0) {
      throw not_modelled(effect, arm::Port::torque_path, "a second lag is not modelled");
    }
    actuator.lag_s += lag.time_constant_s;
  }
};

struct LawAdder {
  HubLaws& hub;
  const std::string& effect;

  void operator()(const arm::ConstantHubTorque& law) const { hub.constant_N_m += law.torque_N_m; }
  void operator()(const arm::SmoothHubTorque& law) const { hub.smooth.push_back({effect, law}); }
  void operator()(const arm::DryFriction& law) const {
    if (law.size(0.0).torque_N_m > 0.0 || law.changes_over_rad_per_s) {
      hub.friction.push_back({effect, law});
    }
  }
  void operator()(const arm::HubTorqueWithFriction& law) const {
    (*this)(law.smooth);
    (*this)(law.friction);
  }
};

/// What the effect does to the linear arm alone.
arm::Effect linear_part(const arm::Effect& effect) {
  return arm::redefined(effect, [](arm::EffectDefinition& definition) {
    definition.torque_path = {};
    definition.hub_torque = {};
    definition.beam_force = {};
    definition.sensor_path = {};
  });
}

/// The arm with its effects on the linear arm alone.
arm::Arm with_linear_effects(const arm::Arm& arm) {
  arm::Arm made = arm;
  std::erase_if(made.effects, [](const auto& effect) {
    const arm::EffectDefinition& does = *effect.second.definition;
    return !does.arm_number && !does.linear_term && !does.sensor_place;
  });
  for (auto& [name, effect] : made.effects) {
    if (!effect.definition->is_of_linear_arm()) effect = linear_part(effect);
  }
  return made;
}

/// Adds a stage to those of the same sensor. Each kind acts at its place in the chain, where gains
/// multiply, and delays and offsets add up.
struct SensorStageAdder {
  SensorChain& chain;
  const std::string& effect;

  void operator()(const arm::Gain& gain) const { chain.gain *= gain.factor; }
  void operator()(const arm::Delay& delay) const { chain.delay_s += delay.delay_s; }
  void operator()(const arm::Lag& lag) const {
    if (chain.lag_s > 0.0 && lag.time_constant_s > 0.0) {
      throw not_modelled(effect, arm::Port::sensor_path,
                         "a second lag of a sensor is not modelled");
    }
    chain.lag_s += lag.time_constant_s;
  }
  void operator()(const arm::Offset& offset) const { chain.offset += offset.value; }
};

void add_sensor_stage(ArmParts& parts, const std::string& effect, const arm::SensorStage& stage) {
  auto& chains = parts.sensor_chains;
  auto chain = std::ranges::find(chains, stage.sensor, &SensorChain::sensor);
  if (chain == chains.end()) chain = chains.insert(chain, SensorChain{stage.sensor});
  std::visit(SensorStageAdder{*chain, effect}, stage.what);
  if (*chain == SensorChain{stage.sensor}) chains.erase(chain);
}

}  // namespace

std::vector<double> Actuator::bends() const {
  // Bends of the maps so far; behind them each straight piece passes the bends of the next map.
  std::vector<double> found;
  Actuator before;
  for (const auto& map : maps) {
    std::vector<double> edges = found;
    const double beyond =
        edges.empty() ? 1.0 : 1.0 + std::abs(edges.front()) + std::abs(edges.back());
    edges.insert(edges.begin(), edges.empty() ? -beyond : edges.front() - beyond);
    edges.push_back(edges.back() + beyond);
    std::vector<double> further;
    for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
      const double from = before.mapped(edges[k]);
      const double rise = before.mapped(edges[k + 1]) - from;
      if (rise == 0.0) continue;
      const bool is_first = k == 0;
      const bool is_last = k + 2 == edges.size();
      for (const double bend : map.bends()) {
        const double x = edges[k] + (bend - from) / rise * (edges[k + 1] - edges[k]);
        if ((is_first || x > edges[k]) && (is_last || x < edges[k + 1])) further.push_back(x);
      }
    }
    found.insert(found.end(), further.begin(), further.end());
    std::ranges::sort(found);
    const auto repeated = std::ranges::unique(found);
    found.erase(repeated.begin(), repeated.end());
    before.maps.push_back(map);
  }
  return found;
}

double Actuator::gain() const {
  double product = 1.0;
  for (const auto& map : maps) {
    if (map.is_proportional()) product *= map.slope(0.0);
  }
  return product;
}

SensorChain chain_of(std::span<const SensorChain> chains, const arm::Sensor& sensor) {
  const auto found = std::ranges::find(chains, sensor, &SensorChain::sensor);
  return found == chains.end() ? SensorChain{sensor} : *found;
}

arm::DryFriction::Size HubLaws::friction_at(double speed_rad_per_s) const {
  arm::DryFriction::Size sum;
  for (const auto& [effect, law] : friction) {
    const auto size = law.size(speed_rad_per_s);
    sum.torque_N_m += size.torque_N_m;
    sum.per_speed_N_m_s += size.per_speed_N_m_s;
  }
  return sum;
}

double HubLaws::friction_scale_rad_per_s() const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [effect, law] : friction) {
    least = std::min(least, law.changes_over_rad_per_s.value_or(least));
  }
  return least;
}

void add_effect(ArmParts& parts, const arm::Effect& effect) {
  const arm::EffectDefinition& does = *effect.definition;
  arm::require_valid(arm::Effects{{does.name, effect}});
  if (does.torque_path) {
    std::visit(StageAdder{parts.actuator, does.name}, does.torque_path(effect).what);
  }
  if (does.hub_torque) std::visit(LawAdder{parts.hub, does.name}, does.hub_torque(effect));
  if (does.beam_force) parts.beam_forces.push_back({does.name, does.beam_force(effect)});
  if (does.sensor_path) add_sensor_stage(parts, does.name, does.sensor_path(effect));
}

ArmParts take_apart(const arm::Arm& arm) {
  arm::require_valid(arm);
  ArmParts parts{.linear = with_linear_effects(arm)};
  std::vector<const arm::Effect*> ordered;
  for (const auto& [name, effect] : arm.effects) ordered.push_back(&effect);
  std::ranges::stable_sort(ordered, {}, [](const arm::Effect* effect) {
    const auto& stage = effect->definition->torque_path;
    return stage ? stage(*effect).order : 0;
  });
  for (const arm::Effect* effect : ordered) add_effect(parts, *effect);
  return parts;
}

ArmParts with_driven_hub(ArmParts parts) {
  arm::require_beam(parts.linear, "a hub whose motion is given");
  std::erase_if(parts.linear.effects, [](const auto& effect) {
    return arm::acts_without_beam(*effect.second.definition);
  });
  const double inertia_kg_m2 = arm::total_inertia_kg_m2(arm::linear_arm(parts.linear));
  parts.linear.hub.inertia_kg_m2 = kDrivenHubInertia * inertia_kg_m2;
  parts.linear.hub.viscous_friction_N_m_s_per_rad = 0.0;
  parts.actuator = {};
  parts.hub = {};
  parts.hub_is_driven = true;
  return parts;
}

std::vector<std::string> nonlinear_effects(const arm::Arm& arm) {
  const auto is_nonlinear = [](const arm::Effect& effect) {
    const arm::EffectDefinition& does = *effect.definition;
    if (does.beam_force) return true;
    if (does.hub_torque) {
      return !std::holds_alternative<arm::ConstantHubTorque>(does.hub_torque(effect));
    }
    if (!does.torque_path) return false;
    const arm::TorqueStage stage = does.torque_path(effect);
    const auto* map = std::get_if<arm::PiecewiseLinear>(&stage.what);
    return map != nullptr && !map->is_proportional();
  };
  std::vector<std::string> names;
  for (const auto& [name, effect] : arm.effects) {
    if (is_nonlinear(effect)) names.push_back(name);
  }
  return names;
}

std::vector<std::string> linearised_effects(const arm::Arm& arm) {
  std::vector<std::string> names;
  const arm::Arm changed = arm::with_changed_numbers(arm);
  for (const std::string& name : nonlinear_effects(arm)) {
    const arm::Effect& effect = arm.effects.at(name);
    if (!effect.definition->linear_term) continue;
    arm::LinearTerms terms;
    effect.definition->linear_term(effect, changed, terms);
    if (terms != arm::LinearTerms{}) names.push_back(name);
  }
  return names;
}

}  // namespace flexarm::response
