#include "measured/checks/run_check.hpp"

#include "measured/checks/data_check_described.hpp"
#include "measured/checks/other_arms.hpp"
#include "measured/checks/run_check_noise.hpp"
#include "measured/checks/run_check_signals.hpp"
#include "measured/spectra/robust.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

namespace flexarm::measured {

namespace {

constexpr std::size_t kMostComparedSamples = 4096;
constexpr std::size_t kFewestComparedSamples = 128;
/// Payloads are compared by this share of the beam's mass plus their own: a beam hardly feels less.
constexpr double kFelt = 0.1;
constexpr double kFirstStep = 1.15;
constexpr double kGridStep = 1.25;
constexpr int kGridReach = 12;  // 1.25^12 = 14.6
constexpr int kPayloadRefinements = 8;
/// Factor between payloads that counts as another, and one that does not.
constexpr double kOther = 1.3;
constexpr double kSame = 1.12;
/// Of what the described arm explains, the least share that a payload must add to be believed, and
/// the most that the stated one may lack.
constexpr double kBetter = 0.02;
constexpr double kAsGood = 0.01;
/// By how much a payload must bring the arm nearer to be believed.
constexpr double kNearer = 0.003;
/// A run that is farther with every payload says nothing: the described arm explains next
/// to nothing of it.
constexpr double kFarthest = 0.955;

/// A run beside the described arm with any payload.
class PayloadSearch {
 public:
  PayloadSearch(const CheckedRun& run, const DescribedArms& arms, const arm::Deadline& deadline)
      : run_(run),
        arms_(arms),
        deadline_(deadline),
        felt_kg_(kFelt * arms.beam_mass_kg),
        compared_(signals_of(run, kMostComparedSamples)) {}

  /// Throws Cancelled after the deadline.
  double distance_at(double factor) const {
    arm::require_time(deadline_);
    return described_distance(compared_.signals, compared_.usable, compared_.transforms,
                              arms_.with(payload_at(factor)).described);
  }

  /// Whether another arm with the stated payload explains the run better than this payload does.
  bool is_of_other_arm(double factor) const {
    const auto& [signals, usable, transforms] = compared_;
    DataCheckOptions stated = arms_.with(run_.payload);
    stated.deadline = deadline_;
    return other_arm_explains_more(signals, usable, transforms.period_s, transforms.from_rest,
                                   stated, arms_.with(payload_at(factor)));
  }

  /// The payload whose mass is felt as `factor` times the stated one.
  arm::Payload payload_at(double factor) const {
    const double stated_kg = run_.payload.mass_kg;
    const double mass_kg = std::max(0.0, factor * (stated_kg + felt_kg_) - felt_kg_);
    const double share = stated_kg > 0.0 ? mass_kg / stated_kg : 0.0;
    return {mass_kg, share * run_.payload.inertia_kg_m2};
  }

 private:
  const CheckedRun& run_;
  const DescribedArms& arms_;
  arm::Deadline deadline_;
  double felt_kg_ = 0.0;
  RunSignals compared_;
};

/// The factor of the payload with which the described arm is nearest.
struct Nearest {
  std::size_t search = 0;  ///< of all, the one that found it
  double factor = 1.0;
  double distance = 0.0;
  double stated_distance = 0.0;

