#include "diagnose/search/start_places.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace flexarm::diagnose {

namespace {

/// Sizes of the change that a value makes, where its range does not bound them.
constexpr double kLeastSize = 0.25;
constexpr double kMostSize = 2.5;
constexpr double kMiddle = 0.5;

/// Places in the range of its one parameter. Beside a value within the range at which it does
/// nothing: next to it the change is its direction, and further off, on either side, that of an
/// effect that is larger. Where there is no such value, no size can be predicted from a change:
/// places all over the range. Else the middle, and near to where it does nothing.
std::vector<double> first_places(const SearchedParameter& parameter) {
  const auto neutral = parameter.neutral_coordinate();
  if (!neutral) return kEvenPlaces;
  if (parameter.spacing == effects::Spacing::about_zero) {
    return {parameter.coordinate(0.75 * parameter.lowest),
            *neutral + kSpreadPlaces.front() * (1.0 - *neutral),
            *neutral + kMiddle * (1.0 - *neutral)};
  }
  if (*neutral > 0.0 && *neutral < 1.0) {
    std::vector<double> places;
    for (const double change : {0.004, -0.03, 0.03}) places.push_back(*neutral + change);
    std::erase_if(places, [](double place) { return place <= 0.0 || place >= 1.0; });
    return places;
  }
  return {*neutral < kMiddle ? kSpreadPlaces.front() : kSpreadPlaces.back(), kMiddle};
}

/// The place at which a parameter does `size` times what it does at `place`. From or about zero an
/// effect is proportional to the value, from infinity to its reciprocal.
double place_at(const SearchedParameter& parameter, double place, double size) {
  switch (parameter.spacing) {
    case effects::Spacing::from_zero:
    case effects::Spacing::about_zero:
      return parameter.coordinate(size * parameter.value(place));
    case effects::Spacing::from_infinity:
      return parameter.coordinate(parameter.value(place) / size);
    case effects::Spacing::linear:
    case effects::Spacing::logarithmic:
      break;
  }
  const auto neutral = parameter.neutral_coordinate();
  return neutral ? *neutral + size * (place - *neutral) : place;
}

/// Returns all combinations of places, a list of them for each parameter; the last one varies
/// first.
std::vector<StartPlaces> all_of(const std::vector<std::vector<double>>& places) {
  std::vector<StartPlaces> combinations = {{}};
  for (const std::vector<double>& of_one : places) {
    std::vector<StartPlaces> longer;
    for (const StartPlaces& begun : combinations) {
      for (const double place : of_one) {
        longer.push_back(begun);
        longer.back().push_back(place);
      }
    }
    combinations = std::move(longer);
  }
  return combinations;
}

/// Returns places of each of several parameters over its range, the size at its middle.
std::vector<std::vector<double>> spread_places(const Hypothesis& hypothesis) {
  std::vector<std::vector<double>> places(hypothesis.parameters.size(), kSpreadPlaces);
  if (const auto along = hypothesis.place_parameter()) places[*along] = {0.1, 0.3, 0.5, 0.7, 0.9};
  if (const auto sized = hypothesis.size_parameter()) places[*sized] = {kMiddle};
  return places;
}

}  // namespace

std::vector<StartPlaces> samples_of(const Hypothesis& hypothesis) {
  const std::vector<SearchedParameter>& parameters = hypothesis.parameters;
  if (parameters.size() == 1) return all_of({first_places(parameters.front())});
  return all_of(spread_places(hypothesis));
}

std::vector<StartPlaces> samples_at(const Hypothesis& hypothesis,
                                    const std::vector<double>& frequencies_Hz) {
  const auto frequency = std::ranges::find(
      hypothesis.parameters, std::string("Hz"),
      [&](const SearchedParameter& parameter) { return hypothesis.unit_of(parameter); });
  if (frequency == hypothesis.parameters.end()) return {};
  std::vector<double> at;
  for (const double frequency_Hz : frequencies_Hz) {
    if (frequency_Hz > frequency->lowest && frequency_Hz < frequency->highest) {
      at.push_back(frequency->coordinate(frequency_Hz));
    }
  }
  if (at.empty()) return {};
  auto places = spread_places(hypothesis);
  places[static_cast<std::size_t>(frequency - hypothesis.parameters.begin())] = at;
  return all_of(places);
}

std::vector<StartPlaces> samples_in_place(const Hypothesis& hypothesis, const Hypothesis& other,
                                          const std::vector<double>& values) {
  if (!hypothesis.contains(other.effect) && !other.contains(hypothesis.effect)) return {};
  std::vector<std::vector<double>> places(hypothesis.parameters.size(), kSpreadPlaces);
  bool has_common = false;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const SearchedParameter& parameter = hypothesis.parameters[i];
    const auto same = std::ranges::find(other.parameters, parameter.name, &SearchedParameter::name);
    if (same == other.parameters.end() || parameter.above_previous) continue;
    const auto at = static_cast<std::size_t>(same - other.parameters.begin());
    places[i] = {parameter.coordinate(values[at])};
    has_common = true;
  }
  return has_common ? all_of(places) : std::vector<StartPlaces>{};
}

std::pair<double, double> sizes_of(const Hypothesis& hypothesis, const StartPlaces& places) {
  const auto sized = hypothesis.size_parameter();
  const double neutral = sized ? *hypothesis.parameters[*sized].neutral_coordinate() : 0.0;
  if (!(neutral > 0.0 && neutral < 1.0)) return {kLeastSize, kMostSize};
  const SearchedParameter& parameter = hypothesis.parameters[*sized];
  if (parameter.spacing == effects::Spacing::about_zero) {
    const double value = parameter.value(places[*sized]);
    return std::minmax(parameter.lowest / value, parameter.highest / value);
  }
  const double change = places[*sized] - neutral;
  return std::minmax(-neutral / change, (1.0 - neutral) / change);
}

std::vector<double> values_at(const Hypothesis& hypothesis, StartPlaces places, double size) {
  if (const auto sized = hypothesis.size_parameter()) {
    double& place = places[*sized];
    place = std::clamp(place_at(hypothesis.parameters[*sized], place, size), 0.0, 1.0);
  }
  return effects::values_at(hypothesis.parameters, places);
}

StartPlaces places_of(const Hypothesis& hypothesis, const std::vector<double>& values) {
  return effects::coordinates_of(hypothesis.parameters, values);
}

}  // namespace flexarm::diagnose
