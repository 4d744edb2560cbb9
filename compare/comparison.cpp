#include "compare/comparison.hpp"

#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "arm/rigid_hub.hpp"
#include "assumed_modes/basis_report.hpp"
#include "compare/damped_roots.hpp"
#include "compare/finding.hpp"
#include "compare/standard_models.hpp"
#include "response/arm_parts.hpp"
#include "response/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <stdexcept>

namespace flexarm::compare {

namespace {

void require_at_least(const char* key, int value, int least) {
  if (value < least) throw arm::out_of_range(key, value, "", fmt::format("{} or more", least));
}

void require_at_most(const char* key, int value, int most) {
  if (value > most) throw arm::out_of_range(key, value, "", fmt::format("{} or less", most));
}

void require_valid(const Options& options) {
  require_at_least("poles", options.poles, 1);
  require_at_least("zeros", options.non_collocated_zeros, 1);
  require_at_least("response_points", options.response_points, 2);
  arm::require_in_range("tolerance", options.root_tolerance, "", arm::kPositive);
  arm::require_in_range("shape_tolerance", options.shape_tolerance, "", arm::kPositive);
  arm::require_in_range("response_tolerance", options.response_tolerance, "", arm::kPositive);
  arm::require_in_range("accuracy", options.wanted_accuracy, "", arm::kPositive);
}

/// Counts steps and tells the caller.
class Steps {
 public:
  Steps(const Options& options, int total) : tell_(options.progress), total_(total) {}
  void advance() {
    ++done_;
    if (tell_) tell_(done_, total_);
  }

