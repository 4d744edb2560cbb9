#include "measured/checks/data_check.hpp"

#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "measured/checks/data_check_clock.hpp"
#include "measured/checks/data_check_clock_rate.hpp"
#include "measured/checks/data_check_delay.hpp"
#include "measured/checks/data_check_described.hpp"
#include "measured/checks/data_check_drift.hpp"
#include "measured/checks/data_check_duplicates.hpp"
#include "measured/checks/data_check_hum.hpp"
#include "measured/checks/data_check_kinematics.hpp"
#include "measured/checks/data_check_offset.hpp"
#include "measured/checks/data_check_outliers.hpp"
#include "measured/checks/data_check_response.hpp"
#include "measured/checks/data_check_sampling_jitter.hpp"
#include "measured/checks/data_check_sign.hpp"
#include "measured/checks/data_check_signal.hpp"
#include "measured/checks/data_check_torque_offset.hpp"
#include "measured/checks/data_check_torque_spikes.hpp"
#include "measured/checks/data_check_transform.hpp"
#include "measured/checks/data_check_unit.hpp"
#include "measured/checks/data_check_values.hpp"
#include "measured/checks/other_arms.hpp"
#include "measured/spectra/robust.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace flexarm::measured {

namespace {

/// Fewer samples in a row show no spectrum to speak of.
constexpr std::size_t kFewestCompared = 128;

void require_complete(const TimeRecord& record) {
  const auto finite = [](const std::vector<double>& values) {
    return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
  };
  const std::size_t samples = record.time_s.size();
  bool complete = samples >= 2 && record.torque_N_m.size() == samples;
  bool all_finite = finite(record.time_s) && finite(record.torque_N_m);
  for (const auto& channel : record.channels) {
    complete = complete && channel.values.size() == samples;
    all_finite = all_finite && finite(channel.values);
  }
  if (!complete) throw std::invalid_argument("columns of different length, or one sample");
  if (!all_finite) throw std::invalid_argument("a record with a value that is not finite");
}

void append(std::vector<DataFinding>& all, const std::vector<DataFinding>& more,
            std::size_t first_sample = 0) {
  for (auto finding : more) {
    finding.first_sample += first_sample;
    for (PredictedReading& reading : finding.predicted) reading.sample += first_sample;
    all.push_back(std::move(finding));
  }
}

/// Findings in shortened signals, at the samples of the whole ones.
std::vector<DataFinding> at_samples(std::vector<DataFinding> findings,
                                    const std::vector<std::size_t>& sample_of) {
  for (auto& finding : findings) {
    finding.first_sample = sample_of[finding.first_sample];
    for (PredictedReading& reading : finding.predicted) reading.sample = sample_of[reading.sample];
  }
  return findings;
}

void exclude(std::vector<bool>& usable, std::span<const CheckedSignal> signals,
             const std::vector<DataFinding>& findings) {
  for (std::size_t i = 0; i < signals.size(); ++i) {
    if (std::ranges::count(findings, signals[i].name, &DataFinding::channel) > 0) usable[i] = false;
  }
}

/// `check_response` with hum taken off, asked of those that are usable and active.
std::vector<DataFinding> check_answers(std::span<const CheckedSignal> signals,
                                       const std::vector<bool>& usable,
                                       const std::vector<bool>& active, double period_s,
                                       const DataCheckOptions& options) {
  std::vector<std::vector<double>> values;
  for (const auto& signal : signals) values.push_back(without_hum(signal, period_s));
  std::vector<CheckedSignal> quiet(signals.begin(), signals.end());
  std::vector<bool> asked;
  for (std::size_t i = 0; i < quiet.size(); ++i) {
    quiet[i].values = values[i];
    quiet[i].deviation = standard_deviation(values[i]);
    asked.push_back(usable[i] && active[i]);
  }
  const Transforms transforms = transform(quiet, period_s, true);
  return check_response({quiet, transforms, asked, options});
}

/// Signals with what is predicted in the place of spikes.
class Repaired {
 public:
  Repaired(std::span<const CheckedSignal> signals, const std::vector<DataFinding>& spikes)
      : signals_(signals.begin(), signals.end()), values_(signals.size()) {
    for (const auto& finding : spikes) {
      const auto i = static_cast<std::size_t>(
          std::ranges::find(signals_, finding.channel, &CheckedSignal::name) - signals_.begin());
      values_[i].assign(signals[i].values.begin(), signals[i].values.end());
      for (const auto& [sample, value] : finding.predicted) values_[i][sample] = value;
      signals_[i].values = values_[i];
      signals_[i].deviation = standard_deviation(values_[i]);
    }
  }

