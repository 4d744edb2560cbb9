#include "diagnose/long_runs.hpp"

#include "arm/controller.hpp"
#include "measured/files/record_range.hpp"
#include "measured/spectra/robust.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <variant>

namespace flexarm::diagnose {

namespace {

using measured::InitialState;
using measured::Purpose;

/// A torque below this part of the largest moves nothing: an arm at rest stays there.
constexpr double kPause = 0.01;

struct Stretch {
  std::size_t first = 0;  ///< sample
  bool begins_at_rest = false;
  double excitation = 0.0;  ///< standard deviation of the torque
  std::vector<double> condition = {};
};

bool is_long(const measured::MeasuredRun& run, const LongRunOptions& options) {
  const auto* record = std::get_if<measured::TimeRecord>(&run.data);
  return record != nullptr && record->time_s.size() > options.longest_run;
}

/// Whether what the controller commands depends on more than its readings of now.
bool has_internal_state(const arm::Controller& controller) {
  const auto* pid = std::get_if<arm::PidController>(&controller.law);
  return pid != nullptr ? pid->ki != 0.0
                        : !std::get<arm::StateSpaceController>(controller.law).a.empty();
}

/// The last sample at which an arm that was at rest has not been moved.
std::size_t end_of_rest(const std::vector<double>& torque_N_m) {
  const auto size = [](double torque) { return std::abs(torque); };
  const double largest = std::abs(std::ranges::max(torque_N_m, {}, size));
  const auto moved = std::ranges::find_if(
      torque_N_m, [&](double torque) { return size(torque) > kPause * largest; });
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, moved - torque_N_m.begin() - 1));
}

/// Empty where the torque or a channel does not vary.
std::optional<Stretch> stretch_at(const measured::TimeRecord& record, std::size_t first,
                                  std::size_t samples) {
  const auto part = [&](const std::vector<double>& values) {
    return std::span(values).subspan(first, samples);
  };
  const std::span<const double> torque_N_m = part(record.torque_N_m);
  const double mean = measured::mean(torque_N_m);
  double changes = 0.0;
  double crest = 0.0;
  for (std::size_t k = 0; k < samples; ++k) {
    crest = std::max(crest, std::abs(torque_N_m[k] - mean));
    if (k > 0) changes += std::pow(torque_N_m[k] - torque_N_m[k - 1], 2);
  }
  Stretch made{.first = first, .excitation = measured::standard_deviation(torque_N_m)};
  if (!(made.excitation > 0.0)) return std::nullopt;
  const double change = std::sqrt(changes / static_cast<double>(samples));
  made.condition = {std::log(made.excitation), std::log(change / made.excitation),
                    std::log(crest / made.excitation)};
  for (const measured::Channel& channel : record.channels) {
    const double deviation = measured::standard_deviation(part(channel.values));
    if (!(deviation > 0.0)) return std::nullopt;
    made.condition.push_back(std::log(deviation));
  }
  return made;
}

/// Those that excite the arm, in the order of time.
std::vector<Stretch> stretches_of(const measured::Run& run, const measured::TimeRecord& record,
                                  std::size_t samples, double least_excitation) {
  const bool from_rest = run.initial == InitialState::rest;
  const std::size_t begin = from_rest && !run.controller ? end_of_rest(record.torque_N_m) : 0;
  std::vector<Stretch> made;
  for (std::size_t first = begin; first + samples <= record.time_s.size(); first += samples) {
    auto stretch = stretch_at(record, first, samples);
    if (!stretch) continue;
    stretch->begins_at_rest = from_rest && first == begin;
    made.push_back(*std::move(stretch));
  }
  double strongest = 0.0;
  for (const Stretch& stretch : made) strongest = std::max(strongest, stretch.excitation);
  std::erase_if(made, [&](const Stretch& stretch) {
    return stretch.excitation < least_excitation * strongest;
  });
  return made;
}

double distance(const Stretch& one, const Stretch& other) {
  double squares = 0.0;
  for (std::size_t i = 0; i < one.condition.size(); ++i) {
    squares += std::pow(one.condition[i] - other.condition[i], 2);
  }
  return std::sqrt(squares);
}

/// Up to `count` of them, in the order of time.
std::vector<Stretch> most_different(std::span<const Stretch> stretches, std::size_t count) {
  std::vector<Stretch> taken;
  const auto distance_to_taken = [&](const Stretch& stretch) {
    double least = std::numeric_limits<double>::infinity();
    for (const Stretch& other : taken) least = std::min(least, distance(stretch, other));
    return least;
  };
  if (stretches.empty()) return taken;
  if (stretches.front().begins_at_rest) taken.push_back(stretches.front());
  const Stretch& strongest = *std::ranges::max_element(stretches, {}, &Stretch::excitation);
  if (taken.size() < count && distance_to_taken(strongest) > 0.0) taken.push_back(strongest);
  while (taken.size() < std::min(count, stretches.size())) {
    const Stretch& farthest = *std::ranges::max_element(stretches, {}, distance_to_taken);
    if (distance_to_taken(farthest) == 0.0) break;  // the rest repeats what is taken
    taken.push_back(farthest);
  }
  std::ranges::sort(taken, {}, &Stretch::first);
  return taken;
}

