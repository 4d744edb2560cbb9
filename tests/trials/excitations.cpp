#include "tests/trials/excitations.hpp"

#include <cmath>
#include <numbers>

namespace flexarm::trials {

namespace {

constexpr double kDuration_s = kSamples * kSampleTime_s;

struct TorqueLine {
  int cycles;  // in the whole record
  double cosine;
  double sine;
};

std::vector<double> sum_of(const std::vector<TorqueLine>& lines, double rms_N_m) {
  std::vector<double> cosines;
  for (int k = 0; k < kSamples; ++k) {
    cosines.push_back(std::cos(2.0 * std::numbers::pi * k / kSamples));
  }
  double squares = 0.0;
  for (const auto& line : lines) squares += line.cosine * line.cosine + line.sine * line.sine;
  const double scale = rms_N_m / std::sqrt(0.5 * squares);
  std::vector<double> torque(kSamples, 0.0);
  for (const auto& line : lines) {
    for (int k = 0; k < kSamples; ++k) {
      const auto turn = static_cast<std::size_t>(line.cycles * k % kSamples);
      const std::size_t quarter_before = (turn + 3 * kSamples / 4) % kSamples;
      torque[static_cast<std::size_t>(k)] +=
          scale * (line.cosine * cosines[turn] + line.sine * cosines[quarter_before]);
    }
  }
  return torque;
}

}  // namespace

std::vector<double> random_torque(double rms_N_m, Random& random) {
  std::vector<TorqueLine> lines;
  for (int k = 1; k < kSamples / 2; ++k) {
    if (k < 0.5 * kDuration_s || k > 60.0 * kDuration_s) continue;
    const double cosine = random.normal();
    lines.push_back({k, cosine, random.normal()});
  }
  return sum_of(lines, rms_N_m);
}

std::vector<double> multisine_torque(double rms_N_m, Random& random) {
  std::vector<TorqueLine> lines;
  for (int k = 1; k < kSamples / 2; k += 2) {
    if (k < 0.9 * kDuration_s || k > 80.0 * kDuration_s) continue;
    const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    lines.push_back({k, std::cos(phase), std::sin(phase)});
  }
  return sum_of(lines, rms_N_m);
}

std::vector<double> bang_bang_torque(double amplitude_N_m) {
  constexpr int kStart = 100;
  constexpr int kPulse = 700;
  std::vector<double> torque(kSamples, 0.0);
  for (int k = kStart; k < kStart + 2 * kPulse; ++k) {
    torque[static_cast<std::size_t>(k)] = k < kStart + kPulse ? amplitude_N_m : -amplitude_N_m;
  }
  return torque;
}

}  // namespace flexarm::trials