  std::span<const CheckedSignal> signals() const { return signals_; }

 private:
  std::vector<CheckedSignal> signals_;
  std::vector<std::vector<double>> values_;
};

/// Spikes of the torque, and of the channels beside a torque without them. Where both have one at a
/// time, a controller may have given the torque for the reading: it is the channel's.
std::vector<DataFinding> check_all_spikes(std::span<const CheckedSignal> signals,
                                          const std::vector<bool>& usable,
                                          const DataCheckOptions& options, bool ends_are_sound) {
  constexpr std::size_t kSameTime = 2;  // samples
  auto findings = check_torque_spikes(signals, usable, options);
  const Repaired repaired(signals, findings);
  const auto others = check_spikes(repaired.signals(), usable, options, ends_are_sound);
  for (const auto& other : others) {
    for (auto& finding : findings) {
      std::erase_if(finding.predicted, [&](const PredictedReading& given) {
        return std::ranges::any_of(other.predicted, [&](const PredictedReading& reading) {
          return reading.sample <= given.sample + kSameTime &&
                 given.sample <= reading.sample + kSameTime;
        });
      });
    }
  }
  std::erase_if(findings, [](const DataFinding& finding) { return finding.predicted.empty(); });
  append(findings, others);
  return findings;
}

/// Takes hum out of the signals, and returns it.
Hum remove_hum(std::vector<CheckedSignal>& signals, const std::vector<bool>& usable,
               double period_s) {
  Hum hum = check_hum(signals, usable, period_s);
  for (const auto& finding : hum.findings) {
    const auto i = static_cast<std::size_t>(
        std::ranges::find(signals, finding.channel, &CheckedSignal::name) - signals.begin());
    signals[i].values = hum.values[i];
    signals[i].deviation = standard_deviation(hum.values[i]);
  }
  return hum;
}

std::vector<double> floor_powers(const Transforms& transforms) {
  std::vector<double> powers;
  for (const auto& transform : transforms.of) powers.push_back(transform.floor_power);
  return powers;
}

/// Whether two checks found the same.
bool are_alike(const std::vector<DataFinding>& some, const std::vector<DataFinding>& others) {
  return std::ranges::equal(some, others, [](const DataFinding& one, const DataFinding& other) {
    return one.fault == other.fault && one.channel == other.channel;
  });
}

/// Findings that the arm file is a premise of.
std::vector<DataFinding> or_arm_file(std::vector<DataFinding> findings) {
  for (DataFinding& finding : findings) finding.text += ", or the arm file is wrong";
  return findings;
}

/// What the signals, without spikes, say of each other. A fault takes its channel out of what is
/// asked next.
std::vector<DataFinding> check_relations(std::span<const CheckedSignal> signals,
                                         std::vector<bool> usable, const std::vector<bool>& active,
                                         const Transforms& transforms,
                                         const DataCheckOptions& options) {
  const double period_s = transforms.period_s;
  const DescribedStretch described(signals, transforms, options.described);
  std::vector<DataFinding> findings;
  const auto note = [&](const auto& check) {
    if (arm::is_over(options.deadline)) return;
    const std::vector<DataFinding> found = check();
    append(findings, found);
    exclude(usable, signals, found);
  };
  const auto comparison = [&] {
    return Comparison{signals, transforms, usable, options, described.relations};
  };
  note([&] { return check_trends(signals, usable, options); });
  if (transforms.from_rest) {
    note([&] { return check_answers(signals, usable, active, period_s, options); });
  }
  DataCheckOptions bare = options;
  bare.length_m.reset();
  bare.total_inertia_kg_m2.reset();
  // What holds without the arm file is said of the record alone.
  const auto judged = [&](const auto& check) {
    const std::vector<DataFinding> found = check(comparison());
    if (found.empty()) return found;
    const std::vector<DataFinding> without_arm =
        check(Comparison{signals, transforms, usable, bare});
    if (are_alike(found, without_arm)) return found;
    const bool is_of_other_arm =
        other_arm_explains_more(signals, usable, period_s, transforms.from_rest, found, options);
    return is_of_other_arm ? without_arm : or_arm_file(found);
  };
  // Inertia alone turns an arm: that is a premise of its own, which springs and friction refute.
  note([&] {
    const std::vector<DataFinding> found = judged(check_signs);
    const bool is_of_other_arm =
        !found.empty() &&
        other_arm_explains_more(signals, usable, period_s, transforms.from_rest, found, options);
    return is_of_other_arm ? std::vector<DataFinding>() : found;
  });
  note([&] { return judged(check_units); });
  note([&] { return judged(check_delay); });
  if (transforms.from_rest) {
    if (!described.values.empty()) {
      note([&] { return check_torque_offset(comparison(), options.described); });
    }
    note([&] { return check_offsets(comparison(), described.values); });
  }
  note([&] {
    return check_angle_drift(signals, usable, floor_powers(transforms), period_s, options);
  });
  return findings;
}

/// What channels say of each other over an even stretch; none of `usable` has a fault in its
/// values. A fault takes its channel out of what is asked next. A stretch that does not begin at
/// rest may hold an arm at rest, which answers nothing.
std::vector<DataFinding> compare(std::span<const CheckedSignal> signals,
                                 const std::vector<bool>& usable, const std::vector<bool>& active,
                                 const ClockCheck& clock, bool from_rest,
                                 const DataCheckOptions& options) {
  std::vector<DataFinding> findings;
  if (arm::is_over(options.deadline)) return findings;
  auto rate = check_clock_rate(signals, usable, clock.period_s, from_rest, options);
  if (!rate.empty()) {
    const bool is_of_other_arm =
        other_arm_explains_more(signals, usable, clock.period_s, from_rest, rate, options);
    rate = is_of_other_arm ? std::vector<DataFinding>() : or_arm_file(std::move(rate));
  }
  append(findings, rate);
  if (arm::is_over(options.deadline)) return findings;
  const double period_s = clock.period_s / (rate.empty() ? 1.0 : rate.front().value);
  const Transforms transforms = transform(signals, period_s, from_rest);
  const Comparison raw{signals, transforms, usable, options};
  const auto coarse = check_quantisation(signals, floor_powers(transforms), options);
  append(findings, coarse);
  // An exchange leaves no relation of either column to judge.
  const auto swaps = check_swaps(raw);
  append(findings, swaps);
  if (!swaps.empty()) return findings;
  if (arm::is_over(options.deadline)) return findings;
  std::vector<bool> fine = usable;
  exclude(fine, signals, coarse);
  const auto spikes = check_all_spikes(signals, fine, options, clock.findings.empty());
  append(findings, spikes);
  if (arm::is_over(options.deadline)) return findings;
  const Repaired repaired(signals, spikes);
  append(findings, check_sampling_jitter(repaired.signals(), fine, period_s));
  const bool as_recorded = spikes.empty();
  append(findings, check_relations(repaired.signals(), usable, active,
                                   as_recorded ? transforms
                                               : transform(repaired.signals(), period_s, from_rest),
                                   options));
  return findings;
}

}  // namespace

