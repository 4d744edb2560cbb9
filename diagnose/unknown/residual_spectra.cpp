#include "diagnose/unknown/residual_spectra.hpp"

#include "measured/spectra/fourier.hpp"
#include "measured/spectra/segment.hpp"
#include "measured/spectra/spectra.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>
#include <utility>
#include <variant>

namespace flexarm::diagnose {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;

/// sum_m w_m w_{m + shift}.
double lagged_product(std::span<const double> window, std::size_t shift) {
  double sum = 0.0;
  for (std::size_t m = shift; m < window.size(); ++m) sum += window[m] * window[m - shift];
  return sum;
}

/// Transforms of one stretch of a run, of one length.
class Segment {
 public:
  Segment(std::size_t samples, double period_s)
      : period_s_(period_s),
        window_(measured::window_values(measured::Window::hann, samples)),
        transform_(samples) {
    for (std::size_t lag = 0; lag < products_.size(); ++lag) {
      products_[lag] = lagged_product(window_, lag);
    }
    const double n = static_cast<double>(samples);
    scale_ = std::sqrt(2.0 / (n * products_[0]));
    for (std::size_t k = kLowestLine; k < lines_end(); ++k) {
      frequency_Hz_.push_back(static_cast<double>(k) / (n * period_s));
    }
  }

  const std::vector<double>& frequency_Hz() const { return frequency_Hz_; }

  Eigen::VectorXcd transformed(std::span<const double> values, int differences, std::size_t first) {
    std::vector<double> stretch(window_.size());
    measured::copy_differenced({values, differences}, first, stretch);
    for (std::size_t m = 0; m < stretch.size(); ++m) stretch[m] *= window_[m];
    std::vector<Complex> spectrum(transform_.lines());
    transform_(stretch, spectrum);
    Eigen::VectorXcd made(std::ssize(frequency_Hz_));
    for (Index k = 0; k < made.size(); ++k) {
      made(k) = scale_ * spectrum[static_cast<std::size_t>(k) + kLowestLine] /
                difference_response(k, differences);
    }
    return made;
  }

  /// Expected |.|^2 of `transformed` for white noise of that deviation,
  ///
  ///     1 difference:   2 r_0 - 2 r_1 cos a,
  ///     2 differences:  6 r_0 - 8 r_1 cos a + 2 r_2 cos 2a,
  ///
  /// over the squared response of the differences, r_m the lagged products of the window and
  /// a = 2 pi f T.
  Eigen::VectorXd noise(double deviation, int differences) const {
    Eigen::VectorXd made(std::ssize(frequency_Hz_));
    for (Index k = 0; k < made.size(); ++k) {
      const double angle = 2.0 * std::numbers::pi * frequency_Hz(k) * period_s_;
      double power = products_[0];
      if (differences == 1) power = 2.0 * (products_[0] - products_[1] * std::cos(angle));
      if (differences == 2) {
        power = 6.0 * products_[0] - 8.0 * products_[1] * std::cos(angle) +
                2.0 * products_[2] * std::cos(2.0 * angle);
      }
      made(k) = std::norm(deviation * scale_ / difference_response(k, differences)) * power;
    }
    return made;
  }

 private:
  double frequency_Hz(Index k) const { return frequency_Hz_[static_cast<std::size_t>(k)]; }
  Complex difference_response(Index k, int differences) const {
    return measured::difference_response(frequency_Hz(k), period_s_, differences);
  }
  std::size_t lines_end() const {
    return static_cast<std::size_t>(kHighestPart * 0.5 * static_cast<double>(window_.size()));
  }

