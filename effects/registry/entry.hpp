#pragma once

#include "arm/arm.hpp"
#include "arm/effects.hpp"
#include "effects/registry/search.hpp"

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::effects {

/// The kinds of data in which an effect shows.
enum class Shows {
  in_time,                ///< alone: it is not linear, or shifts the working point
  in_time_and_frequency,  ///< not in poles and zeros
  in_all,
};

/// How likely an arm in a laboratory has an effect that its file does not state, before the data.
enum class Likely {
  common,    ///< most arms: friction, damping, a number that is off, a late or scaled signal
  possible,  ///< some arms
  rare,      ///< a fault, or a device that whoever wrote the file would have known
};

/// The probability of that.
constexpr double probability_of(Likely prior) {
  switch (prior) {
    case Likely::common:
      return 0.2;
    case Likely::possible:
      return 0.04;
    case Likely::rare:
      return 0.008;
  }
  return 0.0;
}

/// All that the product knows of an effect. Each file `effects/NAME.cpp` defines one function
/// `Entry NAME()`, which the build finds by the name of the file.
struct Entry {
  std::shared_ptr<const arm::EffectDefinition> definition;
  Shows shows = Shows::in_all;
  /// Where its parameters are looked for, in the definition's order. Of an effect on one sensor the
  /// scales are those of that sensor, here and in `applies`.
  std::function<std::vector<SearchedParameter>(const Scales&)> search;
  /// Whether an experiment with these scales can have it; always, unless given.
  std::function<bool(const Scales&)> applies = {};
  /// Effects that this one becomes at a limit of its parameters.
  std::vector<std::string> contains = {};
  /// Effects that are the same model by another name: no data distinguish them from this one. They
  /// have as many parameters, each with the same meaning to the model.
  std::vector<std::string> same_as = {};
  /// How likely an arm has it before anything is measured.
  Likely prior = Likely::possible;
  std::string speaks_for;  ///< what the data show where it is the cause
  std::string refuted_by;  ///< what would show that it is not
};

inline std::shared_ptr<const arm::EffectDefinition> define(arm::EffectDefinition definition) {
  return std::make_shared<const arm::EffectDefinition>(std::move(definition));
}

}  // namespace flexarm::effects