std::string_view to_string(Fault fault) {
  switch (fault) {
    case Fault::clock_jitter:
      return "clock jitter";
    case Fault::clock_rate:
      return "wrong clock rate";
    case Fault::missing_samples:
      return "missing samples";
    case Fault::backward_time:
      return "backward time";
    case Fault::saturation:
      return "saturation";
    case Fault::dead_channel:
      return "dead channel";
    case Fault::stuck_values:
      return "stuck values";
    case Fault::quantisation:
      return "quantisation";
    case Fault::spikes:
      return "spikes";
    case Fault::drift:
      return "drift";
    case Fault::offset:
      return "offset";
    case Fault::swapped_channels:
      return "swapped channels";
    case Fault::sign_flipped:
      return "sign inverted";
    case Fault::wrong_unit:
      return "wrong unit";
    case Fault::wrong_scale:
      return "wrong scale";
    case Fault::delay:
      return "delay";
    case Fault::zero_torque:
      return "zero torque";
    case Fault::wrong_payload:
      return "wrong payload";
    case Fault::uneven_noise:
      return "uneven noise";
    case Fault::duplicated_samples:
      return "duplicated samples";
    case Fault::sampling_jitter:
      return "sampling jitter";
    case Fault::hum:
      return "hum";
  }
  throw std::invalid_argument("no such fault");
}

