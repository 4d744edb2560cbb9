#include "measured/files/file_kind.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <tuple>

namespace flexarm::measured {
namespace {

using testing::HasSubstr;

TEST(FileKindTest, FilesOfFlexarmAreRecognised) {
  const std::vector<std::pair<std::string, FileKind>> files = {
      {"# my arm\n[beam]\nlength = 1.0\n[hub]\ninertia = 1e-3\n", FileKind::arm},
      {"hub = { inertia = 1e-3 }\n", FileKind::arm},
      {"name = \"a\"\narm = \"arm.toml\"\n[[run]]\nid = \"a\"\nfile = \"a.csv\"\n",
       FileKind::measurement},
      {"[[run]]\nid = \"a\"\nkind = \"modal\"\npoles = 3\n", FileKind::plan},
      {"kind = \"sweep\"\n[sweep]\narm = \"arm.toml\"\n", FileKind::campaign},
      {"sensor = \"hub_angle\"\nkp = 2.5\n", FileKind::controller},
      {"time [s],torque [N m]\n0,1\n1,2\n2,3\n", FileKind::time_record},
      {"frequency [Hz],sensor,re,im\n1,hub_angle,1,2\n", FileKind::frequency_record},
      {"sensor,feature,order,frequency [Hz]\nhub_angle,pole,1,11\n", FileKind::modal_table},
      {"{\"schema\": \"flexarm.diagnosis/3\"}", FileKind::result},
      {"Zeit;Moment\n0,1;2\n0,2;3\n", FileKind::log},
      {"[{\"t\": 0, \"tau\": 1}, {\"t\": 1, \"tau\": 1}]", FileKind::log},
      {"    -1\n    58\n", FileKind::log}};
  for (const auto& [bytes, kind] : files) {
    const auto file = recognise_file(bytes);
    ASSERT_TRUE(file.has_value()) << bytes;
    EXPECT_EQ(file->kind, kind) << bytes;
  }
}

TEST(FileKindTest, FormatsOfOtherProgramsAreNamedWithAWayOut) {
  const std::vector<std::pair<std::string, std::string>> files = {
      {std::string("TDSm\x0e\0", 6), "TDMS"},
      {"PK\x03\x04......xl/workbook.xml", ".xlsx"},
      {"PK\x03\x04mimetypeapplication/vnd.oasis.opendocument.spreadsheet", ".ods"},
      {"PK\x03\x04......time.npy", ".npz"},
      {"PK\x03\x04modelDescription.xml", "FMU"},
      {"\xd0\xcf\x11\xe0\xa1", ".xls"},
      {"\x93NUMPY\x01", ".npy"},
      {"PAR1", "Parquet"},
      {"MDF     4.10", "MDF"},
      {"\x89HDF\r\n\x1a\n....", "HDF5 file, but not MATLAB's"},
      {"<!DOCTYPE html><html>", "HTML"}};
  for (const auto& [bytes, named] : files) {
    const auto file = recognise_file(bytes);
    ASSERT_TRUE(file.has_value()) << named;
    EXPECT_THAT(file->is, HasSubstr(named));
    EXPECT_FALSE(file->way.empty());
  }
}

TEST(FileKindTest, AFileOfTheKindThatIsDueKeepsTheWordsOfItsReader) {
  const arm::InputError own("a: own words");
  const auto words = [&](const char* bytes, FileKind due) {
    return std::string(wrong_file(bytes, "a", due, own).what());
  };
  EXPECT_EQ(words("[beam]\nlenght = 1\n", FileKind::arm), own.what());
  EXPECT_EQ(words("time;torque\n0;1\n1;2\n", FileKind::time_record), own.what());
  EXPECT_EQ(words("nothing that is known", FileKind::arm), own.what());
  EXPECT_EQ(words("[beam]\nlength = 1\n", FileKind::measurement),
            "a: is an arm file; must be a measurement (measurement.toml); flexarm modes, compare, "
            "response and simulate take it");
  EXPECT_THAT(words("t,tau\n0,1\n1,2\n", FileKind::modal_table),
              HasSubstr("flexarm import a --out FOLDER"));
  EXPECT_STREQ(
      wrong_file("[beam]\nlength = 1\n", "a", FileKind::measurement, own, "must be red").what(),
      "a: is an arm file; must be red; flexarm modes, compare, response and simulate take it");
}

}  // namespace
}  // namespace flexarm::measured
