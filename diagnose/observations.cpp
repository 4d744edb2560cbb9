#include "diagnose/observations.hpp"

#include "diagnose/noise_floor.hpp"
#include "measured/spectra/robust.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>
#include <variant>

namespace flexarm::diagnose {

namespace {

/// Gathers channels one after the other.
class Gathering {
 public:
  void begin_run() { first_of_run_.push_back(static_cast<Eigen::Index>(values_.size())); }
  void begin(std::size_t run, std::string sensor) {
    made_.push_back({run, std::move(sensor), static_cast<Eigen::Index>(values_.size()), 0, 0.0});
  }
  void add(double value, double deviation) {
    values_.push_back(value);
    deviations_.push_back(deviation);
  }
  void leave_out(const std::vector<std::size_t>& numbers) { made_.back().left_out = numbers; }
  void end(double noise, bool logarithmic = false) {
    auto& channel = made_.back();
    channel.logarithmic = logarithmic;
    channel.count = static_cast<Eigen::Index>(values_.size()) - channel.first;
    channel.noise = noise;
    if (channel.count == 0) made_.pop_back();
  }
  Observations observations() const {
    const auto n = static_cast<Eigen::Index>(values_.size());
    std::vector<Eigen::Index> first_of_run = first_of_run_;
    first_of_run.push_back(n);
    return {Eigen::VectorXd::Map(values_.data(), n), Eigen::VectorXd::Map(deviations_.data(), n),
            made_, first_of_run};
  }

