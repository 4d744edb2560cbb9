#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flexarm::fuzz {

/// A reader of files or texts of other people, fed with bytes of any kind.
struct Reader {
  std::string name;
  /// Reads the bytes as the program would. Throws Finding (tests/fuzz/contract.hpp), or whatever
  /// the reader throws beyond its contract.
  void (*read)(std::string_view bytes) = nullptr;
  /// In fuzz_replay_test, six seconds or less. 100,000 are as many as scripts/fuzz executes in 5 to
  /// 120 s under sanitizers.
  int mutated_inputs = 100000;
};

/// What the function of each file tests/fuzz/readers/NAME.cpp returns; CMakeLists.txt writes it.
std::vector<Reader> every_reader();

}  // namespace flexarm::fuzz
