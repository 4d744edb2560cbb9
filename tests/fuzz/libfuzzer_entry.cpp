// The entry of libFuzzer's programs: FLEXARM_FUZZED is the reader's name.
#include "tests/fuzz/reader.hpp"

#include <cstddef>
#include <cstdint>

namespace flexarm::fuzz {
Reader FLEXARM_FUZZED();
}

// A Finding is not caught: libFuzzer takes the end of the program for a crash and keeps the input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const flexarm::fuzz::Reader reader = flexarm::fuzz::FLEXARM_FUZZED();
  reader.read({reinterpret_cast<const char*>(data), size});
  return 0;
}