/// What is for estimation, and what for validation. Of a run for both the last third of what there
/// is, behind a gap of a stretch.
std::pair<std::vector<Stretch>, std::vector<Stretch>> split_in_time(const std::vector<Stretch>& all,
                                                                    std::size_t samples) {
  const std::size_t held_out = all.size() / 3 > 0 ? all.size() / 3 : all.size() / 2;
  const auto border = all.end() - static_cast<std::ptrdiff_t>(held_out);
  std::vector<Stretch> estimation(all.begin(), border);
  std::vector<Stretch> validation(border, all.end());
  if (validation.empty()) return {all, {}};
  std::erase_if(estimation, [&](const Stretch& stretch) {
    return stretch.first + 2 * samples > validation.front().first;
  });
  if (estimation.empty()) return {all, {}};
  return {estimation, validation};
}

std::string times_of(const measured::TimeRecord& record, const std::vector<Stretch>& stretches,
                     std::size_t samples) {
  std::vector<std::string> times;
  for (const Stretch& stretch : stretches) {
    times.push_back(fmt::format("{:.6g} to {:.6g} s", record.time_s[stretch.first],
                                record.time_s[stretch.first + samples - 1]));
  }
  return fmt::format("{}", fmt::join(times, ", "));
}

measured::MeasuredRun run_of(const measured::MeasuredRun& whole, const Stretch& stretch,
                             std::size_t samples, Purpose purpose) {
  const auto& record = std::get<measured::TimeRecord>(whole.data);
  measured::MeasuredRun made{whole.run,
                             measured::samples_of(record, stretch.first, stretch.first + samples)};
  made.run.id = fmt::format("{}@{:.6g}s", whole.run.id, record.time_s[stretch.first]);
  made.run.purpose = purpose;
  if (!stretch.begins_at_rest) made.run.initial = InitialState::free;
  return made;
}

/// Stretches that one run has.
struct Share {
  std::size_t estimation = 1;
  std::size_t validation = 1;
  bool is_split_in_time = false;  ///< is for both
};

/// What takes the place of a long run, nothing where it stays as it is; `said` gets a sentence.
std::vector<measured::MeasuredRun> cut(const measured::MeasuredRun& whole, const Share& share,
                                       const LongRunOptions& options,
                                       std::vector<std::string>& said) {
  const auto& [run, data] = whole;
  const auto& record = std::get<measured::TimeRecord>(data);
  const std::size_t total = record.time_s.size();
  if (run.controller && has_internal_state(*run.controller)) {
    said.push_back(fmt::format(
        "run {} has {} samples: the first {} are used; its controller has an internal state, which "
        "is known at the beginning alone",
        run.id, total, options.longest_run));
    return {measured::MeasuredRun{run, measured::samples_of(record, 0, options.longest_run)}};
  }
  std::size_t samples = options.stretch;
  if (run.controller) {
    // A controller reads at the first sample of a run.
    samples -= samples % static_cast<std::size_t>(arm::samples_per_period(
                             *run.controller, measured::sampling_period_s(record)));
  }
  const auto all = stretches_of(run, record, samples, options.least_excitation);
  std::vector<Stretch> estimation;
  std::vector<Stretch> validation;
  if (share.is_split_in_time) {
    std::tie(estimation, validation) = split_in_time(all, samples);
  } else {
    (run.purpose == Purpose::validation ? validation : estimation) = all;
  }
  estimation = most_different(estimation, share.estimation);
  validation = most_different(validation, share.validation);
  std::vector<measured::MeasuredRun> made;
  std::vector<std::string> used;
  const auto take = [&](const std::vector<Stretch>& stretches, Purpose purpose) {
    if (stretches.empty()) return;
    for (const Stretch& stretch : stretches) {
      made.push_back(run_of(whole, stretch, samples, purpose));
    }
    used.push_back(fmt::format("{} for {} ({})", stretches.size(), to_string(purpose),
                               times_of(record, stretches, samples)));
  };
  take(estimation, Purpose::estimation);
  take(validation, Purpose::validation);
  if (made.empty()) return made;
  said.push_back(fmt::format(
      "run {} has {} samples: of its stretches of {} samples, those that excite the arm most and "
      "differ most are used, {}; {} samples are not used. The initial state of a stretch is {}",
      run.id, total, samples, fmt::join(used, " and "), total - made.size() * samples,
      made.front().run.initial == InitialState::rest ? "estimated, but for the first, which begins "
                                                       "at rest"
                                                     : "estimated"));
  return made;
}

}  // namespace

std::vector<std::string> cut_long_runs(std::vector<measured::MeasuredRun>& runs,
                                       const LongRunOptions& options) {
  const auto long_runs = [&](bool validates) {
    return static_cast<std::size_t>(std::ranges::count_if(runs, [&](const auto& run) {
      return is_long(run, options) && (run.run.purpose == Purpose::validation) == validates;
    }));
  };
  const auto share = [](std::size_t stretches, std::size_t among) {
    return std::max<std::size_t>(1, stretches / std::max<std::size_t>(1, among));
  };
  const Share of_each{share(options.estimation_stretches, long_runs(false)),
                      share(options.validation_stretches, long_runs(true)),
                      runs.size() == 1 && !runs.front().run.purpose};
  std::vector<std::string> said;
  std::vector<measured::MeasuredRun> made;
  for (measured::MeasuredRun& run : runs) {
    auto stretches = is_long(run, options) ? cut(run, of_each, options, said)
                                           : std::vector<measured::MeasuredRun>();
    if (stretches.empty()) {
      made.push_back(std::move(run));
    } else {
      std::ranges::move(stretches, std::back_inserter(made));
    }
  }
  runs = std::move(made);
  return said;
}

}  // namespace flexarm::diagnose
