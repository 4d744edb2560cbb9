// Logs that the program imports as a user would, and what they become.
#pragma once

#include "measured/files/frequency_record.hpp"
#include "measured/files/measurement.hpp"
#include "measured/files/run_data.hpp"
#include "tests/app/flexarm_fixture.hpp"

#include <gtest/gtest.h>

#include <string>
#include <variant>
#include <vector>

namespace flexarm::testing_app {

class ImportFiles : public Flexarm {
 protected:
  Ended import(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "import");
    return run(arguments);
  }

  /// The first run of the measurement that the arguments make.
  measured::MeasuredRun imported(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--out", "out", "--force"});
    const Ended ended = import(arguments);
    EXPECT_EQ(ended.status, 0) << ended.errors;
    output_ = ended.output;
    if (ended.status != 0) return {};
    const auto file = folder_ / "out/measurement.toml";
    const measured::Run run = measured::read_measurement(file).runs.front();
    return {run, measured::read_run(file, run)};
  }

  measured::TimeRecord record(const std::vector<std::string>& arguments) const {
    return std::get<measured::TimeRecord>(imported(arguments).data);
  }

  measured::FrequencyRecord response(const std::vector<std::string>& arguments) const {
    return std::get<measured::FrequencyRecord>(imported(arguments).data);
  }

  mutable std::string output_;
};

}  // namespace flexarm::testing_app
