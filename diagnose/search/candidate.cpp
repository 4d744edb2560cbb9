#include "diagnose/search/candidate.hpp"

#include "arm/uncertainties.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace flexarm::diagnose {

using Eigen::Index;

arm::Arm Candidate::extend(const arm::Arm& arm) const {
  arm::Arm made = arm::with_deviations(arm, nuisances);
  std::size_t at = 0;
  for (const Hypothesis& effect : effects) {
    const std::size_t count = effect.parameters.size();
    made = extended(made, effect, std::span(values).subspan(at, count));
    at += count;
  }
  return made;
}

std::vector<SearchedParameter> Candidate::parameters() const {
  std::vector<SearchedParameter> all;
  for (const Hypothesis& effect : effects) {
    all.insert(all.end(), effect.parameters.begin(), effect.parameters.end());
  }
  return all;
}

Eigen::VectorXd Candidate::coordinates() const {
  const std::vector<double> places = effects::coordinates_of(parameters(), values);
  Eigen::VectorXd made(std::ssize(nuisances) + std::ssize(places));
  made << Eigen::VectorXd::Map(nuisances.data(), std::ssize(nuisances)),
      Eigen::VectorXd::Map(places.data(), std::ssize(places));
  return made;
}

void Candidate::put(const Eigen::VectorXd& places) {
  const auto all = parameters();
  const auto first = static_cast<Index>(nuisances.size());
  Eigen::VectorXd::Map(nuisances.data(), first) = places.head(first);
  std::vector<double> of_values(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double place = places(first + static_cast<Index>(i));
    of_values[i] =
        all[i].periodic ? place - std::floor(place) : std::clamp(place, -kBeyond, 1.0 + kBeyond);
  }
  values = effects::values_at(all, of_values);
}

std::string Candidate::label() const {
  std::string text;
  for (const Hypothesis& effect : effects) text += (text.empty() ? "" : " + ") + effect.label();
  return text.empty() ? "nothing" : text;
}

std::set<std::string> Candidate::labels() const {
  std::set<std::string> all;
  for (const Hypothesis& effect : effects) all.insert(effect.label());
  return all;
}

bool Candidate::has(const Hypothesis& hypothesis) const {
  return std::ranges::any_of(effects, [&](const Hypothesis& own) {
    return own.effect == hypothesis.effect && own.sensor == hypothesis.sensor;
  });
}

bool Candidate::has_effect(const std::string& effect) const {
  return std::ranges::find(effects, effect, &Hypothesis::effect) != effects.end();
}

Candidate Candidate::with(const Hypothesis& hypothesis,
                          const std::vector<double>& its_values) const {
  Candidate made = *this;
  made.effects.push_back(hypothesis);
  made.values.insert(made.values.end(), its_values.begin(), its_values.end());
  return made;
}

Candidate Candidate::without(std::size_t index) const {
  Candidate made{.nuisances = nuisances};
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (i != index) made = made.with(effects[i], values_of(i));
  }
  return made;
}

std::size_t Candidate::values_before(std::size_t index) const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < index; ++i) count += effects[i].parameters.size();
  return count;
}

std::vector<double> Candidate::values_of(std::size_t index) const {
  const auto first = values.begin() + static_cast<std::ptrdiff_t>(values_before(index));
  return {first, first + static_cast<std::ptrdiff_t>(effects[index].parameters.size())};
}

}  // namespace flexarm::diagnose
