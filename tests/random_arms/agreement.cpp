#include "tests/random_arms/agreement.hpp"

#include "arm/input_error.hpp"
#include "compare/comparison.hpp"
#include "compare/features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>

namespace flexarm::random_arms {

namespace {

constexpr int kPoles = 10;

struct Answer {
  std::string formulation;
  std::vector<compare::FeatureRoots> roots;  ///< [family]
};

void add_findings(const compare::FeatureFamily& family, std::size_t number,
                  const std::vector<Answer>& answers, std::vector<compare::Finding>& findings) {
  for (std::size_t a = 0; a < answers.size(); ++a) {
    for (std::size_t b = a + 1; b < answers.size(); ++b) {
      const auto& first = answers[a].roots[number].s_rad_per_s;
      const auto matched = compare::match(family, first, answers[b].roots[number].s_rad_per_s);
      for (std::size_t i = 0; i < first.size(); ++i) {
        findings.push_back(
            {fmt::format("{} {}", label(family), i + 1), answers[a].formulation,
             answers[b].formulation,
             matched[i] ? compare::relative_distance(*matched[i], first[i]) : compare::kMissing,
             kRootTolerance,
             std::max(compare::stated_error(answers[a].roots[number], family, first[i]),
                      compare::stated_error(answers[b].roots[number], family, matched[i]))});
      }
    }
  }
}

}  // namespace

Agreement agreement_of(const arm::Arm& arm) {
  return agreement_of(arm, compare::standard_models(kPoles));
}

Agreement agreement_of(const arm::Arm& arm, const std::vector<compare::Model>& models) {
  compare::Options options;
  options.poles = kPoles;
  options.sensors = {{arm::SensorKind::hub_angle, 0.0}, {arm::SensorKind::tip_acceleration, 0.0}};
  const auto families = compare::families(options);
  Agreement agreement;
  std::vector<Answer> answers;
  for (const compare::Model& model : models) {
    Answer answer{model.name, {}};
    try {
      const auto formulation = model.make(arm);
      for (const auto& family : families)
        answer.roots.push_back(compare::roots(formulation, family));
      answers.push_back(std::move(answer));
    } catch (const arm::InputError& error) {
      agreement.refusals.push_back({model.name, error.what()});
      if (agreement.outcome == Outcome::agree) agreement.outcome = Outcome::refused;
    } catch (const std::exception& error) {
      agreement.refusals.push_back({model.name, error.what()});
      agreement.outcome = Outcome::failed;
    }
  }
  std::vector<compare::Finding> findings;
  for (std::size_t k = 0; k < families.size(); ++k) add_findings(families[k], k, answers, findings);
  if (findings.empty()) return agreement;
  const compare::Verdict verdict = compare::judge(findings);
  agreement.worst = verdict.worst;
  agreement.alone = verdict.alone;
  if (verdict.agree || agreement.outcome == Outcome::failed) return agreement;
  const bool is_silent = std::ranges::any_of(findings, [](const compare::Finding& finding) {
    const bool agrees = finding.distance <= kRootTolerance || finding.distance <= finding.stated;
    return !agrees && !std::isinf(finding.stated);
  });
  agreement.outcome = is_silent ? Outcome::disagree : Outcome::stated;
  return agreement;
}

}  // namespace flexarm::random_arms
