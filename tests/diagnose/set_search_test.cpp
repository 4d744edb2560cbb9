#include "diagnose/search/set_search.hpp"

#include "diagnose/search/evidence_of_fit.hpp"
#include "diagnose/search/moves.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace flexarm::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kCoulomb_N_m = 0.02;
constexpr double kMass_kg = 0.005;

/// A friction and a payload are hidden.
class RankedTest : public testing::Test {
 protected:
  const Hypothesis& hypothesis(const std::string& effect) const {
    return *std::ranges::find(hypotheses_, effect, &Hypothesis::effect);
  }
  double cost_of(const Candidate& candidate) const { return likelihood_.cost_of(candidate); }
  Candidate friction(double torque_N_m) const {
    return problem_.as_filed().with(hypothesis("coulomb_friction"), {torque_N_m});
  }

  const Experiment experiment_ =
      simulated_experiment({effects::named("coulomb_friction", {{"torque", kCoulomb_N_m}}),
                            effects::named("payload_mass", {{"mass", kMass_kg}})},
                           {.duration_s = 0.5});
  const Problem problem_ = Problem(experiment_);
  const Likelihood likelihood_ = Likelihood(problem_, problem_.estimation_runs());
  const std::vector<Hypothesis> hypotheses_ =
      named(experiment_, {"coulomb_friction", "hub_spring", "payload_mass", "time_delay"});
  ReportedWork work_ = ReportedWork({});
};

TEST_F(RankedTest, LinesKeepTheSumOfSquares) {
  const auto residuals = problem_.residuals(problem_.as_filed(), problem_.estimation_runs());
  const VectorXd lines = likelihood_.lines(*residuals);
  // Rounding of a transform of some thousand samples.
  EXPECT_NEAR(lines.norm() / residuals->norm(), 1.0, 1e-12);
}

TEST_F(RankedTest, LinesOfACosineAreOneLine) {
  const ObservedChannel& channel = problem_.observations().channels.front();
  VectorXd residuals = VectorXd::Zero(problem_.residual_count());
  constexpr Index kLine = 7;
  const auto n = static_cast<double>(channel.count);
  for (Index k = 0; k < channel.count; ++k) {
    residuals(channel.first + k) = std::cos(std::numbers::pi * static_cast<double>(kLine) *
                                            (static_cast<double>(k) + 0.5) / n);
  }
  const VectorXd lines = likelihood_.lines(residuals);
  EXPECT_NEAR(lines(channel.first + kLine), std::sqrt(n / 2.0), 1e-9 * n);
  EXPECT_NEAR(lines.norm(), std::sqrt(n / 2.0), 1e-9 * n);
}

TEST_F(RankedTest, APeakIsTheLineWithMostOfItsOctave) {
  const ObservedChannel& channel = problem_.observations().channels.front();
  VectorXd lines = VectorXd::Ones(problem_.residual_count());
  lines(channel.first + 10) = 20.0;
  lines(channel.first + 100) = 15.0;
  const auto& record = std::get<measured::TimeRecord>(experiment_.runs[channel.run].data);
  const double line_Hz =
      0.5 / (measured::sampling_period_s(record) * static_cast<double>(channel.count));
  const std::vector<double> peaks_Hz = likelihood_.peaks_Hz(lines, 2);
  ASSERT_EQ(peaks_Hz.size(), 2u);
  EXPECT_NEAR(peaks_Hz[0] / line_Hz, 10.0, 1e-9);
  EXPECT_NEAR(peaks_Hz[1] / line_Hz, 100.0, 1e-9);
}

TEST_F(RankedTest, WeightsAreTheDerivativesOfTheCost) {
  const auto residuals = problem_.residuals(problem_.as_filed(), problem_.estimation_runs());
  const VectorXd squares = likelihood_.lines(*residuals).cwiseAbs2();
  const VectorXd weights = likelihood_.weights(squares.cwiseSqrt());
  for (const Index line : {Index{3}, Index{60}, Index{200}}) {
    VectorXd more = squares;
    const double change = 1e-5 / weights(line);
    more(line) += change;
    const double slope =
        (likelihood_.cost_of_squares(more) - likelihood_.cost_of_squares(squares)) / change;
    // The difference of two costs of some 1e4 has a rounding error of 1e-12 over a change of 1e-5.
    EXPECT_NEAR(slope / weights(line), 1.0, 1e-4) << line;
  }
}

