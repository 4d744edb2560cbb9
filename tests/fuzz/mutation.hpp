#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace flexarm::fuzz {

/// Makes inputs out of seeds by random changes, the same ones for the same random seed: bits and
/// bytes changed, stretches taken out, repeated, moved or taken from another seed, and numbers
/// replaced by extreme ones. It knows nothing of coverage; scripts/fuzz does.
class Mutator {
 public:
  /// `seeds` are one or more.
  Mutator(std::vector<std::string> seeds, std::uint64_t random_seed)
      : seeds_(std::move(seeds)), random_(random_seed) {}

  std::string next();

 private:
  std::size_t below(std::size_t count);
  void change_byte(std::string& text);
  void remove_stretch(std::string& text);
  void repeat_stretch(std::string& text);
  void splice(std::string& text);
  void replace_number(std::string& text);

  std::vector<std::string> seeds_;
  std::mt19937_64 random_;
};

}  // namespace flexarm::fuzz
