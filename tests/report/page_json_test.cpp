#include "report/page/page_json.hpp"

#include "report/page/envelope.hpp"
#include "report/page/page_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::report::page {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr std::size_t kMostFileBytes = 10'000'000;

/// Different numbers for each seed; a shift register, for a page's worth of them is many.
std::vector<float> rough_signal(std::size_t count, std::uint32_t seed) {
  std::vector<float> values(count);
  std::uint32_t bits = 2 * seed + 1;
  for (float& value : values) {
    bits ^= bits << 13U;
    bits ^= bits >> 17U;
    bits ^= bits << 5U;
    value = static_cast<float>(bits) * 1e-9F;
  }
  return values;
}

Series recorded(const std::string& label, std::size_t count, std::uint32_t seed) {
  return {label, Role::measured, Draw::line,
          Record{{0.0, 0.001, count}, rough_signal(count, seed)}};
}

/// An overlay of `runs` times `sensors` channels, each measured, before, after and two residuals.
PageDocument overlay_document(std::size_t runs, std::size_t sensors, std::size_t samples) {
  CurvesBlock block{{"overlay", "Overlay"}, {"time", "s"}, {"run", "sensor"}, {}};
  std::uint32_t seed = 0;
  for (std::size_t r = 0; r < runs; ++r) {
    for (std::size_t s = 0; s < sensors; ++s) {
      CurvesPanel signal{{"signal", "rad"}, 1.0, {}};
      for (const char* label : {"measured", "before", "after"}) {
        signal.series.push_back(recorded(label, samples, seed++));
      }
      CurvesPanel residual{{"residual", "rad"}, 1.0, {}};
      for (const char* label : {"before", "after"}) {
        residual.series.push_back(recorded(label, samples, seed++));
      }
      block.views.push_back(
          {{std::to_string(r), std::to_string(s)}, {}, {std::move(signal), std::move(residual)}});
    }
  }
  PageDocument document{"flexarm", "flexarm test", "Test", {}, {}, {}, {}};
  document.sections.push_back({"signals", "Signals", {}, {std::move(block)}});
  return document;
}

TEST(PageTexts, TenRunsOfAMillionSamplesStayBelowTenMegabytes) {
  const std::string html = page_html(overlay_document(10, 2, 1'000'000));
  EXPECT_LT(html.size(), kMostFileBytes);
  EXPECT_GT(html.size(), kMostFileBytes / 2);  // the room is used
}

