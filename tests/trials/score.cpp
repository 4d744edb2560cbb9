#include "tests/trials/score.hpp"

#include "tests/trials/dirt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace flexarm::trials {

namespace {

/// In the order of the enumeration.
constexpr std::array<std::string_view, 12> kOutcomes = {
    "exact", "in_class",    "partly",  "wrong",      "missed",   "abstained",
    "quiet", "false_alarm", "doubted", "recognised", "mistaken", "no_answer"};

constexpr std::array<std::string_view, 3> kDirtAnswers = {"-", "named", "unnamed"};

constexpr std::array<std::string_view, 4> kPortAnswers = {"-", "right", "wrong", "undetermined"};

/// The value whose name stands at its place among `names`.
template <class Value, std::size_t N>
Value parsed(const std::array<std::string_view, N>& names, std::string_view name,
             std::string_view what_else) {
  const auto at = std::ranges::find(names, name);
  if (at == names.end()) throw std::runtime_error(fmt::format("{}: {}", name, what_else));
  return static_cast<Value>(at - names.begin());
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

/// `cause` is the hidden one, or one of few that it may be.
bool stands_for(const NamedCause& cause, const std::string& hidden) {
  if (cause.effect == hidden) return true;
  return cause.confusable_with.size() < kLargestClass && contains(cause.confusable_with, hidden);
}

Outcome outcome_of_named(const std::vector<std::string>& hidden, const Answer& answer) {
  std::size_t exact = 0;
  std::size_t in_class = 0;
  for (const std::string& name : hidden) {
    const bool named = std::ranges::any_of(
        answer.causes, [&](const NamedCause& cause) { return cause.effect == name; });
    const bool stood_for = std::ranges::any_of(
        answer.causes, [&](const NamedCause& cause) { return stands_for(cause, name); });
    if (named) ++exact;
    if (stood_for) ++in_class;
  }
  const bool one_is_wrong = std::ranges::any_of(answer.causes, [&](const NamedCause& cause) {
    return std::ranges::none_of(hidden,
                                [&](const std::string& name) { return stands_for(cause, name); });
  });
  if (one_is_wrong && answer.verdict == "partly_explained") return Outcome::wrong;
  const bool as_many = answer.causes.size() == hidden.size();
  if (as_many && exact == hidden.size()) return Outcome::exact;
  if (as_many && in_class == hidden.size()) return Outcome::in_class;
  return in_class > 0 ? Outcome::partly : Outcome::wrong;
}

Outcome outcome_of(const TrialResult& result, const Answer& answer) {
  if (answer.verdict.empty()) return Outcome::no_answer;
  const bool silent = answer.causes.empty();
  if (result.hidden.empty()) {
    if (!silent) return Outcome::false_alarm;
    // Explained without a cause: by the arm's uncertain numbers.
    const bool is_quiet = answer.verdict == "adequate" || answer.verdict == "explained";
    return is_quiet || result.dirt_answer == DirtAnswer::named ? Outcome::quiet : Outcome::doubted;
  }
  if (answer.verdict == "adequate") return Outcome::missed;
  if (result.outside) {
    if (answer.verdict == "explained") return Outcome::mistaken;
    const bool claimed = std::ranges::any_of(answer.causes, [&](const NamedCause& cause) {
      return cause.probability > kClaimed && !contains(result.hidden, cause.effect);
    });
    return claimed ? Outcome::wrong : Outcome::recognised;
  }
  return silent ? Outcome::abstained : outcome_of_named(result.hidden, answer);
}

/// An effect on another sensor than the hidden one is another cause.
Answer with_sensors_in_names(Answer answer, const Truth& truth) {
  for (NamedCause& cause : answer.causes) {
    const HiddenCause* hidden = truth.world.find(cause.effect);
    if (hidden != nullptr && hidden->sensor != cause.sensor) cause.effect += " on " + cause.sensor;
  }
  return answer;
}

/// The cause is the dirt of the recording: by its own name, or in a class of few; not one that is
/// hidden beside it.
bool is_dirt(const NamedCause& cause, const Truth& truth) {
  const auto& hidden = truth.key.hidden;
  const auto& names = find_dirt(truth.key.dirt).named_as;
  const bool is_hidden =
      std::ranges::any_of(hidden, [&](const std::string& name) { return stands_for(cause, name); });
  return !is_hidden && std::ranges::any_of(
                           names, [&](const std::string& name) { return stands_for(cause, name); });
}

PortAnswer port_answer(const TrialResult& result, const Answer& answer) {
  const bool is_asked = result.outside && result.hidden.size() == 1 && result.kind == "time" &&
                        !answer.verdict.empty();
  if (!is_asked) return PortAnswer::none;
  if (answer.ports.empty()) return PortAnswer::undetermined;
  const bool is_right = contains(answer.ports, find_cause(result.hidden.front()).port);
  return is_right ? PortAnswer::right : PortAnswer::wrong;
}

bool is_angle(const std::string& parameter) {
  return parameter == "phase" || parameter == "angle";
}

/// Distance of a found value, the shorter way around where it is an angle.
double distance(const std::string& parameter, double found, double hidden) {
  const double difference = found - hidden;
  return std::abs(is_angle(parameter) ? std::remainder(difference, 2.0 * std::numbers::pi)
                                      : difference);
}

void compare_parameters(TrialResult& result, const Truth& truth, const Answer& answer) {
  for (const NamedCause& cause : answer.causes) {
    if (!result.values.empty()) result.values += "; ";
    result.values += cause.effect;
    const HiddenCause* hidden = truth.world.find(cause.effect);
    for (const auto& [name, found] : cause.parameters) {
      result.values += fmt::format(" {} {:.4g}+-{:.2g}", name, found.value, found.std_error);
      if (hidden == nullptr) continue;
      const double value = hidden->parameters.at(name);
      const double error = distance(name, found.value, value);
      const double scale = is_angle(name) ? 2.0 * std::numbers::pi : std::abs(value);
      result.values += fmt::format(" ({:.4g})", value);
      ++result.parameters;
      if (error <= kRecovered * scale) ++result.recovered;
      if (error <= 1.96 * found.std_error) ++result.covered;
    }
  }
}

}  // namespace

std::string_view to_string(Outcome outcome) {
  return kOutcomes.at(static_cast<std::size_t>(outcome));
}

Outcome parse_outcome(std::string_view name) {
  return parsed<Outcome>(kOutcomes, name, "no outcome");
}

std::string_view to_string(DirtAnswer answer) {
  return kDirtAnswers.at(static_cast<std::size_t>(answer));
}

DirtAnswer parse_dirt_answer(std::string_view name) {
  return parsed<DirtAnswer>(kDirtAnswers, name, "no answer to dirt");
}

std::string_view to_string(PortAnswer answer) {
  return kPortAnswers.at(static_cast<std::size_t>(answer));
}

PortAnswer parse_port_answer(std::string_view name) {
  return parsed<PortAnswer>(kPortAnswers, name, "no answer to a port");
}

TrialResult score(const Truth& truth, const Answer& given) {
  Answer answer = with_sensors_in_names(given, truth);
  TrialResult result;
  result.id = truth.key.id();
  result.kind = measured::to_string(truth.key.kind);
  result.arm = truth.arm;
  result.noise = truth.key.noise;
  result.strength = truth.key.hidden.empty() ? "-" : truth.key.strength_name();
  result.hidden = truth.key.hidden;
  result.outside = truth.world.has_outside();
  if (!truth.errors.empty()) {
    result.error = std::accumulate(truth.errors.begin(), truth.errors.end(), 0.0) /
                   static_cast<double>(truth.errors.size());
  }
  result.verdict = answer.verdict.empty() ? "-" : answer.verdict;
  if (!truth.key.dirt.empty()) result.dirt = truth.key.dirt;
  compare_parameters(result, truth, answer);
  const std::size_t named_dirt =
      std::erase_if(answer.causes, [&](const auto& cause) { return is_dirt(cause, truth); });
  if (!find_dirt(truth.key.dirt).named_as.empty()) {
    result.dirt_answer = named_dirt > 0 ? DirtAnswer::named : DirtAnswer::unnamed;
  }
  for (const NamedCause& cause : answer.causes) {
    result.named.push_back(cause.effect);
    result.claims.push_back({cause.probability, contains(result.hidden, cause.effect)});
    result.class_size = std::max(result.class_size, 1 + cause.confusable_with.size());
  }
  result.outcome = outcome_of(result, answer);
  result.port_answer = port_answer(result, answer);
  result.ports = answer.ports;
  if (truth.rig) result.rig = rig_score(truth, given);
  result.before = answer.estimation.before;
  result.after = answer.estimation.after;
  result.validation_after = answer.validation.after;
  result.validation_floor = answer.validation.noise_floor;
  result.time_s = answer.time_s;
  result.processor_s = answer.processor_s;
  return result;
}

}  // namespace flexarm::trials
