#include "measured/files/time_record.hpp"

#include "tests/fuzz/contract.hpp"
#include "tests/fuzz/reader.hpp"

namespace flexarm::fuzz {

namespace {

void read_time_record_text(std::string_view bytes) {
  returns_or_refuses([&] {
    const auto read = measured::parse_time_record(bytes, "file.csv");
    require(measured::parse_time_record(measured::format_time_record(read), "file.csv") == read,
            "a time record is not read back as it was written");
  });
}

}  // namespace

Reader time_record() {
  return {"time_record", read_time_record_text};
}

}  // namespace flexarm::fuzz