TEST_F(RankedTest, CostRanksWhateverTheNoiseIs) {
  // With half of the friction noise is far from reached, and it is better than none.
  const auto cost = [&](double torque_N_m) {
    return cost_of(friction(torque_N_m).with(hypothesis("payload_mass"), {kMass_kg}));
  };
  EXPECT_LT(cost(kCoulomb_N_m), cost(0.5 * kCoulomb_N_m));
  EXPECT_LT(cost(0.5 * kCoulomb_N_m), cost(0.0));
}

TEST_F(RankedTest, MovesHaveEachEffectOnce) {
  // Of one family: what one changes is computed in the place of the other.
  const auto frictions = named(experiment_, {"coulomb_friction", "stribeck_friction"});
  const Candidate both = problem_.as_filed()
                             .with(frictions[0], {0.5 * kCoulomb_N_m})
                             .with(frictions[1], {0.2 * kCoulomb_N_m, 0.4 * kCoulomb_N_m, 0.1});
  const ScoredFit base = scored_fit(likelihood_, both, work_, {.most_steps = 1});
  const std::vector<Move> moves = moves_of(likelihood_, base, frictions, work_);
  ASSERT_FALSE(moves.empty());
  for (const Move& move : moves) {
    const Candidate set = move.of(base.candidate);
    EXPECT_EQ(set.labels().size(), set.effects.size()) << set.label();
  }
}

TEST_F(RankedTest, ABandCountsByItsSampleSize) {
  const ObservedChannel& channel = problem_.observations().channels.front();
  VectorXd lines = VectorXd::Zero(problem_.residual_count());
  lines.segment(channel.first, channel.count).setConstant(1e6);
  // The derivative of m ln S is m/S; the highest octave has half of the lines.
  const Index lines_of_octave = channel.count / 2;
  const double squares = 1e12 * static_cast<double>(lines_of_octave);
  const double weight = likelihood_.weights(lines)(channel.first + channel.count - 1);
  // The samples that are left out of the transform are few.
  EXPECT_NEAR(weight * squares, Policy{}.sample_size, 0.1 * Policy{}.sample_size);
}

TEST_F(RankedTest, AFitEndsWhereTheCostIsLeast) {
  const ScoredFit fit = scored_fit(likelihood_, friction(0.3 * kCoulomb_N_m), work_);
  ASSERT_TRUE(fit.is_possible());
  EXPECT_TRUE(fit.converged);
  const VectorXd places = fit.candidate.coordinates();
  for (const double step : {-0.01, 0.01}) {
    Candidate beside = fit.candidate;
    beside.put(places.array() + step);
    EXPECT_GT(cost_of(beside), fit.cost - MinimiseOptions{}.tolerance) << step;
  }
}

TEST_F(RankedTest, AFitThatBeginsWithOtherDerivativesEndsAtTheSame) {
  const ScoredFit base = scored_fit(likelihood_, friction(kCoulomb_N_m), work_);
  const Candidate start = friction(0.7 * kCoulomb_N_m).with(hypothesis("payload_mass"), {0.003});
  const ScoredFit exact = scored_fit(likelihood_, start, work_);
  const ScoredFit begun = scored_fit(likelihood_, start, work_, {}, &base);
  EXPECT_TRUE(begun.converged);
  // The tolerance of either fit, and the price of derivatives by differences.
  EXPECT_NEAR(begun.score, exact.score, 2.0 * MinimiseOptions{}.tolerance + 0.01);
}

TEST_F(RankedTest, TheBestMoveAddsWhatIsHidden) {
  const ScoredFit base = scored_fit(likelihood_, friction(kCoulomb_N_m), work_);
  const std::vector<Move> moves = moves_of(likelihood_, base, hypotheses_, work_);
  // Three effects added or in the place of the friction, and none.
  ASSERT_EQ(moves.size(), 7u);
  const Move& best = moves.front();
  ASSERT_NE(best.added, nullptr);
  EXPECT_EQ(best.added->effect, "payload_mass");
  EXPECT_FALSE(best.dropped);
  // The change of a payload is nearly in proportion to it.
  EXPECT_NEAR(best.values.front() / kMass_kg, 1.0, 0.3);
  EXPECT_LT(best.score, base.score);
}

