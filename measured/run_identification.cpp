#include "measured/run_identification.hpp"

#include "arm/input_error.hpp"
#include "measured/free_decay.hpp"
#include "measured/modal/response_fit.hpp"
#include "measured/modal/start_spectra.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

namespace flexarm::measured {

namespace {

/// Sampling periods of runs that are fitted together differ by less than this part.
constexpr double kSamePeriodOfRuns = 1e-9;
/// A step in frequency this many times the one before begins another band.
constexpr double kGap = 8.0;
/// Half the width of a window's main lobe, in lines.
constexpr double kWindowLines = 2.0;
/// Damping ratio above which a fitted zero is no antiresonance.
constexpr double kMostZeroDamping = 0.25;
/// Standard errors by which a damping ratio below 0 is no undamped mode's.
constexpr double kSurelyBelow = 3.0;
/// Share of the work that a run's spectra are, beside 1 for the fit of each.
constexpr double kSpectraShare = 0.2;
/// Why a run or a fit is refused at the deadline.
constexpr const char* kNoTimeLeft = "the time limit left no time for it";

/// Circles of a response that was given, about its peaks.
void read_circles(RunIdentification& made, const CircleSettings& settings) {
  for (const FrequencyChannel& channel : made.response.channels) {
    made.circles.push_back({channel.sensor, nyquist_circles(channel, settings)});
  }
}

/// Circles of an estimated response, about the peaks that are more than noise makes.
void read_circles_at_peaks(RunIdentification& made, CircleSettings settings) {
  for (const FrequencyChannel& channel : made.response.channels) {
    const auto features = std::ranges::find(made.features, channel.sensor, &SensorFeatures::sensor);
    settings.near_Hz.clear();
    for (const SpectralFeature& feature : features->response) {
      if (feature.feature == Feature::pole) settings.near_Hz.push_back(feature.line_Hz);
    }
    if (settings.near_Hz.empty()) continue;
    made.circles.push_back({channel.sensor, nyquist_circles(channel, settings)});
  }
}

/// Where the torque has power, less the window's width: a spectrum falls at the ends of that, and
/// so has a maximum near them.
PeakSettings driven_peaks(PeakSettings peaks, const TimeRecord& record,
                          const FrequencyResponseEstimate& estimate) {
  if (estimate.settings.estimator.hub_held()) return peaks;
  const double width_Hz = estimate.settings.periodic ? 0.0 : kWindowLines * estimate.spacing_Hz;
  const FitBand band = excited_band(record);
  peaks.from_Hz = std::max(peaks.from_Hz, band.from_Hz + width_Hz);
  peaks.to_Hz = std::min(peaks.to_Hz, band.to_Hz - width_Hz);
  return peaks;
}

/// Keeps what follows the release: any later sample begins a free decay as well, one before the
/// release does not.
void keep_decay(TimeRecord& record, RunIdentification& made) {
  const std::size_t begin = begin_of_decay(record);
  made.decay_begins_s = record.time_s[begin];
  made.left_out_before_decay = begin;
  made.hub_at_rest = std::ranges::any_of(made.left_out, arm::is_collocated);
  const auto cut = [begin](std::vector<double>& values) {
    values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(begin));
  };
  cut(record.time_s);
  cut(record.torque_N_m);
  if (!record.reference.values.empty()) cut(record.reference.values);
  for (Channel& channel : record.channels) cut(channel.values);
}

void study_time_run(TimeRecord& record, const IdentificationOptions& options,
                    RunIdentification& made) {
  made.left_out = leave_out_dead_channels(record, made.findings);
  const auto no_torque = std::ranges::find(made.findings, Fault::zero_torque, &DataFinding::fault);
  if (record.channels.empty()) {
    made.refusal = made.left_out.empty() ? "no sensor was measured" : "every channel is dead";
    return;
  }
  made.sampling_period_s = sampling_period_s(record);
  if (made.run.initial == InitialState::free && is_zero(record.torque_N_m) && !options.input) {
    keep_decay(record, made);
    return;
  }
  SpectrumSettings spectrum = options.spectrum;
  spectrum.hold = made.run.torque_hold;
  made.estimate = estimate_by_evidence(
      record, spectrum, {options.input, no_torque == made.findings.end() ? "" : no_torque->text});
  made.features =
      spectral_features(*made.estimate, driven_peaks(options.peaks, record, *made.estimate));
  made.response = to_frequency_record(*made.estimate);
  if (made.hub_held()) return;
  if (made.estimate->periodic && !made.estimate->settings.estimator.instrument) {
    made.distortion = distortion(*made.estimate->periodic);
  }
  read_circles_at_peaks(made, options.circles);
}

/// The bands of a channel: a stepped sine often covers the surroundings of poles and zeros alone,
/// and the edge of a band is no valley.
std::vector<FrequencyChannel> bands_of(const FrequencyChannel& channel) {
  std::vector<FrequencyChannel> bands;
  const auto& frequency_Hz = channel.frequency_Hz;
  for (std::size_t k = 0; k < frequency_Hz.size(); ++k) {
    const bool begins = k == 0 || (bands.back().frequency_Hz.size() > 1 &&
                                   frequency_Hz[k] - frequency_Hz[k - 1] >
                                       kGap * (frequency_Hz[k - 1] - frequency_Hz[k - 2]));
    if (begins) bands.push_back({channel.sensor, {}, {}, {}});
    bands.back().frequency_Hz.push_back(frequency_Hz[k]);
    bands.back().response.push_back(channel.response[k]);
    bands.back().coherence.push_back(channel.coherence[k]);
  }
  return bands;
}

/// Peaks and valleys of a response as it was given. Coherence, where it is known, is taken for one
/// of two averages.
std::vector<SpectralFeature> features_of(const FrequencyChannel& band, PeakSettings settings) {
  settings.noise = PowerNoise::additive;
  std::vector<double> power;
  std::vector<double> spread;
  for (std::size_t k = 0; k < band.response.size(); ++k) {
    power.push_back(std::norm(band.response[k]));
    const bool known = !std::isnan(band.coherence[k]);
    spread.push_back(known ? 2.0 * relative_response_std(band.coherence[k], 2.0) : 0.0);
  }
  return peaks_and_valleys(band.frequency_Hz, power, spread, settings);
}

void study_frequency_run(FrequencyRecord record, const IdentificationOptions& options,
                         RunIdentification& made) {
  made.response = std::move(record);
  for (const FrequencyChannel& channel : made.response.channels) {
    SensorFeatures features{channel.sensor, {}, {}};
    for (const FrequencyChannel& band : bands_of(channel)) {
      std::ranges::copy(features_of(band, options.peaks), std::back_inserter(features.response));
    }
    made.features.push_back(std::move(features));
  }
  if (!made.hub_held()) read_circles(made, options.circles);
}

/// With the hub held: zeros are those of the sensors all the same, poles are zeros of the hub
/// angle.
void read_off_held(ModalReading reading, const ModalTable& table,
                   std::vector<ModalReading>& readings) {
  ModalReading held = reading;
  held.hub_held = true;
  for (ModalEntry entry : table) {
    if (entry.feature == Feature::zero) {
      reading.table.push_back(std::move(entry));
      continue;
    }
    entry.feature = Feature::zero;
    entry.sensor = arm::Sensor{arm::SensorKind::hub_angle, 0.0};
    held.table.push_back(std::move(entry));
  }
  for (auto* made : {&held, &reading}) {
    if (!made->table.empty()) readings.push_back(std::move(*made));
  }
}

void read_off(const RunIdentification& made, PeakPlace place, std::vector<ModalReading>& readings) {
  const auto add = [&](Method method, const arm::Sensor& sensor, ModalTable table) {
    if (table.empty()) return;
    readings.push_back({method, {made.run.id}, sensor, made.run.payload, std::move(table)});
  };
  if (made.hub_held()) {
    for (const auto& features : made.features) {
      read_off_held({Method::response, {made.run.id}, features.sensor, made.run.payload, {}},
                    modal_table(features.sensor, features.response, place), readings);
    }
    return;
  }
  for (const auto& features : made.features) {
    add(Method::autopower, features.sensor,
        modal_table(features.sensor, features.autopower, place));
  }
  for (const auto& features : made.features) {
    add(Method::response, features.sensor, modal_table(features.sensor, features.response, place));
  }
  for (const auto& [sensor, set] : made.circles) {
    add(Method::nyquist_circle, sensor, modal_table(sensor, set.circles));
  }
}

/// A reading for each sensor of a table, that of poles of all sensors among them.
void read_off(ModalReading reading, const ModalTable& table, bool hub_held,
              std::vector<ModalReading>& readings) {
  std::vector<std::optional<arm::Sensor>> sensors;
  for (const ModalEntry& entry : table) {
    if (std::ranges::find(sensors, entry.sensor) == sensors.end()) sensors.push_back(entry.sensor);
  }
  for (const auto& sensor : sensors) {
    reading.sensor = sensor;
    ModalTable own;
    std::ranges::copy_if(table, std::back_inserter(own),
                         [&](const ModalEntry& entry) { return entry.sensor == sensor; });
    if (hub_held) {
      read_off_held(reading, own, readings);
    } else {
      reading.table = std::move(own);
      readings.push_back(reading);
    }
  }
}

std::vector<std::string> ids_of(const RunsFit& fitted, const std::vector<RunIdentification>& runs) {
  std::vector<std::string> ids;
  for (const std::size_t r : fitted.runs) ids.push_back(runs[r].run.id);
  return ids;
}

bool fit_together(const MeasuredRun& a, const MeasuredRun& b) {
  if (a.run.kind != RunKind::time || b.run.kind != RunKind::time) return false;
  const double period_s = sampling_period_s(std::get<TimeRecord>(a.data));
  return a.run.payload == b.run.payload && a.run.torque_hold == b.run.torque_hold &&
         std::abs(sampling_period_s(std::get<TimeRecord>(b.data)) - period_s) <=
             kSamePeriodOfRuns * period_s;
}

std::vector<RunsFit> group_runs(const std::vector<MeasuredRun>& runs,
                                const std::vector<RunIdentification>& studied) {
  std::vector<RunsFit> groups;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (!studied[r].refusal.empty() || runs[r].run.kind == RunKind::modal) continue;
    const auto& estimate = studied[r].estimate;
    const bool of_responses = estimate && is_fitted_by_responses(*estimate);
    const auto group = std::ranges::find_if(groups, [&](const RunsFit& fitted) {
      return !of_responses && !fitted.of_responses && fitted.hub_held == studied[r].hub_held() &&
             fit_together(runs[fitted.runs.front()], runs[r]);
    });
    if (group == groups.end()) {
      groups.push_back({.runs = {r},
                        .payload = runs[r].run.payload,
                        .of_responses = of_responses,
                        .hub_held = studied[r].hub_held()});
    } else {
      group->runs.push_back(r);
    }
  }
  return groups;
}

