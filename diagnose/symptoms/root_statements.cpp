#include "diagnose/symptoms/root_shifts.hpp"
#include "measured/spectra/tail_probability.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace flexarm::diagnose {

namespace {

/// Poles, or zeros of one sensor; of all runs.
struct RootGroup {
  std::string name;
  std::optional<arm::Sensor> zero_of;
  std::vector<const RootShift*> shifts;
  double frequency_probability = 1.0;  ///< the least
  double damping_probability = 1.0;
};

std::vector<RootGroup> groups_of(const std::vector<RootShift>& shifts) {
  std::vector<RootGroup> groups;
  for (const RootShift& shift : shifts) {
    auto at = std::ranges::find(groups, shift.zero_of, &RootGroup::zero_of);
    if (at == groups.end()) {
      at = groups.insert(
          at,
          {shift.zero_of ? arm::to_string(*shift.zero_of) + " zeros" : "poles", shift.zero_of, {}});
    }
    at->shifts.push_back(&shift);
    const auto lower = [](double& least, const std::optional<RootNumber>& number) {
      if (number) least = std::min(least, measured::normal_tails(number->deviates()));
    };
    lower(at->frequency_probability, shift.frequency_Hz);
    lower(at->damping_probability, shift.damping_ratio);
  }
  return groups;
}

/// Of each order the run in which `number` is furthest off, where it is significantly.
template <class Number>
std::vector<std::string> moved(const RootGroup& group, std::size_t tests, Number number) {
  std::map<int, const RootShift*> furthest;
  for (const RootShift* shift : group.shifts) {
    const std::optional<RootNumber>& own = number(*shift);
    if (!own) continue;
    if (!symptom(SymptomKind::roots, "", measured::normal_tails(own->deviates()), tests)
             .is_significant) {
      continue;
    }
    const RootShift*& kept = furthest[shift->order];
    if (kept == nullptr || std::abs(own->deviates()) > std::abs(number(*kept)->deviates())) {
      kept = shift;
    }
  }
  std::vector<std::string> texts;
  for (const auto& [order, shift] : furthest) {
    const RootNumber& own = *number(*shift);
    const std::string shifted = own.before == 0.0 ? fmt::format("{:.2g}, baseline 0", own.measured)
                                                  : fmt::format("{:+.2g} %", own.shift_percent());
    texts.push_back(fmt::format("{}: {} ({:.0f} sigma, run {})", order, shifted,
                                std::abs(own.deviates()), shift->run));
  }
  return texts;
}

/// Within which the frequencies of a group are where the simulation has them [%].
double within_percent(const RootGroup& group) {
  double widest = 0.0;
  for (const RootShift* shift : group.shifts) {
    if (!shift->frequency_Hz) continue;
    const RootNumber& number = *shift->frequency_Hz;
    widest = std::max(widest,
                      std::abs(number.shift_percent()) + 200.0 * number.std_error / number.before);
  }
  return widest;
}

std::string group_text(const RootGroup& group, std::size_t tests) {
  const auto frequencies =
      moved(group, tests, [](const RootShift& shift) -> const std::optional<RootNumber>& {
        return shift.frequency_Hz;
      });
  const auto dampings =
      moved(group, tests, [](const RootShift& shift) -> const std::optional<RootNumber>& {
        return shift.damping_ratio;
      });
  std::string text =
      frequencies.empty()
          ? fmt::format("{}: frequencies agree with the simulation within {:.2g} %", group.name,
                        within_percent(group))
          : fmt::format("{}: shifted frequencies {}", group.name, fmt::join(frequencies, ", "));
  if (!dampings.empty()) {
    text += fmt::format("; shifted damping ratios {}", fmt::join(dampings, ", "));
  }
  return text + ".";
}

enum class Motion { unknown, stays, moves };

/// What moves and what stays says on which side of the root the cause is (docs/diagnosis.md).
std::string rule(Motion poles, Motion hub_zeros, Motion tip_zeros, bool damping_moves) {
  if (tip_zeros == Motion::moves) {
    return "Tip zeros are shifted. Hub, clamp and payload mass do not shift them. Candidates: link "
           "properties, payload inertia, payload offset.";
  }
  if (hub_zeros == Motion::moves && tip_zeros == Motion::stays) {
    return "Hub zeros are shifted, tip zeros are not. Candidates: payload mass, root compliance.";
  }
  if (hub_zeros == Motion::moves) {
    return "Hub zeros are shifted. Hub inertia, friction, hub spring, lag and gain do not shift "
           "them. Candidates: link, root compliance, payload.";
  }
  if (poles == Motion::moves && hub_zeros == Motion::stays) {
    return "Poles are shifted, hub zeros are not. Candidates: effects on the hub, such as its "
           "inertia or a spring.";
  }
  if (poles == Motion::stays && hub_zeros != Motion::moves && damping_moves) {
    return "Damping ratios are shifted, frequencies are not. Candidates: friction, damping.";
  }
  if (poles == Motion::stays && hub_zeros == Motion::stays) {
    return "No pole or zero is shifted. Candidates: gain, delay, lag, nonlinear effects.";
  }
  return "";
}

}  // namespace

std::vector<Symptom> root_symptoms(const std::vector<RootShift>& shifts) {
  std::vector<Symptom> made;
  std::size_t tests = 0;
  for (const RootShift& shift : shifts) {
    tests += (shift.frequency_Hz ? 1U : 0U) + (shift.damping_ratio ? 1U : 0U);
  }
  if (tests == 0) return made;
  Motion poles = Motion::unknown;
  Motion hub_zeros = Motion::unknown;
  Motion tip_zeros = Motion::unknown;
  bool damping_moves = false;
  double least_probability = 1.0;
  for (const RootGroup& group : groups_of(shifts)) {
    const double probability = std::min(group.frequency_probability, group.damping_probability);
    Symptom one = symptom(SymptomKind::roots, group_text(group, tests), probability, tests);
    if (group.zero_of) one.sensor = arm::to_string(*group.zero_of);
    made.push_back(std::move(one));
    least_probability = std::min(least_probability, probability);
    const bool moves =
        symptom(SymptomKind::roots, "", group.frequency_probability, tests).is_significant;
    damping_moves =
        damping_moves ||
        symptom(SymptomKind::roots, "", group.damping_probability, tests).is_significant;
    const auto put = [&](Motion& motion) {
      if (moves) {
        motion = Motion::moves;
      } else if (motion == Motion::unknown) {
        motion = Motion::stays;
      }
    };
    if (!group.zero_of) {
      put(poles);
    } else if (arm::is_collocated(*group.zero_of)) {
      put(hub_zeros);
    } else if (group.zero_of->kind == arm::SensorKind::tip_acceleration ||
               group.zero_of->kind == arm::SensorKind::tip_displacement) {
      put(tip_zeros);
    }
  }
  const std::string text = rule(poles, hub_zeros, tip_zeros, damping_moves);
  if (!text.empty()) {
    made.insert(made.begin(), symptom(SymptomKind::roots, text, least_probability, tests));
  }
  return made;
}

}  // namespace flexarm::diagnose
