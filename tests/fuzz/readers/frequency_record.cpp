#include "measured/files/frequency_record.hpp"

#include "tests/fuzz/contract.hpp"
#include "tests/fuzz/reader.hpp"

namespace flexarm::fuzz {

namespace {

void read_frequency_record_text(std::string_view bytes) {
  returns_or_refuses([&] {
    const auto read = measured::parse_frequency_record(bytes, "file.csv");
    require(measured::parse_frequency_record(measured::format_frequency_record(read), "file.csv") ==
                read,
            "a frequency record is not read back as it was written");
  });
}

}  // namespace

Reader frequency_record() {
  return {"frequency_record", read_frequency_record_text};
}

}  // namespace flexarm::fuzz