TEST_F(RankedTest, ASwapIsPredictedForTheEffectInTheWrongPlace) {
  const Candidate wrong = friction(kCoulomb_N_m).with(hypothesis("hub_spring"), {0.1});
  const ScoredFit base = scored_fit(likelihood_, wrong, work_);
  const std::vector<Move> moves = moves_of(likelihood_, base, hypotheses_, work_);
  const auto swap = std::ranges::find_if(moves, [](const Move& move) {
    return move.dropped == 1u && move.added != nullptr && move.added->effect == "payload_mass";
  });
  ASSERT_NE(swap, moves.end());
  EXPECT_LT(swap->score, base.score);
  EXPECT_EQ(swap->of(base.candidate).labels(),
            (std::set<std::string>{"coulomb_friction", "payload_mass"}));
}

TEST_F(RankedTest, FindsBothEffectsAndNoOther) {
  const FoundSets sets = search_sets(likelihood_, hypotheses_, {}, work_);
  ASSERT_TRUE(sets.is_complete);
  const Candidate& best = sets.best.front().candidate;
  EXPECT_EQ(best.labels(), (std::set<std::string>{"coulomb_friction", "payload_mass"}));
  for (std::size_t i = 0; i < best.effects.size(); ++i) {
    const bool is_mass = best.effects[i].effect == "payload_mass";
    const double hidden = is_mass ? kMass_kg : kCoulomb_N_m;
    EXPECT_NEAR(best.values_of(i).front() / hidden, 1.0, 0.05) << best.effects[i].effect;
  }
}

TEST(LikelihoodTest, NoiseIsLeftByTheHiddenEffectAlone) {
  // Long enough for the noise floor of the acceleration to be known to a tenth.
  const Experiment experiment = simulated_experiment(
      {effects::named("coulomb_friction", {{"torque", kCoulomb_N_m}})}, {.duration_s = 4.0});
  const Problem problem(experiment);
  const Likelihood likelihood(problem, problem.estimation_runs());
  const Hypothesis friction = named(experiment, {"coulomb_friction"}).front();
  const auto is_noise = [&](double torque_N_m) {
    return likelihood.is_noise(
        likelihood.lines_of(problem.as_filed().with(friction, {torque_N_m})).value());
  };
  EXPECT_TRUE(is_noise(kCoulomb_N_m));
  EXPECT_FALSE(is_noise(0.9 * kCoulomb_N_m));
  EXPECT_FALSE(is_noise(0.0));
}

TEST_F(RankedTest, EvidenceIsWhatIsLostWithoutAnEffect) {
  const ScoredFit both = scored_fit(
      likelihood_, friction(kCoulomb_N_m).with(hypothesis("payload_mass"), {kMass_kg}), work_);
  std::vector<ScoredFit> without;
  for (const std::size_t i : {0u, 1u}) {
    without.push_back(scored_fit(likelihood_, both.candidate.without(i), work_));
  }
  const Likelihood held_out(problem_, problem_.validation_runs());
  const auto evidence = evidence_for_each(held_out, both, without, work_);
  ASSERT_EQ(evidence.size(), 2u);
  for (const EffectEvidence& one : evidence) {
    EXPECT_GT(one.estimation, Policy{}.beyond_doubt);
    EXPECT_GT(one.held_out.value(), Policy{}.beyond_doubt);
    EXPECT_GT(one.error_increase, 2.0 * one.error_increase_std_error);
    EXPECT_GT(one.error_without, one.error_increase);
    EXPECT_GT(one.agreement, Policy{}.least_agreement);
    EXPECT_GE(one.runs.size(), 2u);
    EXPECT_EQ(grade_of(one, false, true), Grade::established);
  }
  for (const RunEstimate& run : evidence.front().runs) {
    // Four standard errors and the step from one minimum to that of a run.
    EXPECT_NEAR(run.values.front(), kCoulomb_N_m, 4.0 * run.std_errors.front() + 1e-4);
  }
}

