#include "response/mode_choice.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <stdexcept>

namespace flexarm::response {

ModeChoice choose_modes(const std::function<std::vector<double>(int modes)>& truncation_with,
                        std::span<const double> tolerance, int most) {
  if (most < kModeLadder.front()) throw std::invalid_argument("choose_modes: no modes to choose");
  ModeChoice choice;
  for (const int modes : kModeLadder) {
    if (modes > most) break;
    choice.modes = modes;
    choice.truncation = truncation_with(modes);
    if (choice.visible_modes == 0 &&
        std::ranges::all_of(choice.truncation, [](double e) { return e <= kVisiblePart; })) {
      choice.visible_modes = modes;
    }
    if (std::ranges::equal(choice.truncation, tolerance, std::less_equal())) break;
  }
  if (choice.visible_modes == 0) choice.visible_modes = choice.modes;
  return choice;
}

double truncation_estimate(std::span<const double> coarse, std::span<const double> fine) {
  const auto vector = [](std::span<const double> signal) {
    return Eigen::Map<const Eigen::VectorXd>(signal.data(),
                                             static_cast<Eigen::Index>(signal.size()));
  };
  const double difference = (vector(coarse) - vector(fine)).stableNorm();
  return difference == 0.0 ? 0.0 : 2.0 * difference / vector(fine).stableNorm();
}

}  // namespace flexarm::response
