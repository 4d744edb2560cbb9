#include "diagnose/symptoms/error_trends.hpp"

#include <boost/math/distributions/complement.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

namespace flexarm::diagnose {

namespace {

/// Torques are alike where each band that holds this part of one's power holds at least a third of
/// that in the other.
constexpr double kHasTorque = 0.02;
constexpr double kAlike = 3.0;
/// Torques differ in size from here on.
constexpr double kOtherTorque = 1.5;
constexpr std::size_t kFewestBands = 3;

/// Bands of one run, and of each its sensors' errors.
struct RunBands {
  std::string id;
  double torque_rms_N_m = 0.0;
  double payload_kg = 0.0;
  std::map<std::string, double> torque_share = {};  ///< of its power, by band
  std::map<std::string, std::map<std::string, const BandError*>> errors = {};
};

std::vector<RunBands> bands_by_run(const std::vector<BandError>& errors) {
  std::vector<RunBands> runs;
  for (const BandError& error : errors) {
    if (!error.torque_rms_N_m) continue;
    auto at = std::ranges::find(runs, error.run_id, &RunBands::id);
    if (at == runs.end()) {
      at = runs.insert(at, {error.run_id, *error.torque_rms_N_m, error.payload_kg});
    }
    at->torque_share[error.band.name] =
        std::pow(*error.band_torque_rms_N_m / *error.torque_rms_N_m, 2);
    at->errors[error.band.name][error.sensor] = &error;
  }
  return runs;
}

bool are_alike(const RunBands& a, const RunBands& b) {
  return std::ranges::all_of(a.torque_share, [&](const auto& entry) {
    const auto other = b.torque_share.find(entry.first);
    const double share = other == b.torque_share.end() ? 0.0 : other->second;
    if (std::max(entry.second, share) < kHasTorque) return true;
    return std::max(entry.second, share) <= kAlike * std::min(entry.second, share);
  });
}

/// Of the error over the torque from `a` to `b`, the mean of the bands.
struct Change {
  double logarithm = 0.0;
  double std_error = 0.0;
  double probability = 1.0;
  double factor() const { return std::exp(logarithm); }
};

std::optional<Change> change(const RunBands& a, const RunBands& b) {
  std::vector<double> logarithms;
  for (const auto& [band, sensors] : a.errors) {
    const auto others = b.errors.find(band);
    if (others == b.errors.end() || a.torque_share.at(band) < kHasTorque) continue;
    double sum = 0.0;
    double count = 0.0;
    for (const auto& [sensor, error] : sensors) {
      const auto other = others->second.find(sensor);
      if (other == others->second.end()) continue;
      if (std::max(error->probability, other->second->probability) > kSignificantSymptom) continue;
      sum += std::log(other->second->error_rms / *other->second->band_torque_rms_N_m) -
             std::log(error->error_rms / *error->band_torque_rms_N_m);
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
  const boost::math::students_t distribution(n - 1.0);
  made.probability = 2.0 * boost::math::cdf(boost::math::complement(
                               distribution, std::abs(made.logarithm) / made.std_error));
  return made;
}

/// The two runs that satisfy `comparable` with the largest ratio of `size`.
template <class Comparable, class Size>
std::optional<std::pair<const RunBands*, const RunBands*>> furthest(
    const std::vector<RunBands>& runs, Comparable comparable, Size size) {
  std::optional<std::pair<const RunBands*, const RunBands*>> found;
  double largest = 0.0;
  for (const RunBands& a : runs) {
    for (const RunBands& b : runs) {
      const double apart = size(a, b);
      if (apart <= largest || !are_alike(a, b) || !comparable(a, b)) continue;
      largest = apart;
      found = {&a, &b};
    }
  }
  return found;
}

/// "2.1 times smaller"
std::string times(double factor) {
  return factor < 1.0 ? fmt::format("{:.2g} times smaller", 1.0 / factor)
                      : fmt::format("{:.2g} times larger", factor);
}

}  // namespace

std::vector<Symptom> trend_symptoms(const std::vector<BandError>& errors) {
  const std::vector<RunBands> runs = bands_by_run(errors);
  std::vector<Symptom> made;
  constexpr std::size_t kTests = 2;
  const auto torques = furthest(
      runs, [](const RunBands& a, const RunBands& b) { return a.payload_kg == b.payload_kg; },
      [](const RunBands& a, const RunBands& b) {
        const double ratio = b.torque_rms_N_m / a.torque_rms_N_m;
        return ratio >= kOtherTorque ? ratio : 0.0;
      });
  if (torques) {
    const auto& [low, high] = *torques;
    if (const auto found = change(*low, *high)) {
      std::string text = fmt::format(
          "Over the torque, the error is {} at {:.2g} N m (run {}) than at {:.2g} N m (run {})",
          times(found->factor()), high->torque_rms_N_m, high->id, low->torque_rms_N_m, low->id);
      Symptom one = symptom(SymptomKind::trend, "", found->probability, kTests);
      if (!one.is_significant) {
        text += ", which is within its scatter from band to band: no sign of a cause that is not "
                "linear.";
      } else if (found->logarithm < 0.0) {
        text += ": what is wrong does not grow with the motion, as dry friction, a dead zone or a "
                "bias.";
      } else {
        text += ": what is wrong grows faster than the motion, as saturation or drag.";
      }
      one.text = std::move(text);
      made.push_back(std::move(one));
    }
  }
  const auto payloads = furthest(
      runs, [](const RunBands&, const RunBands&) { return true; },
      [](const RunBands& a, const RunBands& b) { return b.payload_kg - a.payload_kg; });
  if (payloads) {
    const auto& [light, heavy] = *payloads;
    if (const auto found = change(*light, *heavy)) {
      made.push_back(symptom(
          SymptomKind::trend,
          fmt::format("Over the torque, the error is {} with {:.3g} kg payload (run {}) than with "
                      "{:.3g} kg (run {}).",
                      times(found->factor()), heavy->payload_kg, heavy->id, light->payload_kg,
                      light->id),
          found->probability, kTests));
    }
  }
  return made;
}

}  // namespace flexarm::diagnose
