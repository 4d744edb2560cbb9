#include "measured/checks/data_check_hum.hpp"

#include "measured/checks/data_check_hum_line.hpp"
#include "measured/checks/data_check_transform.hpp"
#include "measured/checks/data_check_values.hpp"
#include "measured/spectra/robust.hpp"

#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

namespace flexarm::measured {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;

constexpr double kTurn_rad = 2.0 * std::numbers::pi;
constexpr double kMains_Hz[] = {50.0, 60.0};
constexpr int kGainDegree = 3;
constexpr int kTorqueDegreeBesideChannel = 1;
constexpr double kLeastHumScore = 8.0;
constexpr double kLeastAmplitude = 0.03;  // standard deviations
constexpr double kLeastBesideChannel = 0.05;
constexpr double kLeastBesideSteps = 0.12;
constexpr double kLeastAlone = 0.15;  // of the only channel, beside pulses
constexpr double kNoTorque = 1e-9;    // of its power, in a line
/// Lines of a torque that stand out as much as its hum does; it is made of lines then.
constexpr double kOtherLine = 0.3;
/// Of an amplitude: what two fits of one line may differ by, and the error of a fit that decides.
constexpr double kMostDifference = 0.5;
constexpr double kSureError = 0.15;
/// Standard errors of an amplitude that counts, and what amplitudes of one line may differ by.
constexpr double kSeen = 3.0;
constexpr double kMostScatter = 0.15;
/// Signals with a clear amplitude that tell a line which does not stand out of the torque.
constexpr int kManyClear = 3;

/// What a mains frequency looks like at this sampling.
double alias_Hz(double frequency_Hz, double period_s) {
  const double rate_Hz = 1.0 / period_s;
  return std::abs(frequency_Hz - rate_Hz * std::round(frequency_Hz / rate_Hz));
}

/// Whether the torque is made of lines: another one, away from the mains, stands out of the twelve
/// lines on either side and is of 0.3 of this amplitude or more.
bool is_of_lines(const CheckedSignal& torque, double amplitude, double period_s) {
  constexpr double kStandsOut = 8.0;
  constexpr Index kPeak = 2;  // lines of the window's lobe
  const auto samples = static_cast<Index>(torque.values.size());
  const Transforms transforms = transform(std::span(&torque, 1), period_s, false);
  const auto& spectrum = transforms.of[0].plain;
  const auto width = static_cast<std::size_t>(
      std::ceil(static_cast<double>(kBandSide) * transforms.bins_per_line));
  const auto lobe =
      static_cast<std::size_t>(std::ceil(static_cast<double>(kPeak) * transforms.bins_per_line));
  const double full = 0.5 * amplitude * static_cast<double>(samples);
  for (std::size_t bin = width; bin + width < spectrum.size(); ++bin) {
    const double here = std::abs(spectrum[bin]);
    if (here < kOtherLine * full) continue;
    const double frequency_Hz = transforms.omega_rad_per_s(bin) / kTurn_rad;
    const bool is_mains = std::ranges::any_of(kMains_Hz, [&](double mains_Hz) {
      return std::abs(frequency_Hz - alias_Hz(mains_Hz, period_s)) <
             static_cast<double>(kPeak + 1) / transforms.duration_s + kMainsTolerance_Hz;
    });
    if (is_mains) continue;
    // A band's edge stands out on one side.
    std::vector<double> below;
    std::vector<double> above;
    for (std::size_t j = lobe + 1; j <= width; ++j) {
      below.push_back(std::abs(spectrum[bin - j]));
      above.push_back(std::abs(spectrum[bin + j]));
    }
    if (here > kStandsOut * std::max(median(std::move(below)), median(std::move(above))))
      return true;
  }
  return false;
}

DataFinding hum_finding(const CheckedSignal& signal, const HumLine& line, double mains_Hz,
                        double alias) {
  const double amplitude = std::abs(line.amplitude);
  const std::string_view unit = signal.sensor ? arm::unit(*signal.sensor) : "N m";
  const std::string shown =
      alias == mains_Hz ? "" : fmt::format(", which shows as {:.4g} Hz", line.frequency_Hz);
  return {Fault::hum,
          signal.name,
          0,
          0.0,
          amplitude,
          fmt::format("{} has hum of {:.0f} Hz{}: amplitude {:.3g} {} ({:.2g} of its standard "
                      "deviation)",
                      signal.name, mains_Hz, shown, amplitude, unit, amplitude / signal.deviation)};
}

/// An amplitude of the torque's line by one signal.
struct Estimate {
  Complex amplitude;
  double error = 0.0;