 private:
  std::vector<double> values_;
  std::vector<double> deviations_;
  std::vector<ObservedChannel> made_;
  std::vector<Eigen::Index> first_of_run_;
};

void gather(Gathering& all, std::size_t run, const std::string& name,
            const std::vector<double>& samples, const std::vector<std::size_t>& left_out = {}) {
  const double signal = measured::standard_deviation(samples);
  Eigen::VectorXd expected = Eigen::VectorXd::Map(samples.data(), std::ssize(samples));
  if (!left_out.empty()) {
    expected.array() -= expected.mean();
    fill_by_autoregression(expected, left_out, kMostNoiseOrder);
  }
  const double noise =
      std::max(white_noise({expected.data(), samples.size()}), kLeastNoise * signal);
  all.begin(run, name);
  for (const double value : samples) all.add(value, noise);
  all.leave_out(left_out);
  all.end(noise / signal);
}

void gather(Gathering& all, std::size_t run, const measured::TimeRecord& record) {
  for (const auto& channel : record.channels) {
    gather(all, run, arm::to_string(channel.sensor), channel.values, channel.left_out);
  }
}

void gather(Gathering& all, std::size_t run, const measured::FrequencyRecord& record) {
  for (const auto& channel : record.channels) {
    const std::vector<double> scatter = relative_scatter(channel);
    all.begin(run, arm::to_string(channel.sensor));
    double weights = 0.0;
    for (std::size_t k = 0; k < scatter.size(); ++k) {
      const double relative = std::max(scatter[k], kLeastNoise);
      const double deviation =
          std::max(relative * std::abs(channel.response[k]), std::numeric_limits<double>::min());
      all.add(channel.response[k].real(), deviation);
      all.add(channel.response[k].imag(), deviation);
      weights += 1.0 / (2.0 * relative * relative);
    }
    all.end(std::sqrt(static_cast<double>(scatter.size()) / weights), true);
  }
}

void gather(Gathering& all, std::size_t run, const measured::ModalTable& table) {
  for (const ModalGroup& group : modal_groups(table)) {
    all.begin(run, group.zeros_of ? arm::to_string(*group.zeros_of) + " zero" : "pole");
    double squares = 0.0;
    double count = 0.0;
    for (const std::size_t i : group.entries) {
      const measured::ModalEntry& entry = table[i];
      if (entry.frequency_Hz) {
        const double deviation =
            entry.frequency_std_Hz.value_or(kUnknownFrequency * *entry.frequency_Hz);
        all.add(*entry.frequency_Hz, deviation);
        squares += std::pow(deviation / *entry.frequency_Hz, 2);
        count += 1.0;
      }
      if (entry.damping_ratio) {
        all.add(*entry.damping_ratio, entry.damping_ratio_std.value_or(
                                          kUnknownDampingRatio * std::abs(*entry.damping_ratio)));
      }
    }
    all.end(count > 0.0 ? std::sqrt(squares / count) : 0.0);
  }
}

using Line = std::complex<double>;

/// |p/h|^2 - 1 of a predicted response p that is far below the measured one h.
constexpr double kFarBelow = -0.5;

/// What `to` makes of each line of a response, given the measured one too.
void change_lines(const Observations& observations, const ObservedChannel& channel,
                  Eigen::Ref<Eigen::VectorXd> lines, Line (*to)(Line measured, Line line)) {
  for (Eigen::Index k = 0; k < channel.count; k += 2) {
    const Eigen::Index at = channel.first + k;
    const Line measured =
        Line(observations.values(at), observations.values(at + 1)) / observations.deviations(at);
    const Line made = to(measured, {lines(k), lines(k + 1)});
    lines(k) = made.real();
    lines(k + 1) = made.imag();
  }
}

Line residual_of(Line measured, Line error) {
  const double square = std::norm(measured);
  if (square >= kResponseFloor * kResponseFloor) {
    // ln(h/p) = -ln(1 - z) with z = (h - p)/h, real and imaginary part by themselves: a complex
    // logarithm costs five times as much. Far from h, p may be small beside it.
    const Line z = error * std::conj(measured) / square;
    const double change = std::norm(z) - 2.0 * z.real();  // |p/h|^2 - 1
    const double size = std::sqrt(square);
    if (change < kFarBelow) return size * std::log(measured / (measured - error));
    return size * Line(-0.5 * std::log1p(change), std::atan2(z.imag(), 1.0 - z.real()));
  }
  const double length = std::abs(error);
  return length == 0.0 ? error
                       : kResponseFloor * std::log1p(length / kResponseFloor) / length * error;
}

Line error_of(Line measured, Line residual) {
  const double size = std::abs(measured);
  if (size >= kResponseFloor) return measured * (1.0 - std::exp(-residual / size));
  const double length = std::abs(residual);
  return length == 0.0 ? residual
                       : kResponseFloor * std::expm1(length / kResponseFloor) / length * residual;
}

}  // namespace

void to_residuals(const Observations& observations, Eigen::VectorXd& errors) {
  for (const ObservedChannel& channel : observations.channels) {
    auto own = errors.segment(channel.first, channel.count);
    channel.autoregression.whiten(own, channel.left_out);
    if (channel.logarithmic) change_lines(observations, channel, own, residual_of);
  }
}

Eigen::VectorXd to_errors(const Observations& observations, Eigen::VectorXd residuals) {
  for (const ObservedChannel& channel : observations.channels) {
    auto own = residuals.segment(channel.first, channel.count);
    channel.autoregression.colour(own);
    if (channel.logarithmic) change_lines(observations, channel, own, error_of);
  }
  return residuals;
}

Eigen::VectorXd weighing_deviations(const Observations& observations) {
  Eigen::VectorXd made = observations.deviations;
  for (const ObservedChannel& channel : observations.channels) {
    for (const std::size_t k : channel.left_out) {
      made(channel.first + static_cast<Eigen::Index>(k)) = std::numeric_limits<double>::infinity();
    }
  }
  return made;
}

Eigen::VectorXd with_expected_errors(const Observations& observations, Eigen::VectorXd errors) {
  for (const ObservedChannel& channel : observations.channels) {
    fill_by_autoregression(errors.segment(channel.first, channel.count), channel.left_out,
                           kMostNoiseOrder);
  }
  return errors;
}

std::vector<ModalGroup> modal_groups(const measured::ModalTable& table) {
  std::vector<ModalGroup> groups;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const bool is_zero = table[i].feature == measured::Feature::zero;
    const auto owner = is_zero ? table[i].sensor : std::nullopt;
    auto at = std::ranges::find(groups, owner, &ModalGroup::zeros_of);
    if (at == groups.end()) at = groups.insert(at, {owner, {}});
    at->entries.push_back(i);
  }
  return groups;
}

Observations observe(const Experiment& experiment) {
  Gathering all;
  for (std::size_t r = 0; r < experiment.runs.size(); ++r) {
    all.begin_run();
    const auto& [run, data] = experiment.runs[r];
    std::visit([&](const auto& own) { gather(all, r, own); }, data);
    if (!run.controller && !experiment.judges_torque) continue;
    gather(all, r, std::string(kTorqueChannel), std::get<measured::TimeRecord>(data).torque_N_m);
  }
  return all.observations();
}

const measured::FrequencyChannel& response_of(const measured::FrequencyRecord& record,
                                              const ObservedChannel& channel) {
  return *std::ranges::find_if(record.channels, [&](const measured::FrequencyChannel& one) {
    return arm::to_string(one.sensor) == channel.sensor;
  });
}

std::vector<std::complex<double>> response_of_parts(const std::vector<double>& parts) {
  std::vector<std::complex<double>> response;
  for (std::size_t k = 0; k + 1 < parts.size(); k += 2) {
    response.emplace_back(parts[k], parts[k + 1]);
  }
  return response;
}

}  // namespace flexarm::diagnose
