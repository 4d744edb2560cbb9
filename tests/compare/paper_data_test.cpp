#include "compare/paper/paper_tables.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/modal_table.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

namespace {

using namespace flexarm;
using compare::paper::FrequencyCell;
using compare::paper::tables;
using measured::Feature;
using measured::ModalEntry;

const std::filesystem::path kData = std::filesystem::path(FLEXARM_SOURCE_DIR) / "data" / "paper";

/// The paper's location of each sensor.
const std::map<std::string, std::string>& locations() {
  static const std::map<std::string, std::string> all = {
      {"hub_angle", "shaft encoder"},       {"hub_velocity", "tachometer"},
      {"strain@0.05", "location-1"},        {"strain@0.25", "location-2"},
      {"strain@0.47", "location-3"},        {"strain@0.712", "location-4"},
      {"tip_acceleration", "accelerometer"}};
  return all;
}

void expect_frequency_of_table(const ModalEntry& entry, const std::string& method) {
  const std::string location = locations().at(arm::to_string(*entry.sensor));
  int matches = 0;
  for (const FrequencyCell& cell : tables().frequencies) {
    if (cell.method != method || cell.location != location || cell.order != entry.order ||
        cell.feature != measured::to_string(entry.feature)) {
      continue;
    }
    ++matches;
    EXPECT_EQ(*entry.frequency_Hz, cell.measured_Hz->value) << location;
  }
  EXPECT_EQ(matches, 1) << location;
}

void expect_damping_of_table_five(const ModalEntry& entry) {
  const std::string location = locations().at(arm::to_string(*entry.sensor));
  for (const auto& cell : tables().damping_ratios) {
    if (cell.location == location && cell.order == entry.order) {
      EXPECT_EQ(*entry.damping_ratio, cell.damping_ratio.value) << location;
    }
  }
}

TEST(PaperData, TheArmFileIsTheBuiltInArm) {
  EXPECT_EQ(measured::read_arm_file(kData / "arm.toml", effects::vocabulary()), arm::paper_arm());
}

TEST(PaperData, ModalFilesRepeatTheTables) {
  const std::map<std::string, std::string> methods = {
      {"modal.csv", "spectrum analyser"},
      {"modal_as_printed.csv", "spectrum analyser"},
      {"modal_autopower.csv", "autopower spectrum"},
      {"modal_random_frf.csv", "transfer function"}};
  for (const auto& [file, method] : methods) {
    const auto modal = measured::read_modal_table(kData / file);
    EXPECT_EQ(modal.size(), file == "modal_as_printed.csv" ? 28u : 18u) << file;
    for (const auto& entry : modal) {
      expect_frequency_of_table(entry, method);
      const bool damped = method == "spectrum analyser" && entry.feature == Feature::pole;
      ASSERT_EQ(entry.damping_ratio.has_value(), damped) << file;
      if (damped) expect_damping_of_table_five(entry);
    }
  }
}

TEST(PaperData, OnlyTheHubsSensorsHaveZerosInTheFileForComparison) {
  for (const auto& entry : measured::read_modal_table(kData / "modal.csv")) {
    if (entry.feature == Feature::zero) {
      EXPECT_TRUE(arm::is_collocated(*entry.sensor));
    }
  }
}

}  // namespace