std::string check_name(Fault fault) {
  std::string name(to_string(fault));
  std::ranges::replace(name, ' ', '_');
  return name;
}

Fault fault_of_check(std::string_view name) {
  std::vector<std::string> names;
  for (const Fault fault : kFaults) {
    names.push_back(check_name(fault));
    if (names.back() == name) return fault;
  }
  const std::string meant = arm::did_you_mean(name, names);
  throw arm::InputError(
      fmt::format("{}: unknown data check{}", arm::shown(name),
                  meant.empty() ? fmt::format("; must be {}", fmt::join(names, ", ")) : meant));
}

std::vector<DataFinding> check_data(const TimeRecord& record, const DataCheckOptions& options) {
  require_complete(record);
  const ClockCheck clock = check_clock(record.time_s, options);
  std::vector<DataFinding> findings = clock.findings;
  const auto all = signals_of(record, 0, record.time_s.size());
  const auto faulty = check_values(all, options);
  append(findings, faulty);

  if (clock.count >= kFewestCompared && !arm::is_over(options.deadline)) {
    const auto recorded = signals_of(record, clock.first, clock.count);
    const Duplicates duplicates = check_duplicates(recorded);
    append(findings, duplicates.findings, clock.first);
    const ShortenedSignals shortened(recorded, duplicates.rows);
    const auto stretch = shortened.signals();
    std::vector<bool> usable;
    for (const auto& signal : stretch) usable.push_back(signal.deviation > 0.0);
    exclude(usable, stretch, faulty);
    // What rests in the stretch and moves elsewhere in the record is not dead.
    constexpr double kResting = 0.5;
    std::vector<bool> active;
    for (std::size_t i = 0; i < all.size(); ++i) {
      active.push_back(stretch[i].deviation >= kResting * all[i].deviation);
    }
    std::vector<CheckedSignal> quiet(stretch.begin(), stretch.end());
    const Hum hum = remove_hum(quiet, usable, clock.period_s);
    append(findings, hum.findings, clock.first);
    append(findings,
           at_samples(compare(quiet, usable, active, clock,
                              options.starts_at_rest && clock.first == 0, options),
                      shortened.sample_of()),
           clock.first);
  }
  // The hum of a channel that shows nothing else says nothing more.
  std::erase_if(findings, [&](const DataFinding& one) {
    return one.fault == Fault::hum && std::ranges::any_of(findings, [&](const DataFinding& other) {
             return other.fault == Fault::dead_channel && other.channel == one.channel;
           });
  });
  for (auto& finding : findings) finding.time_s = record.time_s[finding.first_sample];
  std::ranges::stable_sort(findings, {}, &DataFinding::fault);
  return findings;
}

std::vector<arm::Sensor> leave_out_dead_channels(TimeRecord& record,
                                                 const std::vector<DataFinding>& findings) {
  std::vector<arm::Sensor> left_out;
  std::erase_if(record.channels, [&](const Channel& channel) {
    const std::string name = arm::to_string(channel.sensor);
    const bool dead = std::ranges::any_of(findings, [&](const DataFinding& finding) {
      return finding.fault == Fault::dead_channel && finding.channel == name;
    });
    if (dead) left_out.push_back(channel.sensor);
    return dead;
  });
  return left_out;
}

std::size_t leave_out_spikes(TimeRecord& record, const DataFinding& finding) {
  const auto& spikes = finding.predicted;
  const double most = kMostLeftOut * static_cast<double>(record.time_s.size());
  if (static_cast<double>(spikes.size()) > most) return 0;
  if (finding.channel == "torque") {
    for (const auto& [sample, value] : spikes) record.torque_N_m[sample] = value;
    return spikes.size();
  }
  const auto channel = std::ranges::find(record.channels, finding.channel, [](const Channel& one) {
    return arm::to_string(one.sensor);
  });
  if (channel == record.channels.end()) return 0;
  for (const auto& [sample, value] : spikes) {
    channel->values[sample] = value;
    channel->left_out.push_back(sample);
  }
  return spikes.size();
}

}  // namespace flexarm::measured