TEST(PageTexts, SixRunsOfFourThousandSamplesAreWhole) {
  const PageTexts texts = page_texts(overlay_document(6, 4, 4'000));
  const Json json = Json::parse(texts.document);
  std::size_t series = 0;
  for (const auto& view : json["sections"][0]["blocks"][0]["views"]) {
    for (const auto& panel : view["panels"]) {
      for (const auto& one : panel["series"]) {
        EXPECT_EQ(one["data"]["kind"], "samples");
        EXPECT_EQ(one["data"]["y"]["type"], "f32");
        EXPECT_EQ(one["data"]["y"]["count"], 4'000);
        ++series;
      }
    }
  }
  EXPECT_EQ(series, 6U * 4U * 5U);
  EXPECT_LT(texts.arrays.size(), kMostFileBytes / 2);
}

TEST(PageTexts, ShortRecordsBesideLongOnesAreWhole) {
  PageDocument document = overlay_document(1, 1, 4'000);
  auto& panels = std::get<CurvesBlock>(document.sections[0].blocks[0]).views[0].panels;
  panels[0].series.push_back(recorded("long", 3'000'000, 99));
  const Json json = Json::parse(page_texts(document, 1'000'000).document);
  const auto& series = json["sections"][0]["blocks"][0]["views"][0]["panels"][0]["series"];
  EXPECT_EQ(series[0]["data"]["kind"], "samples");
  const auto& record = series[3]["data"];
  ASSERT_EQ(record["kind"], "envelope");
  EXPECT_EQ(record["x"]["count"], 3'000'000);
  std::size_t bucket = record["levels"][0]["samples_per_bucket"];
  for (const auto& level : record["levels"]) {
    EXPECT_EQ(level["samples_per_bucket"], bucket);
    EXPECT_EQ(level["least"]["count"], (3'000'000 + bucket - 1) / bucket);
    bucket *= kLevelRatio;
  }
}

TEST(PageTexts, OtherArraysTakeRoomFromRecords) {
  PageDocument document = overlay_document(1, 1, 100'000);
  const std::size_t alone = page_texts(document, 1'000'000).arrays.size();
  auto& panels = std::get<CurvesBlock>(document.sections[0].blocks[0]).views[0].panels;
  std::vector<double> y(50'000);
  for (std::size_t k = 0; k < y.size(); ++k) y[k] = static_cast<double>(k);
  panels[0].series.push_back(
      {"other", Role::first, Draw::line, Samples{EvenRange{0.0, 1.0, y.size()}, y}});
  const std::size_t together = page_texts(document, 1'000'000).arrays.size();
  EXPECT_LE(alone, 4 * 1'000'000 / 3 + 4);
  EXPECT_LE(together, 4 * 1'000'000 / 3 + 4);
}

TEST(PageTexts, TextEndsNoElement) {
  PageDocument document{"flexarm", "flexarm '</script><script>alert(1)//'", "<!-- <b>", {}, {}, {},
                        {}};
  document.sections.push_back({"a", "</SCRIPT>", {"\xff\"\\\n"}, {}});
  const PageTexts texts = page_texts(document);
  EXPECT_THAT(texts.document, Not(HasSubstr("<")));
  const Json json = Json::parse(texts.document);
  EXPECT_EQ(json["command"], document.command);
  EXPECT_EQ(json["title"], document.title);
  EXPECT_EQ(json["sections"][0]["title"], "</SCRIPT>");
}

TEST(PageTexts, ALabelForEachChoiceIsRequired) {
  PageDocument document = overlay_document(1, 1, 10);
  std::get<CurvesBlock>(document.sections[0].blocks[0]).views[0].labels.pop_back();
  EXPECT_THROW(page_texts(document), std::invalid_argument);
}

TEST(PageTexts, VectorsOfUnlikeLengthsAreRefused) {
  PageDocument document = overlay_document(1, 1, 10);
  auto& panels = std::get<CurvesBlock>(document.sections[0].blocks[0]).views[0].panels;
  panels[0].series[0].data = Samples{std::vector<double>{1.0, 2.0}, std::vector<double>{1.0}};
  EXPECT_THROW(page_texts(document), std::invalid_argument);
}

TEST(PageIds, AreUniqueAndOfPlainCharacters) {
  PageDocument document;
  document.headline = TableBlock{{"map-strain@0.05", ""}, {}, {}};
  document.sections = {{"Roots", "", {}, {TableBlock{{"map-strain@0.05", ""}, {}, {}}}},
                       {"roots", "", {}, {TableBlock{{"@@", ""}, {}, {}}}}};
  make_ids_unique(document);
  const std::set<std::string> ids = {head_of(*document.headline).id, document.sections[0].id,
                                     head_of(document.sections[0].blocks[0]).id,
                                     document.sections[1].id,
                                     head_of(document.sections[1].blocks[0]).id};
  EXPECT_EQ(ids, (std::set<std::string>{"map-strain-0-05", "map-strain-0-05-2", "roots", "roots-2",
                                        "part"}));
}

TEST(PageHtml, IsTheBuiltPageWithTheDataInItsElements) {
  PageDocument document = overlay_document(1, 1, 10);
  document.title = "A < B & C";
  const std::string html = page_html(document);
  const std::string opening = "<script type=\"application/json\" id=\"document\">";
  const std::size_t at = html.find(opening);
  ASSERT_NE(at, std::string::npos);
  const std::size_t begin = at + opening.size();
  const Json json = Json::parse(html.substr(begin, html.find("</script>", begin) - begin));
  EXPECT_EQ(json["schema"], "flexarm.page/1");
  EXPECT_EQ(json["title"], "A < B & C");
  EXPECT_THAT(html, HasSubstr("<title>A &lt; B &amp; C</title>"));
  EXPECT_THAT(html, Not(HasSubstr("id=\"arrays\"></script>")));
}

}  // namespace
}  // namespace flexarm::report::page
