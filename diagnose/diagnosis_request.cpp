#include "diagnose/diagnosis_request.hpp"

#include "arm/input_error.hpp"
#include "diagnose/search/hypothesis_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace flexarm::diagnose {

namespace {

/// Empty: by evidence.
std::optional<PredictorKind> chosen_predictor(const DiagnosisRequest& request) {
  if (request.predictor == "auto") return std::nullopt;
  for (const auto kind : kPredictors) {
    if (request.predictor == to_string(kind)) return kind;
  }
  throw arm::InputError(
      fmt::format("{} {}: must be auto, output_error, closed_loop, grey_box, torque_balance, "
                  "driven_by_motion or frequency_response",
                  request.spelled("predictor"), arm::shown(request.predictor)));
}

Policy chosen_policy(const DiagnosisRequest& request) {
  Policy policy;
  for (const std::string& number : request.policy) {
    try {
      set_number(policy, number);
    } catch (const arm::InputError& error) {
      throw arm::InputError(fmt::format("{} {}", request.spelled("policy"), error.what()));
    }
  }
  return policy;
}

}  // namespace

Deadline deadline_of(const DiagnosisRequest& request, std::chrono::steady_clock::time_point begun) {
  return arm::deadline_of(request.time_limit_s, begun, request.spelled);
}

Experiment experiment_of(compare::Recording recording, const DiagnosisRequest& request,
                         const Deadline& deadline) {
  std::vector<measured::Fault> faults;
  for (const auto& check : request.accepted) {
    try {
      faults.push_back(measured::fault_of_check(check));
    } catch (const arm::InputError& error) {
      throw arm::InputError(fmt::format("{} {}", request.spelled("accept"), error.what()));
    }
  }
  return experiment_of(std::move(recording), faults, deadline);
}

void require_valid(const DiagnosisRequest& request) {
  if (request.most_causes && *request.most_causes < 1) {
    throw arm::out_of_range(request.spelled("max-causes"), *request.most_causes, "", "1 or more");
  }
  chosen_predictor(request);
  chosen_policy(request);
}

Diagnosis diagnose(const Experiment& experiment, const DiagnosisRequest& request,
                   const Deadline& deadline, const DiagnosisProgress& progress) {
  require_valid(request);
  const auto hypotheses_left = without_excluded(
      chosen_hypotheses(request.effects, hypotheses(experiment), request.spelled("effects")),
      request.excluded, request.spelled("exclude"));
  SelectionOptions options;
  options.most_causes = request.most_causes;
  options.predictor = chosen_predictor(request);
  options.policy = chosen_policy(request);
  if (deadline) {
    options.deadline = std::max(*halfway(deadline), *deadline - kReportTime);
    options.last = *deadline + kReportTime;
  }
  Diagnosis diagnosis;
  try {
    diagnosis = diagnose(experiment, hypotheses_left, options, progress);
  } catch (const Cancelled&) {
    throw arm::InputError(
        fmt::format("{} = {:g} s: the arm as filed could not be simulated within the limit; raise "
                    "it",
                    request.spelled("time-limit"), request.time_limit_s.value_or(0.0)));
  }
  diagnosis.excluded = request.excluded;
  diagnosis.time_limit_s = request.time_limit_s;
  return diagnosis;
}

bool has_extended_arm(const Diagnosis& diagnosis) {
  return !diagnosis.search_end || !diagnosis.causes.empty();
}

}  // namespace flexarm::diagnose