 private:
  std::function<void(int, int)> tell_;
  int total_;
  int done_ = 0;
};

/// A family and its exact roots, which refinement curves are held against.
struct ReferenceFamily {
  FeatureFamily family;
  std::vector<std::complex<double>> s_rad_per_s;
};

double frequency_Hz(std::complex<double> s_rad_per_s) {
  return std::abs(s_rad_per_s) / (2.0 * std::numbers::pi);
}

void add_roots(const std::vector<Subject>& subjects, const FeatureFamily& family,
               const Options& options, Comparison& comparison, Steps& steps) {
  std::vector<FeatureRoots> found;
  for (const auto& subject : subjects) {
    found.push_back(roots(subject.formulation, family));
    comparison.notes.push_back({subject.name, family,
                                static_cast<int>(found.back().s_rad_per_s.size()),
                                found.back().rejected, found.back().infinite, found.back().count});
    steps.advance();
  }
  const auto& reference = found.front().s_rad_per_s;
  std::vector<std::vector<std::optional<std::complex<double>>>> matched;
  for (const auto& each : found) matched.push_back(match(family, reference, each.s_rad_per_s));

  for (std::size_t i = 0; i < reference.size(); ++i) {
    RootRow row{family, static_cast<int>(i) + 1, {}, {}};
    for (const auto& values : matched) {
      row.s_rad_per_s.push_back(values[i]);
      row.distance.push_back(values[i] ? relative_distance(*values[i], reference[i]) : kMissing);
    }
    for (std::size_t a = 0; a < subjects.size(); ++a) {
      for (std::size_t b = a + 1; b < subjects.size(); ++b) {
        const bool both = matched[a][i] && matched[b][i];
        comparison.findings.push_back(
            {fmt::format("{} {}", label(family), i + 1), subjects[a].name, subjects[b].name,
             both ? relative_distance(*matched[b][i], *matched[a][i]) : kMissing,
             options.root_tolerance,
             std::max(stated_error(found[a], family, matched[a][i]),
                      stated_error(found[b], family, matched[b][i]))});
      }
    }
    comparison.roots.push_back(std::move(row));
  }
}

/// Puts the damped root of `subject` beside each undamped one of a family.
void add_damped(const Subject& subject, std::size_t k, const FeatureFamily& family,
                std::vector<RootRow>& rows) {
  std::vector<RootRow*> found;
  std::vector<std::complex<double>> undamped;
  for (RootRow& row : rows) {
    if (row.family != family) continue;
    row.damped.resize(row.s_rad_per_s.size());
    if (!row.s_rad_per_s[k]) continue;
    found.push_back(&row);
    undamped.push_back(*row.s_rad_per_s[k]);
  }
  if (family.zeros_of) {
    const auto pairs = zeros_with_damping(subject.formulation, *family.zeros_of, undamped);
    for (std::size_t i = 0; i < pairs.size(); ++i) found[i]->damped[k] = pairs[i];
    return;
  }
  const auto poles = response::damped_poles(subject.formulation, family.count).flexible;
  for (RootRow* row : found) {
    const auto place = static_cast<std::size_t>(row->order - 1);
    if (place < poles.size()) row->damped[k] = poles[place];
  }
}

void add_damped_roots(const std::vector<Subject>& subjects, const Options& options,
                      Comparison& comparison) {
  if (!arm::linear_arm(comparison.arm).is_damped()) return;
  for (std::size_t k = 0; k < subjects.size(); ++k) {
    for (const auto& family : families(options)) {
      add_damped(subjects[k], k, family, comparison.roots);
    }
    DampedRoots damped{{}, std::vector<std::vector<std::complex<double>>>(options.sensors.size())};
    for (const auto& row : comparison.roots) {
      if (!row.damped[k]) continue;
      const auto sensor = std::ranges::find(options.sensors, row.family.zeros_of);
      auto& roots =
          row.family.zeros_of
              ? damped.zeros_rad_per_s[static_cast<std::size_t>(sensor - options.sensors.begin())]
              : damped.poles_rad_per_s;
      std::ranges::move(with_conjugates(*row.damped[k]), std::back_inserter(roots));
    }
    comparison.damped.push_back(std::move(damped));
  }
}

void add_shapes(const std::vector<Subject>& subjects, const Options& options,
                Comparison& comparison, Steps& steps) {
  comparison.stations_m = shape_stations_m(arm::linear_arm(comparison.arm).length_m);
  for (const auto& subject : subjects) {
    comparison.modes.push_back(
        response::modes(subject.formulation, options.poles, {}, comparison.stations_m));
    steps.advance();
  }
  for (std::size_t b = 1; b < subjects.size(); ++b) {
    const auto rows =
        compare_shapes(subjects[b].name, comparison.modes.front(), comparison.modes[b]);
    comparison.shapes.insert(comparison.shapes.end(), rows.begin(), rows.end());
    for (const auto& row : rows) {
      comparison.findings.push_back({fmt::format("mode shape {}", row.order), subjects.front().name,
                                     row.formulation, row.largest_error, options.shape_tolerance});
    }
  }
}

/// Frequencies [Hz] of a sensor's zeros on the imaginary axis, at least those up to `highest_Hz`.
std::vector<double> imaginary_zeros_Hz(const response::AnyFormulation& formulation,
                                       const arm::Sensor& sensor, double highest_Hz, int count) {
  auto zeros = response::zeros(formulation, sensor, count).s_rad_per_s;
  while (std::ssize(zeros) == count && frequency_Hz(zeros.back()) < highest_Hz) {
    count *= 2;
    zeros = response::zeros(formulation, sensor, count).s_rad_per_s;
  }
  std::vector<double> frequencies_Hz;
  for (const auto s : zeros) {
    if (s.real() == 0.0) frequencies_Hz.push_back(frequency_Hz(s));
  }
  return frequencies_Hz;
}

void add_response(const std::vector<Subject>& subjects, const arm::Sensor& sensor,
                  const Options& options, Comparison& comparison, Steps& steps) {
  std::vector<double> poles_Hz;
  for (const auto& row : comparison.roots) {
    if (!row.family.zeros_of) poles_Hz.push_back(frequency_Hz(*row.s_rad_per_s.front()));
  }
  auto features_Hz =
      imaginary_zeros_Hz(subjects.front().formulation, sensor, poles_Hz.back(), options.poles + 2);
  features_Hz.insert(features_Hz.end(), poles_Hz.begin(), poles_Hz.end());
  std::vector<response::AnyFormulation> formulations;
  for (const auto& subject : subjects) formulations.push_back(subject.formulation);
  auto response = compare_responses(
      formulations, sensor, response_grid_Hz(poles_Hz, options.response_points, features_Hz),
      features_Hz);
  for (std::size_t b = 1; b < subjects.size(); ++b) {
    const double largest_at_Hz = response.largest_error_frequency_Hz[b];
    const std::string place =
        std::isfinite(largest_at_Hz) ? fmt::format(" at {:.4g} Hz", largest_at_Hz) : "";
    comparison.findings.push_back({fmt::format("{} response{}", arm::to_string(sensor), place),
                                   subjects.front().name, subjects[b].name,
                                   response.largest_error[b], options.response_tolerance});
  }
  comparison.responses.push_back(std::move(response));
  steps.advance();
}

Comparison compare_subjects(const std::vector<Subject>& subjects, const Options& options,
                            Steps& steps) {
  if (subjects.size() < 2) throw std::invalid_argument("a comparison needs at least two models");
  require_valid(options);
  Comparison comparison;
  comparison.arm = response::arm_of(subjects.front().formulation);
  comparison.wanted_accuracy = options.wanted_accuracy;
  for (const auto& sensor : options.sensors) arm::require_valid(sensor, comparison.arm);
  for (const auto& subject : subjects) {
    comparison.subjects.push_back(subject.name);
    comparison.settings.push_back(subject.settings);
    comparison.degrees_of_freedom.push_back(response::degrees_of_freedom(subject.formulation));
  }
  for (const auto& family : families(options)) {
    add_roots(subjects, family, options, comparison, steps);
  }
  add_damped_roots(subjects, options, comparison);
  add_shapes(subjects, options, comparison, steps);
  for (const auto& sensor : options.sensors) {
    add_response(subjects, sensor, options, comparison, steps);
  }
  comparison.verdict = judge(comparison.findings);
  return comparison;
}

/// The families whose convergence is studied: velocity is the angle's derivative and has its zeros.
std::vector<FeatureFamily> refined_families(const Options& options) {
  auto refined = families(options);
  std::erase_if(refined, [](const FeatureFamily& family) {
    return family.zeros_of && family.zeros_of->kind == arm::SensorKind::hub_velocity;
  });
  return refined;
}

/// The pole and the hub zero whose convergence the notes describe.
constexpr int kNotedRoot = 3;

std::vector<std::string> basis_notes(const arm::Arm& arm) {
  std::vector<std::string> notes;
  for (const auto basis : assumed_modes::kAllBases) {
    if (!assumed_modes::can_represent(basis, arm)) continue;
    // Without a payload these are the clamped-free shapes.
    if (basis == assumed_modes::Basis::clamped_with_payload && arm.payload == arm::Payload{}) {
      continue;
    }
    const auto report = assumed_modes::describe_convergence(arm, basis, kNotedRoot);
    notes.push_back(report.pole.sentence);
    notes.push_back(report.hub_zero.sentence);
  }
  return notes;
}

int steps_of(const Options& options, std::size_t subjects, std::size_t refinements) {
  return static_cast<int>(subjects * (families(options).size() + 1) + options.sensors.size() +
                          refinements * refined_families(options).size());
}

}  // namespace

std::vector<FeatureFamily> families(const Options& options) {
  std::vector<FeatureFamily> asked = {{std::nullopt, options.poles}};
  for (const auto& sensor : options.sensors) {
    asked.push_back(
        {sensor, arm::is_collocated(sensor) ? options.poles : options.non_collocated_zeros});
  }
  return asked;
}

std::vector<Subject> standard_subjects(const arm::Arm& arm, int roots) {
  std::vector<Subject> subjects;
  for (const Model& model : standard_models(roots)) {
    subjects.push_back({model.name, model.settings, model.make(arm)});
  }
  return subjects;
}

Comparison compare(const std::vector<Subject>& subjects, const Options& options) {
  Steps steps(options, steps_of(options, subjects.size(), 0));
  return compare_subjects(subjects, options, steps);
}

Comparison compare(const arm::Arm& whole, const Options& options) {
  require_valid(options);
  const arm::Arm arm = response::take_apart(whole).linear;
  if (!arm::has_beam(arm)) {
    Comparison without_models;
    without_models.arm = arm;
    return without_models;
  }
  require_at_most("poles", options.poles, response::kMostRoots);
  require_at_most("zeros", options.non_collocated_zeros, response::kMostRoots);
  const int roots = std::max(options.poles, options.non_collocated_zeros);
  const auto subjects = standard_subjects(arm, roots);
  const auto refinements =
      options.refinements ? standard_refinements(arm, roots) : std::vector<Refinement>{};
  Steps steps(options, steps_of(options, subjects.size(), refinements.size()));
  Comparison comparison = compare_subjects(subjects, options, steps);

  std::vector<ReferenceFamily> references;
  for (const auto& family : refined_families(options)) {
    references.push_back({family, {}});
    for (const auto& row : comparison.roots) {
      if (row.family == family) references.back().s_rad_per_s.push_back(*row.s_rad_per_s.front());
    }
  }
  for (const auto& refinement : refinements) {
    for (const auto& reference : references) {
      comparison.are_refinements_complete = !arm::is_over(options.deadline);
      if (!comparison.are_refinements_complete) return comparison;
      auto curves =
          refine(arm, refinement, reference.family, reference.s_rad_per_s, options.wanted_accuracy);
      std::ranges::move(curves, std::back_inserter(comparison.refinements));
      steps.advance();
    }
  }
  if (options.refinements && arm::linear_arm(arm).is_plain()) {
    comparison.basis_notes = basis_notes(arm);
  }
  return comparison;
}

}  // namespace flexarm::compare
