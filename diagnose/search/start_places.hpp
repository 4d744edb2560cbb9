#pragma once

#include "diagnose/search/hypothesis.hpp"

#include <utility>
#include <vector>

namespace flexarm::diagnose {

/// Coordinates of the parameters of one effect, each a place in its range.
using StartPlaces = std::vector<double>;

/// Places over a range.
inline const std::vector<double> kSpreadPlaces = {0.15, 0.5, 0.85};
/// Middles of ten equal parts of a range.
inline const std::vector<double> kEvenPlaces = {0.05, 0.15, 0.25, 0.35, 0.45,
                                                0.55, 0.65, 0.75, 0.85, 0.95};

/// Returns a few values of a hypothesis' parameters to look at: of one parameter near the value at
/// which it does nothing and over its range; of several over their ranges, the size at its middle.
std::vector<StartPlaces> samples_of(const Hypothesis& hypothesis);

/// Returns samples_of an effect with a frequency, at these in the place of those over its range;
/// empty for other effects, and without one in its range.
std::vector<StartPlaces> samples_at(const Hypothesis& hypothesis,
                                    const std::vector<double>& frequencies_Hz);

/// Returns values to look at in the place of another effect at `values`, where one of the two is a
/// limit of the other: parameters that both have as they are, others over their ranges. Empty where
/// neither is, or they have no parameter in common.
std::vector<StartPlaces> samples_in_place(const Hypothesis& hypothesis, const Hypothesis& other,
                                          const std::vector<double>& values);

/// Returns the sizes that a change may have, the one at `places` being 1: those within the range of
/// the parameter that gives it, where that goes on both sides of the value at which it does
/// nothing, else 0.25 to 2.5.
std::pair<double, double> sizes_of(const Hypothesis& hypothesis, const StartPlaces& places);

/// Returns the parameters at which the effect does `size` times what it does at `places`.
std::vector<double> values_at(const Hypothesis& hypothesis, StartPlaces places, double size);
StartPlaces places_of(const Hypothesis& hypothesis, const std::vector<double>& values);

}  // namespace flexarm::diagnose