/// A hub at rest has been left out as a dead channel.
bool has_hub_sensor(const std::vector<TimeRecord>& records) {
  return std::ranges::any_of(records, [](const TimeRecord& record) {
    return std::ranges::any_of(
        record.channels, [](const Channel& channel) { return arm::is_collocated(channel.sensor); });
  });
}

/// The mode that grows most surely; empty where none does.
std::string growth_of(const ModalFit& fit) {
  for (const FittedPole& pole : fit.poles) {
    if (!pole.is_mode || !(pole.damping_ratio < -kSurelyBelow * pole.damping_ratio_std)) continue;
    return fmt::format(
        "the damping ratio at {:.4g} Hz is {:.2g} +- {:.1g}, below 0: a motion that "
        "grows",
        pole.frequency_Hz, pole.damping_ratio, pole.damping_ratio_std);
  }
  return "";
}

/// Moves the records out of the runs: a run is in one fit.
void fit(RunsFit& fitted, std::vector<MeasuredRun>& runs,
         const std::vector<RunIdentification>& studied, const ModalFitOptions& options,
         std::optional<double> total_inertia_kg_m2) {
  ModalFitOptions own = options;
  const MeasuredRun& first = runs[fitted.runs.front()];
  own.torque_hold = first.run.torque_hold;
  own.initial.clear();
  if (fitted.of_responses) {
    fitted.fit = fit_responses(*studied[fitted.runs.front()].estimate, own);
  } else if (const auto* record = std::get_if<FrequencyRecord>(&first.data)) {
    fitted.fit = fit_responses(*record, own);
  } else {
    std::vector<TimeRecord> records;
    for (const std::size_t r : fitted.runs) {
      records.push_back(std::move(std::get<TimeRecord>(runs[r].data)));
      own.initial.push_back(runs[r].run.initial);
    }
    const bool decays = std::ranges::all_of(
        fitted.runs, [&](std::size_t r) { return studied[r].decay_begins_s.has_value(); });
    own.rigid_body = own.rigid_body && (!decays || has_hub_sensor(records));
    fitted.fit = fit_modes(records, own);
    if (decays && !fitted.fit.cancelled &&
        std::ranges::none_of(fitted.fit.poles, &FittedPole::is_mode)) {
      throw arm::InputError("no oscillation that decays is above the noise");
    }
  }
  fitted.unphysical = growth_of(fitted.fit);
  if (fitted.fit.cancelled || fitted.hub_held || fitted.fit.free_decay) return;
  try {
    fitted.gains = modal_gains(fitted.fit, total_inertia_kg_m2);
  } catch (const UnphysicalInertia& error) {
    fitted.unphysical = error.what();
  } catch (const arm::InputError& error) {
    fitted.gains_refusal = error.what();
  }
}

}  // namespace

