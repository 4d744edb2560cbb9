#pragma once

#include "exact_tf/exact_arm.hpp"
#include "measured/modal/modal_fit.hpp"
#include "measured/modal/nyquist_circle.hpp"
#include "measured/spectra/response_estimate.hpp"
#include "measured/spectra/spectral_features.hpp"
#include "report/figures/figure_layout.hpp"
#include "report/figures/label_placement.hpp"
#include "response/time/random_numbers.hpp"
#include "tests/fit_cases/fit_cases.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace flexarm::report {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A minute of the paper's arm under random torque, 200 Hz, with 1 % noise.
inline measured::FitCase sample_case() {
  measured::FitCase made;
  made.excitation = response::RandomNoise{.rms_N_m = 0.05, .from_Hz = 0.2, .to_Hz = 90.0};
  made.relative_noise = 0.01;
  return made;
}

inline std::vector<double> exact_poles_Hz(const arm::Arm& arm, int count) {
  std::vector<double> found;
  for (const auto& pole : exact_tf::ExactArm(arm).damped_poles(count).flexible) {
    found.push_back(std::abs(pole.first_rad_per_s) / (2.0 * std::numbers::pi));
  }
  return found;
}

/// Exact responses of a stepped sine, `points` frequencies `step_Hz` apart around each pole.
inline measured::FrequencyChannel stepped_sine(const arm::Arm& arm, const arm::Sensor& sensor,
                                               int poles, int points = 401,
                                               double step_Hz = 0.005) {
  const exact_tf::ExactArm exact(arm);
  measured::FrequencyChannel channel{sensor, {}, {}, {}};
  for (const double pole_Hz : exact_poles_Hz(arm, poles)) {
    for (int k = 0; k < points; ++k) {
      const double f_Hz = pole_Hz + step_Hz * (k - points / 2);
      channel.frequency_Hz.push_back(f_Hz);
      channel.response.push_back(exact.transfer_function(
          sensor, std::complex<double>(0.0, 2.0 * std::numbers::pi * f_Hz)));
      channel.coherence.push_back(1.0);
    }
  }
  return channel;
}

/// 100 000 lines to 500 Hz of a spectrum with noise, one of them far above the others.
inline constexpr std::size_t kManyLines = 100'000;
inline constexpr std::size_t kPeakLine = 43'210;

inline std::vector<double> many_frequencies_Hz() {
  std::vector<double> frequency_Hz;
  for (std::size_t k = 0; k < kManyLines; ++k) {
    frequency_Hz.push_back(0.005 * static_cast<double>(k));
  }
  return frequency_Hz;
}

inline std::vector<double> many_values(std::uint64_t seed) {
  response::RandomNumbers random(seed);
  std::vector<double> values;
  for (std::size_t k = 0; k < kManyLines; ++k) values.push_back(std::exp(random.normal()));
  values[kPeakLine] = 1e6;
  return values;
}

/// An SVG that a browser opens at once.
inline constexpr std::size_t kMostBytes = 500'000;

/// Pairs of annotations that cover each other in the drawing.
inline int overlapping_labels(Figure figure) {
  place_labels(figure);
  const FigureLayout layout = lay_out(figure);
  int pairs = 0;
  for (std::size_t s = 0; s < figure.stacks.size(); ++s) {
    for (std::size_t p = 0; p < figure.stacks[s].panels.size(); ++p) {
      const Panel& panel = figure.stacks[s].panels[p];
      std::vector<TextBox> boxes;
      for (const Annotation& annotation : panel.annotations) {
        const Axis& x = panel.x ? *panel.x : figure.stacks[s].x;
        boxes.push_back(text_box(annotation, layout.boxes[s][p], x, panel.y));
        for (std::size_t i = 0; i + 1 < boxes.size(); ++i) {
          pairs += boxes[i].overlaps(boxes.back()) ? 1 : 0;
        }
      }
    }
  }
  return pairs;
}

inline const Series* find_series(const Panel& panel, const std::string& name) {
  const auto found = std::ranges::find(panel.series, name, &Series::name);
  return found == panel.series.end() ? nullptr : &*found;
}

}  // namespace flexarm::report