  /// The share of what is explained that the stated payload does not explain.
  double gain() const { return nearer() / std::max(1.0 - distance, 1e-12); }
  double nearer() const { return stated_distance - distance; }
};

bool is_nearest_as_stated(const PayloadSearch& search) {
  const double stated = search.distance_at(1.0);
  return stated <= search.distance_at(kFirstStep) && stated <= search.distance_at(1.0 / kFirstStep);
}

Nearest nearest(const PayloadSearch& search) {
  Nearest found;
  found.stated_distance = search.distance_at(1.0);
  found.distance = found.stated_distance;
  const auto take = [&](double factor) {
    const double distance = search.distance_at(factor);
    if (distance >= found.distance) return;
    found.distance = distance;
    found.factor = factor;
  };
  for (int i = -kGridReach; i <= kGridReach; ++i) take(std::pow(kGridStep, i));
  double step = kGridStep;
  for (int i = 0; i < kPayloadRefinements; ++i) {
    step = std::sqrt(step);
    const double around = found.factor;
    take(around * step);
    take(around / step);
  }
  return found;
}

/// The run whose payload is another where those of all others are as stated: empty, or one. What
/// the arm file has wrong is wrong for all.
std::optional<std::size_t> odd_one(const std::vector<Nearest>& found) {
  std::vector<double> logs;
  for (const auto& one : found) logs.push_back(std::log(one.factor));
  // Of two runs the one that is as stated says what is usual.
  const double usual = found.size() > 2                        ? median(logs)
                       : std::abs(logs[0]) < std::abs(logs[1]) ? logs[0]
                                                               : logs[1];
  std::optional<std::size_t> odd;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double off = std::abs(logs[i] - usual);
    if (off <= std::log(kSame) || found[i].gain() <= kAsGood) continue;
    const bool is_believed = found[i].gain() >= kBetter && found[i].nearer() >= kNearer;
    if (odd || off < std::log(kOther) || !is_believed) return std::nullopt;
    odd = i;
  }
  return odd;
}

bool is_comparable(const CheckedRun& run) {
  return !has_finding(run, "time") && !has_finding(run, "torque") &&
         run.record->time_s.size() >= kFewestComparedSamples;
}

/// Nothing after the deadline: what is not decided is not found.
std::vector<RunFinding> check_payloads(const std::vector<CheckedRun>& runs,
                                       const DescribedArms& arms,
                                       const arm::Deadline& deadline) try {
  std::vector<std::size_t> compared;
  std::vector<PayloadSearch> searches;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!is_comparable(runs[i])) continue;
    compared.push_back(i);
    searches.emplace_back(runs[i], arms, deadline);
  }
  if (compared.size() < 2 || std::ranges::all_of(searches, is_nearest_as_stated)) return {};
  std::vector<Nearest> found;
  for (std::size_t i = 0; i < searches.size(); ++i) {
    Nearest one = nearest(searches[i]);
    one.search = i;
    if (one.distance <= kFarthest) found.push_back(one);
  }
  if (found.size() < 2) return {};
  const auto odd = odd_one(found);
  if (!odd) return {};
  const Nearest& other = found[*odd];
  if (searches[other.search].is_of_other_arm(other.factor)) return {};
  const std::size_t at = compared[other.search];
  const CheckedRun& run = runs[at];
  const double mass_kg = searches[other.search].payload_at(other.factor).mass_kg;
  return {{at,
           {Fault::wrong_payload, "payload", 0, run.record->time_s.front(), mass_kg,
            fmt::format("the payload is {:.3g} kg by the response to the torque, not {:.4g} kg as "
                        "stated, or the arm file is wrong; the other runs agree with theirs",
                        mass_kg, run.payload.mass_kg)}}};
} catch (const arm::Cancelled&) {
  return {};
}

}  // namespace

std::vector<RunFinding> check_runs(const std::vector<CheckedRun>& runs, const DescribedArms& arms,
                                   const arm::Deadline& deadline) {
  std::vector<RunFinding> findings = check_noise_between_runs(runs);
  if (!arms.with || arms.beam_mass_kg == 0.0) return findings;
  for (auto& finding : check_payloads(runs, arms, deadline)) {
    findings.push_back(std::move(finding));
  }
  return findings;
}

std::vector<std::vector<DataFinding>> check_records(std::span<const MeasuredRun> runs,
                                                    const DescribedArms& arms,
                                                    const arm::Deadline& deadline) {
  std::vector<CheckedRun> checked;
  std::vector<std::size_t> at;  // of each in `runs`
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const auto* record = std::get_if<TimeRecord>(&runs[r].data);
    if (record == nullptr) continue;
    const Run& run = runs[r].run;
    CheckedRun one{run.id, record, run.payload.value_or(arms.payload),
                   run.initial == InitialState::rest};
    DataCheckOptions options = arms.with ? arms.with(one.payload) : DataCheckOptions{};
    options.starts_at_rest = one.starts_at_rest;
    options.deadline = deadline;
    one.findings = check_data(*record, options);
    checked.push_back(std::move(one));
    at.push_back(r);
  }
  std::vector<std::vector<DataFinding>> findings(runs.size());
  const auto compared =
      arm::is_over(deadline) ? std::vector<RunFinding>() : check_runs(checked, arms, deadline);
  for (std::size_t i = 0; i < checked.size(); ++i) findings[at[i]] = std::move(checked[i].findings);
  for (const auto& [run, finding] : compared) findings[at[run]].push_back(finding);
  return findings;
}

}  // namespace flexarm::measured