  bool is_seen() const { return std::abs(amplitude) > kSeen * error; }
  bool is_clear() const { return std::abs(amplitude) > kLeastHumScore * error; }
  bool agrees_with(Complex other) const {
    return std::abs(amplitude - other) < kMostScatter * std::abs(other) + kSeen * error;
  }
};

/// Looks for one mains frequency in all signals.
class HumSearch {
 public:
  HumSearch(std::span<const CheckedSignal> signals, const std::vector<bool>& usable,
            double period_s, double mains_Hz)
      : signals_(signals),
        period_s_(period_s),
        mains_Hz_(mains_Hz),
        has_pulses_(has_few_levels(signals[0].values)),
        band_(signals[0].values.size(), period_s, alias_Hz(mains_Hz, period_s)) {
    for (std::size_t i = 0; i < signals.size(); ++i) {
      asked_.push_back(usable[i] && signals[i].deviation > 0.0);
    }
    asked_channels_ = std::count(asked_.begin() + 1, asked_.end(), true);
  }

  void search(Hum& hum) {
    if (!band_.is_usable()) return;
    transform_all();
    Lines found = beside_torque();
    if (!found[0]) add_beside_channels(found);
    for (std::size_t i = 0; i < signals_.size(); ++i) {
      if (!found[i]) continue;
      hum.findings.push_back(hum_finding(signals_[i], *found[i], mains_Hz_, band_.centre_Hz()));
      subtract(*found[i], hum.values[i]);
    }
  }

 private:
  using Lines = std::vector<std::optional<HumLine>>;  // one a signal

  void transform_all() {
    const auto samples = static_cast<Index>(signals_[0].values.size());
    Eigen::MatrixXd values(samples, std::ssize(signals_));
    for (std::size_t i = 0; i < signals_.size(); ++i) {
      const Eigen::Map<const Eigen::ArrayXd> column(signals_[i].values.data(), samples);
      values.col(static_cast<Index>(i)) = column - column.mean();
    }
    lines_ = band_.of(values);
    grid_ = hum_grid(band_);
  }

  auto lines_of(std::size_t signal) const { return lines_.col(static_cast<Index>(signal)); }

  /// Lines of signals beside the torque alone.
  Lines beside_torque() const {
    const Lines none(signals_.size());
    // Pulses that repeat have lines, and modes that they excite: another channel knows of them.
    if (has_pulses_ && asked_channels_ > 1) return none;
    auto torque_line =
        asked_[0] ? strongest_line(band_, grid_, lines_of(0), band_.transient()) : std::nullopt;
    // Friction answers a torque with a line here by others.
    const bool is_given = torque_line && !may_hum(*torque_line);
    if (is_given && (!has_pulses_ || is_clear(*torque_line))) return none;
    if (is_given) torque_line.reset();
    Lines found(signals_.size());
    if (const auto missed = missed_by_channels()) {
      // Friction, too, changes a line of a torque that is made of lines for all channels alike.
      if (may_hum(*missed)) found[0] = missed;
      return found;
    }
    found = lines_of_channels(lines_of(0));
    if (torque_line) {
      const Lines without = lines_of_channels(
          lines_of(0) - torque_line->amplitude * band_.of_wave(torque_line->frequency_Hz, 0));
      bool is_answered = false;
      bool is_missed = false;
      bool is_other = false;
      for (std::size_t i = 1; i < found.size(); ++i) {
        is_answered |= without[i] && !found[i];
        is_missed |= found[i] && !without[i];
        is_other |= found[i] && without[i];
      }
      // Channels that the line explains answer it: the torque was given. Where they all miss it,
      // it need not stand out of the torque.
      const bool is_there = is_hum(0, *torque_line) || (is_missed && !is_other);
      if (is_there && !is_answered) {
        found = without;
        found[0] = torque_line;
      }
    }
    drop_explained(found);
    return found;
  }