std::string_view to_string(Method method) {
  constexpr std::array<std::string_view, 5> kNames = {"autopower", "response", "circle", "fit",
                                                      "table"};
  return kNames.at(static_cast<std::size_t>(method));
}

std::string doubt_of(const RunsFit& fit) {
  if (!fit.refusal.empty()) return "";
  if (!fit.fit.converged) {
    return fmt::format(
        "the fit did not converge in {} iterations; the model order may be too high "
        "for these data{}",
        fit.fit.iterations, fit.unphysical.empty() ? "" : ", and " + fit.unphysical);
  }
  return fit.unphysical.empty() ? "" : "the fit is unphysical: " + fit.unphysical;
}

Identification identify(std::vector<MeasuredRun> runs, const IdentificationOptions& options) {
  Identification made;
  const arm::Deadline end_of_checks = arm::halfway(options.deadline);
  const auto findings = check_records(runs, options.arms, end_of_checks);
  made.are_checks_complete = !arm::is_over(end_of_checks);
  const auto count = static_cast<double>(runs.size());
  const double spectra_share = options.fit ? kSpectraShare : 1.0;
  const auto go_on = [&](const std::string& what, double fraction) {
    return !options.progress || options.progress(what, fraction);
  };
  for (MeasuredRun& run : runs) {
    const double done = static_cast<double>(made.runs.size()) / count;
    if (!go_on("spectra of " + run.run.id, spectra_share * done)) return made;
    RunIdentification studied{.run = run.run, .findings = findings[made.runs.size()]};
    try {
      arm::require_time(options.deadline);
      if (auto* time = std::get_if<TimeRecord>(&run.data)) {
        study_time_run(*time, options, studied);
      } else if (const auto* frequency = std::get_if<FrequencyRecord>(&run.data)) {
        study_frequency_run(*frequency, options, studied);
      } else {
        read_off({Method::table, {run.run.id}, std::nullopt, run.run.payload, {}},
                 std::get<ModalTable>(run.data), false, made.readings);
      }
    } catch (const arm::InputError& error) {
      studied.refusal = error.what();
    } catch (const arm::Cancelled&) {
      studied.refusal = kNoTimeLeft;
    }
    read_off(studied, options.peaks.place, made.readings);
    made.runs.push_back(std::move(studied));
  }
  if (!made.runs.empty() &&
      std::ranges::none_of(made.runs, &std::string::empty, &RunIdentification::refusal)) {
    throw arm::InputError(
        fmt::format("run {}: {}", made.runs.front().run.id, made.runs.front().refusal));
  }
  if (!options.fit) return made;
  auto groups = group_runs(runs, made.runs);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    RunsFit& group = groups[g];
    ModalFitOptions own = options.modal_fit;
    own.progress = [&](double fraction) {
      arm::require_time(options.deadline);
      const double all = (static_cast<double>(g) + fraction) / static_cast<double>(groups.size());
      return go_on("fit of " + made.runs[group.runs.front()].run.id,
                   spectra_share + (1.0 - spectra_share) * all);
    };
    try {
      arm::require_time(options.deadline);
      fit(group, runs, made.runs, own, options.total_inertia_kg_m2);
    } catch (const arm::InputError& error) {
      group.refusal = error.what();
    } catch (const arm::Cancelled&) {
      group.refusal = kNoTimeLeft;
    }
    if (group.fit.cancelled) return made;
    if (group.refusal.empty()) {
      read_off({Method::rational_fit, ids_of(group, made.runs), std::nullopt, group.payload, {}},
               modal_table(group.fit, kMostZeroDamping), group.hub_held, made.readings);
    }
    made.fits.push_back(std::move(group));
  }
  return made;
}

}  // namespace flexarm::measured