  double period_s_;
  std::vector<double> window_;
  measured::RealTransform transform_;
  std::array<double, 3> products_ = {};
  double scale_ = 0.0;
  std::vector<double> frequency_Hz_;
};

/// Means of neighbouring lines, of each row.
Eigen::MatrixXd smoothed(const Eigen::MatrixXd& values) {
  Eigen::MatrixXd made(values.rows(), values.cols());
  for (Index k = 0; k < values.cols(); ++k) {
    const Index from = std::max<Index>(0, k - kNeighbours);
    const Index to = std::min(values.cols() - 1, k + kNeighbours);
    made.col(k) = values.middleCols(from, to - from + 1).rowwise().mean();
  }
  return made;
}

/// What a run's channels leave, in their units, those of its sensors and that of its torque.
struct ChannelErrors {
  std::size_t run = 0;
  std::vector<const ObservedChannel*> channels;
  std::vector<arm::Sensor> sensors;
  std::vector<std::vector<double>> values;
  std::vector<double> deviations;
  std::vector<double> torque_N_m;
};

ChannelErrors channel_errors_of(const Problem& problem, std::size_t run,
                                const Eigen::VectorXd& errors) {
  ChannelErrors made;
  made.run = run;
  const Observations& observations = problem.observations();
  for (const ObservedChannel& channel : observations.channels) {
    if (channel.run != run) continue;
    const Eigen::VectorXd left =
        errors.segment(channel.first, channel.count)
            .cwiseProduct(observations.deviations.segment(channel.first, channel.count));
    std::vector<double> values(left.begin(), left.end());
    if (channel.sensor == kTorqueChannel) {
      made.torque_N_m = std::move(values);
      continue;
    }
    made.channels.push_back(&channel);
    made.sensors.push_back(arm::parse_sensor(channel.sensor));
    made.values.push_back(std::move(values));
    made.deviations.push_back(observations.deviations(channel.first));
  }
  return made;
}

void keep_lines(const std::vector<Index>& lines, ResidualSpectra& spectra) {
  const auto chosen = [&lines](auto& matrix) { matrix = matrix(Eigen::all, lines).eval(); };
  chosen(spectra.errors);
  chosen(spectra.noise);
  chosen(spectra.excess);
  if (spectra.torque_errors.size() > 0) {
    spectra.torque_errors = spectra.torque_errors(lines).eval();
  }
  std::vector<double> frequency_Hz;
  for (const Index line : lines) {
    frequency_Hz.push_back(spectra.frequency_Hz[static_cast<std::size_t>(line)]);
  }
  spectra.frequency_Hz = std::move(frequency_Hz);
}

/// Leaves the lines beyond noise alone.
void keep_excess(ResidualSpectra& spectra) {
  const Eigen::MatrixXd power = smoothed(spectra.errors.cwiseAbs2());
  const Eigen::MatrixXd noise = smoothed(spectra.noise);
  spectra.excess = (power - noise).cwiseMax(0.0);
  std::vector<Index> lines;
  for (Index k = 0; k < power.cols(); ++k) {
    if (power.col(k).cwiseQuotient(noise.col(k)).maxCoeff() > kBeyondNoise) lines.push_back(k);
  }
  keep_lines(lines, spectra);
}

/// What the segments of a run have in common: sensors, lines and noise.
ResidualSpectra common_to_segments(const ChannelErrors& run, const Segment& segment,
                                   double period_s) {
  ResidualSpectra made;
  made.run = run.run;
  made.sensors = run.sensors;
  made.frequency_Hz = segment.frequency_Hz();
  const auto lines = std::ssize(made.frequency_Hz);
  made.noise.resize(std::ssize(run.sensors), lines);
  for (Index j = 0; j < made.noise.rows(); ++j) {
    const auto at = static_cast<std::size_t>(j);
    const int differences = measured::differences_until_steady(run.sensors[at]);
    made.noise.row(j) = segment.noise(run.deviations[at], differences);
    for (Index k = 0; k < lines; ++k) {
      made.noise(j, k) *= run.channels[at]->autoregression.power(
          period_s * made.frequency_Hz[static_cast<std::size_t>(k)]);
    }
  }
  return made;
}

void add_segments(const measured::TimeRecord& record, const ChannelErrors& run,
                  std::vector<ResidualSpectra>& all) {
  // Differences need two samples before the first.
  constexpr std::size_t kBefore = 2;
  const std::size_t end = record.time_s.size();
  const double period_s = measured::sampling_period_s(record);
  const std::size_t samples =
      measured::fast_length_within(std::min(end - kBefore, kLongestSegment));
  Segment segment(samples, period_s);
  const ResidualSpectra common = common_to_segments(run, segment, period_s);
  for (std::size_t first = kBefore; first + samples <= end; first += samples / 2) {
    ResidualSpectra made = common;
    made.errors.resize(common.noise.rows(), common.noise.cols());
    for (Index j = 0; j < made.errors.rows(); ++j) {
      const auto at = static_cast<std::size_t>(j);
      const int differences = measured::differences_until_steady(run.sensors[at]);
      made.errors.row(j) = segment.transformed(run.values[at], differences, first);
    }
    if (!run.torque_N_m.empty()) {
      made.torque_errors = segment.transformed(run.torque_N_m, 0, first);
    }
    if (!made.errors.allFinite()) continue;
    keep_excess(made);
    if (!made.frequency_Hz.empty()) all.push_back(std::move(made));
  }
}

/// What is left of the response of one sensor, and where its lines are.
struct LeftOfResponse {
  const measured::FrequencyChannel* response = nullptr;
  const ObservedChannel* observed = nullptr;
};

void add_responses(const Problem& problem, const std::vector<LeftOfResponse>& sensors,
                   const Eigen::VectorXd& errors, std::vector<ResidualSpectra>& all) {
  const Eigen::VectorXd& deviations = problem.observations().deviations;
  ResidualSpectra made;
  made.run = sensors.front().observed->run;
  made.is_per_torque = true;
  const std::vector<double>& frequency_Hz = sensors.front().response->frequency_Hz;
  // The arm turns without bound under a torque that stays.
  const Index skipped = frequency_Hz.front() > 0.0 ? 0 : 1;
  made.frequency_Hz.assign(frequency_Hz.begin() + skipped, frequency_Hz.end());
  made.errors.resize(std::ssize(sensors), std::ssize(made.frequency_Hz));
  made.noise.resizeLike(made.errors);
  for (Index j = 0; j < made.errors.rows(); ++j) {
    const auto& [response, observed] = sensors[static_cast<std::size_t>(j)];
    made.sensors.push_back(response->sensor);
    for (Index k = 0; k < made.errors.cols(); ++k) {
      const Index at = observed->first + 2 * (k + skipped);
      made.errors(j, k) = deviations(at) * Complex(errors(at), errors(at + 1));
      // Of the real part and of the imaginary one.
      made.noise(j, k) = 2.0 * deviations(at) * deviations(at);
    }
  }
  if (!made.errors.allFinite()) return;
  keep_excess(made);
  if (!made.frequency_Hz.empty()) all.push_back(std::move(made));
}

void add_responses(const Problem& problem, std::size_t run, const measured::FrequencyRecord& record,
                   const Eigen::VectorXd& errors, std::vector<ResidualSpectra>& all) {
  std::vector<std::vector<LeftOfResponse>> sharing_lines;
  for (const ObservedChannel& observed : problem.observations().channels) {
    if (observed.run != run) continue;
    const auto response = std::ranges::find(record.channels, arm::parse_sensor(observed.sensor),
                                            &measured::FrequencyChannel::sensor);
    auto group = std::ranges::find_if(sharing_lines, [&](const auto& other) {
      return other.front().response->frequency_Hz == response->frequency_Hz;
    });
    if (group == sharing_lines.end()) group = sharing_lines.emplace(group);
    group->push_back({&*response, &observed});
  }
  for (const auto& sensors : sharing_lines) add_responses(problem, sensors, errors, all);
}

}  // namespace

std::vector<ResidualSpectra> residual_spectra(const Problem& problem,
                                              const Eigen::VectorXd& errors) {
  constexpr std::size_t kFewestSamples = 64;
  std::vector<ResidualSpectra> all;
  const auto& runs = problem.experiment().runs;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const auto* responses = std::get_if<measured::FrequencyRecord>(&runs[r].data);
    // A force on the arm moves the hub too, so that a response to that tells nothing of its place.
    if (responses != nullptr && !responses->input) {
      add_responses(problem, r, *responses, errors, all);
    }
    const auto* record = std::get_if<measured::TimeRecord>(&runs[r].data);
    if (record == nullptr || record->time_s.size() < kFewestSamples) continue;
    add_segments(*record, channel_errors_of(problem, r, errors), all);
  }
  return all;
}

}  // namespace flexarm::diagnose
