#include "diagnose/symptoms/error_trends.hpp"

#include "diagnose/symptoms/frequency_bands.hpp"
#include "measured/spectra/tail_probability.hpp"
#include "response/excitation/excitation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace flexarm::diagnose {

namespace {

/// Torques differ in size from here on.
constexpr double kOtherTorque = 1.5;
constexpr std::size_t kFewestBands = 6;
/// A band has torque where its power a line is this part of the largest.
constexpr double kHasTorque = 0.05;
/// A band's error is beyond noise where its power is this multiple of the noise's.
constexpr double kIsError = 4.0;

/// Errors of one run over its torque.
struct RunErrors {
  std::string id;
  double torque_rms_N_m = 0.0;
  double payload_kg = 0.0;
  /// Of each sensor the logarithm of error over torque in each band; NaN where either lacks.
  std::map<std::string, std::vector<double>> logarithms = {};
};

/// From the second line of the longest record up.
std::vector<FrequencyBand> fine_bands(double from_Hz, double to_Hz) {
  std::vector<FrequencyBand> bands = {{"", 0.0, from_Hz}};
  const double ratio = std::pow(to_Hz / from_Hz, 1.0 / kTrendBands);
  for (int b = 0; b < kTrendBands; ++b) {
    bands.push_back({"", bands.back().to_Hz, from_Hz * std::pow(ratio, b + 1)});
  }
  return bands;
}

double power_a_line(const BandPower& power) {
  return power.lines > 0.0 ? power.mean_square / power.lines : 0.0;
}

RunErrors errors_of(const SymptomsInput& input, std::size_t run, const measured::TimeRecord& record,
                    const std::vector<FrequencyBand>& bands) {
  const Experiment& experiment = input.problem.experiment();
  const Observations& observations = input.problem.observations();
  const double period_s = measured::sampling_period_s(record);
  RunErrors made;
  made.id = experiment.runs[run].run.id;
  made.torque_rms_N_m = response::rms_N_m(record.torque_N_m);
  made.payload_kg = arm_in(experiment, experiment.runs[run].run).payload.mass_kg;
  const auto torque = band_powers(record.torque_N_m, period_s, bands);
  double most = 0.0;
  for (const BandPower& power : torque) most = std::max(most, power_a_line(power));
  for (const ObservedChannel& channel : observations.channels) {
    if (channel.run != run) continue;
    const auto count = static_cast<std::size_t>(channel.count);
    const auto error = band_powers({input.before.data() + channel.first, count}, period_s, bands);
    auto& own = made.logarithms[channel.sensor];
    const double deviation = observations.deviations(channel.first);
    const double lines = 0.5 * static_cast<double>(count);
    for (std::size_t b = 0; b < bands.size(); ++b) {
      const double noise = error[b].lines / lines;
      const bool shows =
          power_a_line(torque[b]) > kHasTorque * most && error[b].mean_square > kIsError * noise;
      own.push_back(shows ? std::log(deviation) + 0.5 * std::log((error[b].mean_square - noise) /
                                                                 torque[b].mean_square)
                          : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return made;
}

std::vector<RunErrors> errors_by_run(const SymptomsInput& input) {
  const auto& runs = input.problem.experiment().runs;
  double from_Hz = std::numeric_limits<double>::infinity();
  double to_Hz = 0.0;
  for (const auto& [run, data] : runs) {
    if (const auto* record = std::get_if<measured::TimeRecord>(&data)) {
      const double period_s = measured::sampling_period_s(*record);
      from_Hz = std::min(from_Hz, 2.0 / (period_s * static_cast<double>(record->time_s.size())));
      to_Hz = std::max(to_Hz, 0.5 / period_s);
    }
  }
  std::vector<RunErrors> made;
  if (!(from_Hz < to_Hz)) return made;
  const auto bands = fine_bands(from_Hz, to_Hz);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (const auto* record = std::get_if<measured::TimeRecord>(&runs[r].data)) {
      made.push_back(errors_of(input, r, *record, bands));
    }
  }
  return made;
}

/// Of the error over the torque from `a` to `b`, the mean of the bands.
struct Change {
  double logarithm = 0.0;
  double std_error = 0.0;
  double probability = 1.0;
  double factor() const { return std::exp(logarithm); }
};

std::optional<Change> change(const RunErrors& a, const RunErrors& b) {
  std::vector<double> logarithms;
  for (std::size_t band = 0; band <= kTrendBands; ++band) {
    double sum = 0.0;
    double count = 0.0;
    for (const auto& [sensor, own] : a.logarithms) {
      const auto other = b.logarithms.find(sensor);
      if (other == b.logarithms.end()) continue;
      const double more = other->second[band] - own[band];
      if (std::isnan(more)) continue;
      sum += more;
      count += 1.0;
    }
    if (count > 0.0) logarithms.push_back(sum / count);
  }
  if (logarithms.size() < kFewestBands) return std::nullopt;
  const auto n = static_cast<double>(logarithms.size());
  Change made;
  for (const double one : logarithms) made.logarithm += one / n;
  double squares = 0.0;
  for (const double one : logarithms) squares += std::pow(one - made.logarithm, 2);
  made.std_error = std::sqrt(squares / (n - 1.0) / n);
  if (!(made.std_error > 0.0)) return std::nullopt;
  made.probability = measured::students_t_tails(made.logarithm / made.std_error, n - 1.0);
  return made;
}

/// The two runs that can be compared and are furthest apart by `apart`, 0 where they cannot.
template <class Apart>
std::optional<std::pair<Change, std::pair<const RunErrors*, const RunErrors*>>> furthest(
    const std::vector<RunErrors>& runs, Apart apart) {
  std::optional<std::pair<Change, std::pair<const RunErrors*, const RunErrors*>>> found;
  double largest = 0.0;
  for (const RunErrors& a : runs) {
    for (const RunErrors& b : runs) {
      const double own = apart(a, b);
      if (own <= largest) continue;
      const auto between = change(a, b);
      if (!between) continue;
      largest = own;
      found = {*between, {&a, &b}};
    }
  }
  return found;
}

/// "2.1 times smaller at <one> than at <other>"
std::string compared(const Change& change, std::string_view one, std::string_view other,
                     bool is_significant) {
  const double factor = change.factor();
  if (!is_significant) {
    return fmt::format(
        "Residual relative to torque: no significant difference between {} and {} (factor {:.2g})",
        one, other, factor);
  }
  const std::string size = factor < 1.0 ? fmt::format("{:.2g} times smaller", 1.0 / factor)
                                        : fmt::format("{:.2g} times larger", factor);
  return fmt::format("Residual relative to torque: {} at {} than at {}", size, one, other);
}

std::string torque_text(const Change& change, const RunErrors& low, const RunErrors& high,
                        bool is_significant) {
  const auto torque = [](const RunErrors& run) {
    return fmt::format("{:.2g} N m rms (run {})", run.torque_rms_N_m, run.id);
  };
  const std::string text = compared(change, torque(high), torque(low), is_significant);
  if (!is_significant) return text + ".";
  if (change.logarithm < 0.0) {
    return text +
           ". The discrepancy does not scale with amplitude: Coulomb friction, dead zone or bias.";
  }
  return text + ". The discrepancy grows faster than amplitude: saturation or drag.";
}

std::string payload_text(const Change& change, const RunErrors& light, const RunErrors& heavy,
                         bool is_significant) {
  const auto payload = [](const RunErrors& run) {
    return fmt::format("payload {:.3g} kg (run {})", run.payload_kg, run.id);
  };
  return compared(change, payload(heavy), payload(light), is_significant) + ".";
}

}  // namespace

std::vector<Symptom> trend_symptoms(const SymptomsInput& input) {
  const std::vector<RunErrors> runs = errors_by_run(input);
  std::vector<Symptom> made;
  constexpr std::size_t kTests = 2;
  const auto torques = furthest(runs, [](const RunErrors& a, const RunErrors& b) {
    const double ratio = b.torque_rms_N_m / a.torque_rms_N_m;
    return a.payload_kg == b.payload_kg && ratio >= kOtherTorque ? ratio : 0.0;
  });
  if (torques) {
    const auto& [found, pair] = *torques;
    Symptom one = symptom(SymptomKind::trend, "", found.probability, kTests);
    one.text = torque_text(found, *pair.first, *pair.second, one.is_significant);
    made.push_back(std::move(one));
  }
  const auto payloads = furthest(
      runs, [](const RunErrors& a, const RunErrors& b) { return b.payload_kg - a.payload_kg; });
  if (payloads) {
    const auto& [found, pair] = *payloads;
    const auto& [light, heavy] = pair;
    Symptom one = symptom(SymptomKind::trend, "", found.probability, kTests);
    one.text = payload_text(found, *light, *heavy, one.is_significant);
    made.push_back(std::move(one));
  }
  return made;
}

}  // namespace flexarm::diagnose
