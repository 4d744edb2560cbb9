#include "measured/files/text_file.hpp"
#include "report/figures/svg.hpp"
#include "tests/report/reference_figures.hpp"
#include "tests/report/svg_marks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::report {
namespace {

namespace fs = std::filesystem;

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const fs::path kReferences = fs::path(FLEXARM_SOURCE_DIR) / "tests/report/reference";
constexpr std::size_t kMostBytesOfAPicture = 1 << 20;

/// A marker is about 6 pixels across, and a text 13 high: what moves by less looks the same.
constexpr double kTolerance_px = 2.0;

const std::vector<NamedFigure>& figures() {
  static const std::vector<NamedFigure> all = reference_figures();
  return all;
}

struct Drawing {
  std::string name;
  std::string svg;
};

const std::vector<Drawing>& drawings() {
  static const std::vector<Drawing> all = [] {
    std::vector<Drawing> made;
    for (const auto& [name, figure] : figures()) made.push_back({name, to_svg(figure)});
    return made;
  }();
  return all;
}

fs::path picture_of(const std::string& name) {
  return kReferences / (name + ".svg");
}

std::string reference_of(const std::string& name) {
  return measured::read_text_file(picture_of(name), kMostBytesOfAPicture);
}

/// scripts/renew-pictures sets it.
bool renews() {
  return std::getenv("FLEXARM_RENEW_PICTURES") != nullptr;
}

TEST(ReferencePictures, HaveTheMarksOfTheFiguresDrawn) {
  std::set<std::string> names;
  for (const auto& [name, svg] : drawings()) {
    names.insert(name + ".svg");
    if (renews()) std::ofstream(picture_of(name)) << svg;
    const auto lines = differences(marks_of(svg), marks_of(reference_of(name)), kTolerance_px);
    EXPECT_THAT(lines, IsEmpty()) << name << ": look at both, then run scripts/renew-pictures\n"
                                  << fmt::format("{}", fmt::join(lines, "\n"));
  }
  std::set<std::string> committed;
  for (const auto& entry : fs::directory_iterator(kReferences)) {
    committed.insert(entry.path().filename());
  }
  EXPECT_EQ(committed, names);
}

TEST(ReferencePictures, AreInWords) {
  for (const auto& [name, svg] : drawings()) {
    for (const auto& text : marks_of(svg).texts) {
      EXPECT_THAT(text.text, testing::Not(testing::ContainsRegex("[a-z][_^@][a-z0-9]"))) << name;
    }
  }
}

TEST(ReferencePictures, NoTwoTextsStandInOnePlace) {
  for (const auto& [name, svg] : drawings()) {
    const auto texts = marks_of(svg).texts;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      for (std::size_t j = i + 1; j < texts.size(); ++j) {
        const bool is_apart = std::abs(texts[i].place.x - texts[j].place.x) > 3.0 ||
                              std::abs(texts[i].place.y - texts[j].place.y) > 8.0;
        EXPECT_TRUE(is_apart) << name << ": " << texts[i].text << " and " << texts[j].text;
      }
    }
  }
}

/// The differences of a figure that was changed from what it was.
std::vector<std::string> after(const std::string& name, void (*change)(Figure&)) {
  Figure figure = std::ranges::find(figures(), name, &NamedFigure::name)->figure;
  const SvgMarks reference = marks_of(to_svg(figure));
  change(figure);
  return differences(marks_of(to_svg(figure)), reference, kTolerance_px);
}

TEST(ReferencePictures, TheComparisonSeesWhatAReaderWouldSee) {
  EXPECT_THAT(after("overlay", [](Figure&) {}), IsEmpty());
  EXPECT_THAT(
      after("overlay", [](Figure& figure) { figure.stacks[0].panels[0].y.label = "hub_angle"; }),
      Contains(HasSubstr("no \"hub angle [rad]\"")));
  EXPECT_THAT(
      after("overlay", [](Figure& figure) { figure.stacks[0].panels[0].series.pop_back(); }),
      Contains(HasSubstr("curves instead of")));
  EXPECT_THAT(
      after("overlay",
            [](Figure& figure) { figure.stacks[0].panels[0].series[1].style.colour = green; }),
      Contains(HasSubstr("\"arm file\" rgb(  0, 158, 115)")));
  EXPECT_THAT(after("overlay",
                    [](Figure& figure) {
                      figure.stacks[0].x.ticks = {{1.0, "one"}};
                    }),
              Contains(HasSubstr("\"one\" at")));
}

TEST(ReferencePictures, TheComparisonSeesAPeakThatMoved) {
  // Frequencies within the range move by up to 5 %, its ends and all heights stay.
  EXPECT_THAT(after("bode-hub_angle",
                    [](Figure& figure) {
                      for (Series& series : figure.stacks[0].panels[0].series) {
                        const double from = std::log(series.x.front());
                        const double range = std::log(series.x.back()) - from;
                        for (double& x : series.x) {
                          const double part = (std::log(x) - from) / range;
                          x *= 1.0 + 0.05 * std::sin(std::numbers::pi * part);
                        }
                      }
                    }),
              Contains(HasSubstr("is highest at")));
  EXPECT_THAT(after("bode-hub_angle",
                    [](Figure& figure) {
                      auto& series = figure.stacks[0].panels[0].series[0];
                      const double limit = 0.3 * std::ranges::max(series.y);
                      for (double& y : series.y) y = std::min(y, limit);
                    }),
              Contains(HasSubstr("reaches")));
}

}  // namespace
}  // namespace flexarm::report
