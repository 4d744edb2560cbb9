#pragma once

#include "diagnose/search/hypothesis.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace flexarm::diagnose {

/// The hypotheses of these effects, all where none are named. Throws InputError, which begins with
/// `option`, for an unknown effect, and for one that is not among the hypotheses.
std::vector<Hypothesis> chosen_hypotheses(const std::vector<std::string>& effects,
                                          std::vector<Hypothesis> all, std::string_view option);

/// The hypotheses without those that are excluded: effects by name ("sensor_gain"), or on one
/// sensor ("sensor_gain on tip_acceleration"). Throws InputError, which begins with `option`, for
/// an unknown effect or sensor, and where nothing is left to search for. An effect that is not
/// searched for anyway may be named.
std::vector<Hypothesis> without_excluded(std::vector<Hypothesis> all,
                                         const std::vector<std::string>& excluded,
                                         std::string_view option);

}  // namespace flexarm::diagnose
