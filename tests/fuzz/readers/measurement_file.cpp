#include "measured/files/measurement.hpp"
#include "tests/fuzz/contract.hpp"
#include "tests/fuzz/reader.hpp"

namespace flexarm::fuzz {

namespace {

void read_measurement_file(std::string_view bytes) {
  returns_or_refuses([&] {
    const measured::Measurement read = measured::parse_measurement(bytes, "measurement.toml");
    const std::string text = measured::format_measurement(read);
    require(measured::parse_measurement(text, "measurement.toml") == read,
            "a measurement is not read back as it was written");
  });
}

}  // namespace

Reader measurement_file() {
  return {"measurement_file", read_measurement_file};
}

}  // namespace flexarm::fuzz