TEST(SetSearch, FindsTheShapeOfAnEffectThatSeveralSimpleOnesImitate) {
  const arm::Effects hidden = {effects::named(
      "tuned_mass",
      {{"mass", 0.003}, {"frequency", 30.0}, {"damping_ratio", 0.02}, {"position", 0.3}})};
  const Experiment experiment = simulated_experiment(hidden, {.duration_s = 1.0});
  const Problem problem(experiment);
  const Likelihood likelihood(problem, problem.estimation_runs());
  ReportedWork work({});
  const FoundSets sets =
      search_sets(likelihood,
                  named(experiment, {"tuned_mass", "hub_inertia", "beam_length", "linear_density",
                                     "payload_mass", "flexural_rigidity", "root_compliance"}),
                  {}, work);
  const Candidate& best = sets.best.front().candidate;
  ASSERT_EQ(best.label(), "tuned_mass");
  EXPECT_NEAR(best.values[1], 30.0, 1.0);
}

TEST(SetSearch, FindsTheFrequencyOfATorqueBesideResonances) {
  const Experiment experiment = simulated_experiment(
      {effects::named("disturbance_torque",
                      {{"amplitude", 0.01}, {"frequency", 17.3}, {"phase", 1.1}})},
      {.duration_s = 2.0});
  const Problem problem(experiment);
  const Likelihood likelihood(problem, problem.estimation_runs());
  ReportedWork work({});
  // From the arm as filed, and from a frequency that is another one's minimum.
  const auto hypotheses = named(experiment, {"disturbance_torque"});
  const std::vector<Candidate> starts = {
      problem.as_filed().with(hypotheses.front(), {0.005, 11.9, 3.0})};
  for (const SearchBounds& bounds : {SearchBounds{}, SearchBounds{.starts = starts}}) {
    const FoundSets found = search_sets(likelihood, hypotheses, bounds, work);
    const Candidate& best = found.best.front().candidate;
    ASSERT_EQ(best.effects.size(), 1u);
    EXPECT_NEAR(best.values_of(0)[1], 17.3, 0.02);  // a twentieth of what 2 s resolve
  }
}

TEST(SetSearch, FindsNothingWhereNothingIsHidden) {
  const Experiment experiment = simulated_experiment({}, {.duration_s = 1.0});
  const Problem problem(experiment);
  const Likelihood likelihood(problem, problem.estimation_runs());
  ReportedWork work({});
  const FoundSets sets = search_sets(likelihood, hypotheses(experiment), {}, work);
  EXPECT_EQ(sets.best.front().candidate.label(), "nothing");
}

TEST(Grade, NeedsHeldOutDataAndForTheHighestAllElse) {
  EffectEvidence evidence{.held_out = 2.0 * Policy{}.beyond_doubt,
                          .error_increase = 0.03,
                          .error_increase_std_error = 0.01,
                          .agreement = 0.5};
  EXPECT_EQ(grade_of(evidence, false, true), Grade::established);
  EXPECT_EQ(grade_of(evidence, true, true), Grade::supported);
  EXPECT_EQ(grade_of(evidence, false, false), Grade::supported);
  evidence.agreement = 0.1 * Policy{}.least_agreement;
  EXPECT_EQ(grade_of(evidence, false, true), Grade::supported);
  evidence.error_increase_std_error = 0.02;
  EXPECT_EQ(grade_of(evidence, false, true), Grade::candidate);
  evidence.error_increase_std_error = 0.01;
  evidence.held_out = 0.5 * Policy{}.beyond_doubt;
  EXPECT_EQ(grade_of(evidence, false, true), Grade::candidate);
  evidence.held_out.reset();
  EXPECT_EQ(grade_of(evidence, false, true), Grade::candidate);
}

TEST(SetSearch, EndsWhereTheWorkIsCancelled) {
  const Experiment experiment = simulated_experiment({}, {.duration_s = 1.0});
  const Problem problem(experiment);
  const Likelihood likelihood(problem, problem.estimation_runs());
  ReportedWork work([](std::string_view, double) { return false; });
  EXPECT_THROW(search_sets(likelihood, hypotheses(experiment), {}, work), Cancelled);
}

}  // namespace
}  // namespace flexarm::diagnose
