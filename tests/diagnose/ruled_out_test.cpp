// What looks at a part of the data rule out: nothing that a search without them names.

#include "diagnose/search/selection.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <ostream>
#include <set>
#include <string>
#include <vector>

namespace flexarm::diagnose {
namespace {

/// Nothing is ruled out by a score test, by a share, or by being far from the best.
SelectionOptions exhaustive() {
  constexpr std::size_t kAll = SetGrowth::kAll;
  constexpr double kAnyTimes = 1e9;
  SelectionOptions options;
  options.single_effects = {.refitted = kAll};
  options.early_growth = {.bases = 16};
  options.coarse_growth = {.bases = 8};
  options.early_sets = kAll;
  options.sets_refitted = 24;
  options.far_sets_refitted = 24;
  options.effects_beside = {.looks = kAll, .refitted = 24};
  options.general_effects = {.looks = kAll, .refitted = 24};
  options.largest_of_looks = kAnyTimes;
  options.largest_of_general = kAnyTimes;
  options.general_gain = 1.0;
  options.least_law_share = 0.0;
  options.least_share_ahead = 0.0;
  return options;
}

struct HiddenCauses {
  std::string name;
  arm::Effects effects;
};
void PrintTo(const HiddenCauses& hidden, std::ostream* out) {
  *out << hidden.name;
}

/// Hidden effects in runs of 1.5 s, looked for among twelve.
class RuledOutEffects : public testing::TestWithParam<HiddenCauses> {
 protected:
  Selection selected(const SelectionOptions& options) const {
    return select(Problem(experiment_),
                  named(experiment_, {"actuator_lag", "attached_mass", "coulomb_friction",
                                      "drive_compliance", "flexural_rigidity", "hub_inertia",
                                      "hub_viscous_friction", "linear_density", "payload_mass",
                                      "root_compliance", "stribeck_friction", "torque_bias"}),
                  options);
  }

  const Experiment experiment_ = simulated_experiment(GetParam().effects, {.duration_s = 1.5});
};

TEST_P(RuledOutEffects, AreNoneThatAnExhaustiveSearchNames) {
  const Selection made = selected({});
  const std::set<std::string> hidden = [&] {
    std::set<std::string> names;
    for (const auto& effect : GetParam().effects) names.insert(effect.first);
    return names;
  }();
  EXPECT_EQ(made.chosen.fit.candidate.labels(), hidden);
  EXPECT_EQ(selected(exhaustive()).chosen.fit.candidate.labels(), hidden);
  // What is ruled out is listed.
  ASSERT_FALSE(made.ruled_out.empty());
  EXPECT_TRUE(std::ranges::is_sorted(made.ruled_out, std::ranges::greater{}, &RuledOut::share));
  for (const RuledOut& effect : made.ruled_out) {
    EXPECT_GE(effect.share, 0.0) << effect.effect;
    EXPECT_LE(effect.share, 1.0) << effect.effect;
    const bool is_fitted = std::ranges::any_of(made.singles, [&](const Explanation& single) {
      return single.fit.candidate.label() == effect.effect;
    });
    EXPECT_FALSE(is_fitted) << effect.effect;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Selection, RuledOutEffects,
    testing::Values(HiddenCauses{"one", {effects::named("hub_inertia", {{"factor", 1.1}})}},
                    HiddenCauses{"two",
                                 {effects::named("linear_density", {{"factor", 0.8}}),
                                  effects::named("hub_inertia", {{"factor", 1.3}})}},
                    HiddenCauses{"friction",
                                 {effects::named("coulomb_friction", {{"torque", 0.006}}),
                                  effects::named("root_compliance", {{"stiffness", 900.0}})}}),
    [](const testing::TestParamInfo<HiddenCauses>& of) { return of.param.name; });

}  // namespace
}  // namespace flexarm::diagnose