  /// A line of the torque that channels miss by the same amplitude: each has -g h for a torque
  /// with the line h and a gain g.
  std::optional<HumLine> missed_by_channels() const {
    if (has_pulses_ || !asked_[0]) return std::nullopt;
    const BandLines transient = band_.transient();
    const BandLines known = beside(0, lines_of(0));
    HumLine best;
    for (std::size_t w = 0; w < grid_.waves.size(); ++w) {
      const auto fit_here = [&](std::size_t signal, const BandLines& others) {
        return fit_line(lines_of(signal), others, grid_.waves[w], grid_.frequencies_Hz[w]);
      };
      const HumLine there = fit_here(0, transient);
      std::vector<Estimate> estimates = {{there.amplitude, there.error}};
      for (std::size_t i = 1; i < signals_.size(); ++i) {
        if (!asked_[i]) continue;
        const HumLine line = fit_here(i, known);
        const double gain = std::abs(line.gain);
        if (gain > 0.0) estimates.push_back({-line.amplitude / line.gain, line.error / gain});
      }
      const bool are_several = std::ranges::count_if(estimates, &Estimate::is_clear) >= kManyClear;
      const bool is_known = estimates[0].is_seen() || are_several;
      if (!is_known || std::ranges::count_if(estimates, &Estimate::is_seen) < 2) continue;
      Complex sum;
      double weights = 0.0;
      for (const Estimate& one : estimates) {
        const double weight = 1.0 / (one.error * one.error);
        sum += weight * one.amplitude;
        weights += weight;
      }
      const HumLine line{
          grid_.frequencies_Hz[w], sum / weights, 1.0 / std::sqrt(weights), {}, {}, 0.0, {}};
      const auto agrees = [&](const Estimate& one) { return one.agrees_with(line.amplitude); };
      if (line.score() > best.score() && std::ranges::all_of(estimates, agrees)) best = line;
    }
    const bool is_large = std::abs(best.amplitude) > kLeastAmplitude * signals_[0].deviation;
    if (!is_clear(best) || !is_large) return std::nullopt;
    return best;
  }

  Lines lines_of_channels(const Eigen::VectorXcd& torque) const {
    Lines found(signals_.size());
    for (std::size_t i = 1; i < signals_.size(); ++i) {
      if (!asked_[i]) continue;
      found[i] = strongest_line(band_, grid_, lines_of(i), beside(0, torque));
      if (found[i] && !is_hum(i, *found[i])) found[i].reset();
    }
    return found;
  }

  /// Adds lines of channels beside another one. Both have the same poles and answer friction of the
  /// hub alike, so that a smooth ratio explains one by the other where the torque does not.
  void add_beside_channels(Lines& found) const {
    const Lines before = found;
    for (std::size_t i = 1; i < signals_.size(); ++i) {
      for (std::size_t j = 1; j < signals_.size() && !found[i]; ++j) {
        if (j == i || before[i] || before[j] || !asked_[i] || !asked_[j]) continue;
        const auto line = strongest_line(band_, grid_, lines_of(i), beside(j, lines_of(0)));
        const double least = kLeastBesideChannel * signals_[i].deviation;
        if (line && std::abs(line->amplitude) > least && is_hum(i, *line) && is_own(i, j, *line)) {
          found[i] = line;
        }
      }
    }
  }

  /// Whether a line of channel i beside channel j is of i and not of j: every other signal beside
  /// which i can be fitted well leaves it, and one at least leaves none in j.
  bool is_own(std::size_t i, std::size_t j, const HumLine& line) const {
    const double at_Hz = line.frequency_Hz;
    const BandLines wave = band_.of_wave(at_Hz, 0);
    const Complex blamed = fit(j, i, wave, at_Hz).amplitude;
    bool is_cleared = false;
    for (std::size_t k = 0; k < signals_.size(); ++k) {
      if (k == i || k == j || (k > 0 && !asked_[k])) continue;
      if (denies(fit(i, k, wave, at_Hz), line.amplitude)) return false;
      is_cleared |= denies(fit(j, k, wave, at_Hz), blamed);
    }
    const Complex difference = fit(i, 0, wave, at_Hz).amplitude - line.amplitude;
    return is_cleared && std::abs(difference) < kMostDifference * std::abs(line.amplitude);
  }

