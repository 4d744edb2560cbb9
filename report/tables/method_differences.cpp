#include "report/tables/method_differences.hpp"

#include "report/tables/identification_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <utility>

namespace flexarm::report {

namespace {

using compare::IdentifiedRoot;
using measured::Feature;
using measured::Method;
using measured::ModalEntry;
using measured::ModalReading;

/// Lines in the half-power bandwidth below which a window widens a peak by more than its errors.
constexpr double kLinesInBandwidth = 6.0;
/// Methods that are compared, most accurate first.
constexpr std::array kCompared = {Method::rational_fit, Method::nyquist_circle, Method::response};

/// A pole by one method.
struct PoleEstimate {
  const ModalReading* reading = nullptr;
  const ModalEntry* entry = nullptr;

  auto rank() const { return std::ranges::find(kCompared, reading->method) - kCompared.begin(); }
  std::string name() const {
    return std::string(to_string(reading->method)) +
           (reading->sensor ? " of " + arm::to_string(*reading->sensor) : "");
  }
};

/// A number of an estimate, with its standard error; 0 where none is stated.
struct PoleNumber {
  double value = 0.0;
  double std = 0.0;
};
using NumberOf = std::optional<PoleNumber> (*)(const ModalEntry&);

std::optional<PoleNumber> frequency_of(const ModalEntry& entry) {
  if (!entry.frequency_Hz) return std::nullopt;
  return PoleNumber{*entry.frequency_Hz, entry.frequency_std_Hz.value_or(0.0)};
}

std::optional<PoleNumber> damping_of(const ModalEntry& entry) {
  if (!entry.damping_ratio) return std::nullopt;
  return PoleNumber{*entry.damping_ratio, entry.damping_ratio_std.value_or(0.0)};
}

/// Holds how far an estimate of a pole lies from the most accurate one.
struct Difference {
  PoleEstimate best;
  PoleEstimate other;
  PoleNumber number_of_best;
  PoleNumber number_of_other;
  double part = 0.0;  ///< of the number of the best
};

/// The most that a number of two estimates may differ by without a word, as parts of the number.
struct Tolerance {
  NumberOf number_of = nullptr;
  double least = 0.0;                                     ///< less is no difference
  double most = std::numeric_limits<double>::infinity();  ///< more is one whatever the errors
};
constexpr Tolerance kFrequency{frequency_of, kLeastFrequency, kMostFrequency};
constexpr Tolerance kDamping{damping_of, kLeastDamping};

/// The furthest first. The estimates of one pole are most accurate first.
std::vector<Difference> differences_of(const std::vector<PoleEstimate>& estimates,
                                       const Tolerance& tolerance) {
  std::vector<Difference> found;
  if (estimates.empty()) return found;
  const PoleEstimate& best = estimates.front();
  const auto of_best = tolerance.number_of(*best.entry);
  if (!of_best || of_best->value == 0.0) return found;
  for (const PoleEstimate& other : estimates) {
    const auto number = tolerance.number_of(*other.entry);
    if (other.rank() == best.rank() || !number) continue;
    const double off = std::abs(number->value - of_best->value);
    const double part = off / std::abs(of_best->value);
    const bool is_sure = off > kSureDifference * std::hypot(number->std, of_best->std);
    if (part < tolerance.least || (!is_sure && part < tolerance.most)) continue;
    found.push_back({best, other, *of_best, *number, part});
  }
  std::ranges::stable_sort(found, std::ranges::greater{}, &Difference::part);
  return found;
}

/// Runs of `part` are all among those of `whole`.
bool is_part(const std::vector<std::string>& part, const std::vector<std::string>& whole) {
  return std::ranges::all_of(
      part, [&](const std::string& id) { return std::ranges::find(whole, id) != whole.end(); });
}

/// Of the pole with this order: those of the runs, and of a fit of these among other runs; most
/// accurate first.
std::vector<PoleEstimate> estimates_of(const IdentifiedData& data, int order) {
  std::vector<PoleEstimate> estimates;
  std::vector<std::string> runs;
  for (const std::size_t i : data.condition.readings) {
    const auto& reading = data.identification.readings[i];
    if (joined(reading.runs) == data.runs) runs = reading.runs;
  }
  for (std::size_t i = 0; i < data.condition.roots.size(); ++i) {
    const auto& reading = data.identification.readings[data.condition.readings[i]];
    const bool is_fit = reading.method == Method::rational_fit;
    const bool is_here = is_fit ? is_part(runs, reading.runs) : reading.runs == runs;
    if (reading.hub_held || !is_here || !std::ranges::count(kCompared, reading.method)) continue;
    for (const IdentifiedRoot& root : data.condition.roots[i]) {
      if (root.measured.feature != Feature::pole || root.order != order) continue;
      estimates.push_back({&reading, &root.measured});
    }
  }
  std::ranges::stable_sort(estimates, {}, [](const PoleEstimate& estimate) {
    const double unknown = std::numeric_limits<double>::infinity();
    return std::pair(estimate.rank(), estimate.entry->frequency_std_Hz.value_or(unknown));
  });
  return estimates;
}

/// What the spectra of the runs do to the damping of a pole; empty where nothing.
std::string reason_in_spectra(const IdentifiedData& data, const Difference& difference) {
  const double bandwidth_Hz =
      2.0 * difference.number_of_best.value * *difference.best.entry->frequency_Hz;
  for (const auto& run : data.identification.runs) {
    const auto& ids = difference.other.reading->runs;
    if (std::ranges::find(ids, run.run.id) == ids.end() || !run.estimate) continue;
    const double spacing_Hz = run.estimate->spacing_Hz;
    if (run.estimate->periodic || bandwidth_Hz >= kLinesInBandwidth * spacing_Hz) continue;
    return fmt::format(
        "likely the window, which widens peaks: lines {:.2g} Hz apart, half-power bandwidth "
        "{:.2g} Hz",
        spacing_Hz, bandwidth_Hz);
  }
  return "";
}

/// What the fit of the same runs speaks for; empty where it was none.
std::string reason_in_fit(const IdentifiedData& data, const Difference& difference) {
  for (const auto& fit : data.identification.fits) {
    if (!fit.refusal.empty() || ids_of(fit, data.identification) != difference.best.reading->runs) {
      continue;
    }
    const bool is_distorted = std::ranges::any_of(fit.runs, [&](std::size_t r) {
      const auto& distortion = data.identification.runs[r].distortion;
      return distortion && std::ranges::any_of(distortion->channels, [](const auto& channel) {
               return channel.odd.found || channel.even.found;
             });
    });
    if (is_distorted) {
      return "likely friction, or other damping that depends on the amplitude: the spectra show "
             "nonlinear distortion";
    }
    const bool is_noise = std::ranges::all_of(
        fit.fit.sensors, [](const auto& sensor) { return sensor.residual.is_noise(); });
    if (!is_noise) {
      return "likely friction, or other damping that depends on the amplitude: the residuals of "
             "the fit are not noise; runs of other amplitudes tell";
    }
  }
  return "";
}

std::string reason_of(const IdentifiedData& data, const Difference& difference) {
  std::string reason = reason_in_spectra(data, difference);
  if (reason.empty()) reason = reason_in_fit(data, difference);
  return reason.empty() ? "no reason is evident from these data" : reason;
}

std::string text_of(const IdentifiedData& data, int order,
                    const std::vector<Difference>& differences, const char* quantity,
                    const char* unit) {
  const Difference& furthest = differences.front();
  const auto text = [unit](const PoleNumber& number) {
    return fmt::format("{:.4g} +- {:.2g}{}", number.value, number.std, unit);
  };
  const std::size_t others = differences.size() - 1;
  return fmt::format("{}: pole {}: {} by {}, {}, is {:.3g} % off that by {}, {}{}", data.runs,
                     order, quantity, furthest.other.name(), text(furthest.number_of_other),
                     100.0 * furthest.part, furthest.best.name(), text(furthest.number_of_best),
                     others == 0 ? ""
                                 : fmt::format(", as {} more estimate{} {}", others,
                                               others == 1 ? "" : "s", others == 1 ? "is" : "are"));
}

std::set<int> orders_of_poles(const IdentifiedData& data) {
  std::set<int> orders;
  for (const auto& roots : data.condition.roots) {
    for (const IdentifiedRoot& root : roots) {
      if (root.measured.feature == Feature::pole && root.order) orders.insert(*root.order);
    }
  }
  return orders;
}

}  // namespace

std::vector<std::string> method_differences(const IdentifiedData& data) {
  std::vector<std::string> found;
  for (const int order : orders_of_poles(data)) {
    const auto estimates = estimates_of(data, order);
    if (const auto off = differences_of(estimates, kFrequency); !off.empty()) {
      found.push_back(text_of(data, order, off, "frequency", " Hz"));
    }
    if (const auto off = differences_of(estimates, kDamping); !off.empty()) {
      found.push_back(text_of(data, order, off, "damping ratio", "") + "; " +
                      reason_of(data, off.front()));
    }
  }
  return found;
}

std::vector<DifferingPole> differing_poles(const IdentifiedData& data) {
  std::vector<DifferingPole> found;
  for (const int order : orders_of_poles(data)) {
    const auto estimates = estimates_of(data, order);
    for (const auto& off : differences_of(estimates, kFrequency)) {
      found.push_back({off.other.reading, order, false});
    }
    for (const auto& off : differences_of(estimates, kDamping)) {
      found.push_back({off.other.reading, order, true});
    }
  }
  return found;
}

std::vector<std::string> all_method_differences(
    const measured::Identification& identification,
    const std::vector<compare::IdentifiedCondition>& conditions) {
  std::vector<std::string> found;
  for (const auto& condition : conditions) {
    for (const auto& runs : sources(identification, condition)) {
      std::ranges::move(method_differences({identification, condition, runs}),
                        std::back_inserter(found));
    }
  }
  return found;
}

}  // namespace flexarm::report
