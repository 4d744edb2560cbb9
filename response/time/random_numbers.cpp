#include "response/time/random_numbers.hpp"

#include <cmath>
#include <numbers>

namespace flexarm::response {

RandomNumbers::RandomNumbers(std::uint64_t seed, std::uint32_t stream) {
  std::seed_seq words{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U),
                      stream};
  generator_.seed(words);
}

double RandomNumbers::uniform() {
  return (static_cast<double>(generator_() >> 11U) + 0.5) * 0x1p-53;
}

double RandomNumbers::normal() {
  const double radius = std::sqrt(-2.0 * std::log(uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

std::size_t RandomNumbers::below(std::size_t count) {
  return static_cast<std::size_t>(uniform() * static_cast<double>(count));
}

}  // namespace flexarm::response