  /// Drops lines that a channel without one explains.
  void drop_explained(Lines& found) const {
    const Lines all = found;
    for (std::size_t i = 1; i < found.size(); ++i) {
      if (!all[i]) continue;
      const double at_Hz = all[i]->frequency_Hz;
      const BandLines wave = band_.of_wave(at_Hz, 0);
      for (std::size_t k = 1; k < found.size() && found[i]; ++k) {
        if (k == i || all[k] || !asked_[k]) continue;
        if (denies(fit(i, k, wave, at_Hz), all[i]->amplitude)) found[i].reset();
      }
    }
  }

  /// What explains a channel beside signal `other`: a transient, the torque and that signal.
  BandLines beside(std::size_t other, const Eigen::VectorXcd& torque) const {
    BandLines columns = band_.transient();
    const double power = signals_[0].deviation * static_cast<double>(signals_[0].values.size());
    if (torque.cwiseAbs().maxCoeff() > kNoTorque * power) {
      band_.add_polynomial(other == 0 ? kGainDegree : kTorqueDegreeBesideChannel, torque, columns);
    }
    if (other != 0) band_.add_polynomial(kGainDegree, lines_of(other), columns);
    return columns;
  }

  HumLine fit(std::size_t signal, std::size_t other, const BandLines& wave,
              double frequency_Hz) const {
    return fit_line(lines_of(signal), beside(other, lines_of(0)), wave, frequency_Hz);
  }

  /// Whether a fit knows a line well and has another one.
  static bool denies(const HumLine& other, Complex amplitude) {
    const double size = std::abs(amplitude);
    return other.error < kSureError * size &&
           std::abs(other.amplitude - amplitude) > kMostDifference * size;
  }

  static bool is_clear(const HumLine& line) { return line.score() > kLeastHumScore; }

  bool is_hum(std::size_t signal, const HumLine& line) const {
    return is_clear(line) && std::abs(line.amplitude) > least_amplitude(signal) &&
           std::abs(line.frequency_Hz - band_.centre_Hz()) <= grid_.reach_Hz && line.is_constant();
  }

  double least_amplitude(std::size_t signal) const {
    double least = kLeastAmplitude;
    if (has_pulses_ && signal != 0) {
      // Steps of a torque excite modes of the tip's acceleration beyond the smooth gain, and
      // nothing tells small lines of the only channel from those of pulses that repeat.
      if (signals_[signal].is(arm::SensorKind::tip_acceleration)) least = kLeastBesideSteps;
      if (asked_channels_ == 1) least = kLeastAlone;
    }
    return least * signals_[signal].deviation;
  }

  bool may_hum(const HumLine& line) const {
    return !has_pulses_ && !is_of_lines(signals_[0], std::abs(line.amplitude), period_s_);
  }

  void subtract(const HumLine& line, std::vector<double>& values) const {
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double phase = kTurn_rad * line.frequency_Hz * period_s_ * static_cast<double>(k);
      values[k] -= (line.amplitude * std::polar(1.0, phase)).real();
    }
  }

  std::span<const CheckedSignal> signals_;
  std::vector<bool> asked_;
  std::ptrdiff_t asked_channels_ = 0;
  double period_s_;
  double mains_Hz_;
  bool has_pulses_;  ///< the torque is made of levels
  HumBand band_;
  BandLines lines_;  ///< a column a signal
  HumGrid grid_;
};

}  // namespace

Hum check_hum(std::span<const CheckedSignal> signals, const std::vector<bool>& usable,
              double period_s) {
  Hum hum;
  for (const auto& signal : signals) {
    hum.values.emplace_back(signal.values.begin(), signal.values.end());
  }
  for (const double mains_Hz : kMains_Hz) {
    HumSearch(signals, usable, period_s, mains_Hz).search(hum);
  }
  return hum;
}

}  // namespace flexarm::measured
