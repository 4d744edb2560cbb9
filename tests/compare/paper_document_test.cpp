#include "arm/input_error.hpp"
#include "report/json/paper_json.hpp"
#include "report/tables/paper_markdown.hpp"
#include "report/tables/paper_tables.hpp"
#include "tests/compare/paper_findings.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>
#include <string>

namespace {

using namespace flexarm;
using compare::paper::findings;

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file.good()) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(PaperDocument, IsWhatTheCommandComputes) {
  const std::string document = read(std::string(FLEXARM_SOURCE_DIR) + "/docs/paper.md");
  EXPECT_EQ(report::updated_paper_document(document, findings()), document)
      << "run scripts/update-docs";
}

TEST(PaperDocument, HoldsABlockOfEveryTopic) {
  const std::string document = read(std::string(FLEXARM_SOURCE_DIR) + "/docs/paper.md");
  for (const auto& topic : findings().topics) {
    EXPECT_NE(document.find("\n<!-- flexarm paper: " + topic.name + " -->\n"), std::string::npos)
        << topic.name;
  }
}

TEST(PaperDocument, AChangedNumberIsPutBack) {
  const std::string block = report::paper_block(findings(), "motion");
  const std::string before = "text\n<!-- flexarm paper: motion -->\n";
  const std::string after = "<!-- end -->\nmore text\n";
  EXPECT_EQ(report::updated_paper_document(before + "an old number\n" + after, findings()),
            before + block + after);
  EXPECT_EQ(report::updated_paper_document(before + after, findings()), before + block + after);
}

TEST(PaperDocument, ADocumentWithoutABlockIsRefused) {
  EXPECT_THROW(report::updated_paper_document("name = \"rig\"\n", findings()), arm::InputError);
}

TEST(PaperDocument, AnUnknownBlockIsRefusedWithTheNearestName) {
  try {
    report::updated_paper_document("\n<!-- flexarm paper: motoin -->\n<!-- end -->\n", findings());
    FAIL();
  } catch (const arm::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("motion"), std::string::npos) << error.what();
  }
  EXPECT_THROW(report::updated_paper_document("\n<!-- flexarm paper: motion -->\n", findings()),
               arm::InputError);
}

TEST(PaperText, OnePartIsFoundByNumberOrByWords) {
  EXPECT_TRUE(report::names_part("(21)-(23)", "22"));
  EXPECT_TRUE(report::names_part("(7), (12)-(13)", "7"));
  EXPECT_FALSE(report::names_part("(7), (12)-(13)", "9"));
  EXPECT_FALSE(report::names_part("(22)", "2"));
  EXPECT_FALSE(report::names_part("Table 6", "6"));
  EXPECT_TRUE(report::names_part("Table 6", "table 6"));
  EXPECT_TRUE(report::names_part("anything", ""));
  EXPECT_EQ(report::paper_text(findings(), "no such part"), "");
  EXPECT_NE(report::paper_text(findings(), "22").find("(21)-(23)"), std::string::npos);
}

TEST(PaperJson, CarriesTheValuesInFullPrecision) {
  const auto json = nlohmann::json::parse(report::paper_json(findings()));
  EXPECT_EQ(json.at("schema"), "flexarm.paper/1");
  ASSERT_EQ(json.at("topics").size(), findings().topics.size());
  const auto& check = findings().topics[0].checks[0];
  const auto& read_back = json.at("topics")[0].at("checks")[0];
  EXPECT_EQ(read_back.at("part"), check.label);
  EXPECT_EQ(read_back.at("comparisons")[0].at("corrected").get<double>(),
            check.comparisons[0].corrected);
  EXPECT_EQ(json.at("cells").size(), findings().cells.size());
}

}  // namespace
