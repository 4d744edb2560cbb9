#include "measured/spectra/window.hpp"

#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

namespace flexarm::measured {

namespace {

struct CosineSum {
  Window window;
  std::string_view name;
  int terms;
  std::array<double, 5> a;
};

constexpr std::array<CosineSum, 5> kWindows = {{
    {Window::rectangular, "rectangular", 1, {1.0}},
    {Window::hann, "hann", 2, {0.5, 0.5}},
    {Window::hamming, "hamming", 2, {0.54, 0.46}},
    {Window::blackman, "blackman", 3, {0.42, 0.5, 0.08}},
    {Window::flat_top,
     "flat-top",
     5,
     {0.21557895, 0.41663158, 0.277263158, 0.083578947, 0.006947368}},
}};

const CosineSum& sum_of(Window window) {
  return *std::ranges::find(kWindows, window, &CosineSum::window);
}

}  // namespace

std::string_view to_string(Window window) {
  return sum_of(window).name;
}

Window parse_window(std::string_view name) {
  const auto found = std::ranges::find(kWindows, name, &CosineSum::name);
  if (found != kWindows.end()) return found->window;
  std::vector<std::string> names;
  for (const auto& known : kWindows) names.emplace_back(known.name);
  throw arm::InputError(fmt::format(
      "window = {}: unknown{}; must be rectangular, hann, hamming, blackman or flat-top",
      arm::shown(name), arm::did_you_mean(std::string(name), names)));
}

std::vector<double> window_values(Window window, std::size_t samples) {
  const CosineSum& sum = sum_of(window);
  std::vector<double> values(samples);
  for (std::size_t j = 0; j < samples; ++j) {
    double sign = 1.0;
    for (int m = 0; m < sum.terms; ++m) {
      const std::size_t turn = static_cast<std::size_t>(m) * j % samples;
      values[j] += sign * sum.a[static_cast<std::size_t>(m)] *
                   std::cos(2.0 * std::numbers::pi * static_cast<double>(turn) /
                            static_cast<double>(samples));
      sign = -sign;
    }
  }
  return values;
}

double noise_bandwidth_lines(std::span<const double> window) {
  double sum = 0.0;
  double squares = 0.0;
  for (const double w : window) {
    sum += w;
    squares += w * w;
  }
  return static_cast<double>(window.size()) * squares / (sum * sum);
}

double shared_line_variance(Window window) {
  // By Parseval's theorem the sum over lines is n sum w^4/(sum w^2)^2.
  constexpr std::size_t kSamples = 64;  // any number beyond four times the window's highest line
  double squares = 0.0;
  double fourths = 0.0;
  for (const double w : window_values(window, kSamples)) {
    squares += w * w;
    fourths += w * w * w * w;
  }
  return static_cast<double>(kSamples) * fourths / (squares * squares);
}

double overlap_correlation(std::span<const double> window, std::size_t shift) {
  if (shift >= window.size()) return 0.0;
  const double squares = std::inner_product(window.begin(), window.end(), window.begin(), 0.0);
  return std::inner_product(window.begin() + static_cast<std::ptrdiff_t>(shift), window.end(),
                            window.begin(), 0.0) /
         squares;
}

double effective_averages(std::span<const double> window, std::size_t segments, std::size_t shift) {
  const auto count = static_cast<double>(segments);
  double sum = 1.0;
  for (std::size_t k = 1; k < segments && k * shift < window.size(); ++k) {
    const double rho = overlap_correlation(window, k * shift);
    sum += 2.0 * (1.0 - static_cast<double>(k) / count) * rho * rho;
  }
  return count / sum;
}

double sufficient_overlap(Window window) {
  // Shifts are whole samples at all of these overlaps.
  constexpr std::size_t kSamples = 120;
  constexpr std::size_t kMany = 100'000;
  constexpr double kEnough = 0.97;
  const auto values = window_values(window, kSamples);
  const auto averages = [&](std::size_t shift) {
    return effective_averages(values, kMany / shift, shift);
  };
  const double most = averages(kSamples / 6);
  for (const std::size_t shift : {kSamples, kSamples / 2, kSamples / 3, kSamples / 4}) {
    if (averages(shift) >= kEnough * most) {
      return 1.0 - static_cast<double>(shift) / static_cast<double>(kSamples);
    }
  }
  return 1.0 - 1.0 / 6.0;
}

int main_lobe_lines(Window window) {
  return sum_of(window).terms;
}

}  // namespace flexarm::measured
