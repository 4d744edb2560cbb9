#include "tests/trials/random.hpp"

#include <cmath>
#include <numbers>

namespace flexarm::trials {

namespace {

/// FNV-1a of 64 bits (Fowler, Noll, Vo): std::hash differs between platforms.
std::uint64_t name_hash(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char letter : name) {
    hash ^= static_cast<unsigned char>(letter);
    hash *= 0x100000001b3;
  }
  return hash;
}

std::mt19937_64 seeded(std::uint64_t seed, std::string_view purpose) {
  const std::uint64_t name = name_hash(purpose);
  std::seed_seq words{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                      static_cast<std::uint32_t>(name), static_cast<std::uint32_t>(name >> 32)};
  return std::mt19937_64(words);
}

}  // namespace

Random::Random(std::uint64_t seed, std::string_view purpose) : generator_(seeded(seed, purpose)) {}

double Random::uniform() {
  constexpr double kStep = 0x1p-53;
  return (static_cast<double>(generator_() >> 11) + 0.5) * kStep;
}

double Random::normal() {
  const double radius = std::sqrt(-2.0 * std::log(uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

std::size_t Random::below(std::size_t count) {
  return static_cast<std::size_t>(uniform() * static_cast<double>(count));
}

}  // namespace flexarm::trials
