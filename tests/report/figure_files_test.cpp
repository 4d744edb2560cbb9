#include "report/figures/figure_files.hpp"

#include "report/figures/figure_layout.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace flexarm::report {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

Figure small_figure() {
  Figure figure{.title = "Residual λ ≤ 10⁻³"};
  Panel panel{.y = {.label = "residual", .unit = "m/s²"}};
  panel.series = {{"measured", {1, 2, 3}, {1, -1, 2}, {.marker = Marker::circle}},
                  {"interval", {1, 2, 3}, {0, -2, 1}, {.colour = grey, .filled = true}, {2, 0, 3}}};
  figure.stacks = {{.x = {.label = "time", .unit = "s"}, .panels = {panel, panel}}};
  return figure;
}

/// Bytes 16 to 24 of a PNG: width and height, the most significant byte first.
std::vector<int> png_size(const std::string& png) {
  const auto number = [&](std::size_t at) {
    int value = 0;
    for (std::size_t i = at; i < at + 4; ++i) {
      value = 256 * value + static_cast<unsigned char>(png.at(i));
    }
    return value;
  };
  return {number(16), number(20)};
}

TEST(FigureFiles, HasAFileForEachFigureAndFormat) {
  FigureOptions options;
  options.formats = {FigureFormat::svg, FigureFormat::pdf, FigureFormat::png};
  const auto files = figure_files({{"one", small_figure()}, {"two", small_figure()}}, options);
  std::vector<std::string> names;
  for (const auto& file : files) names.push_back(file.name);
  EXPECT_THAT(names, testing::ElementsAre("one.svg", "one.pdf", "one.png", "two.svg", "two.pdf",
                                          "two.png"));
  EXPECT_THAT(files[0].content, HasSubstr("</svg>"));
  EXPECT_THAT(files[1].content, StartsWith("%PDF-"));
  EXPECT_THAT(files[2].content, StartsWith("\x89PNG"));
  EXPECT_EQ(png_size(files[2].content), (std::vector<int>{1800, 1200})) << "two pixels for one";
}

TEST(FigureFiles, APdfHasItsFontInIt) {
  const std::string pdf = drawn(small_figure(), FigureFormat::pdf);
  // Cairo embeds a subset: its font descriptor names the stream of the font's program.
  EXPECT_THAT(pdf, testing::AnyOf(HasSubstr("/FontFile2"), HasSubstr("/FontFile3"),
                                  HasSubstr("/FontFile ")));
}

TEST(FigureFiles, SizeAndFontAreThoseAskedFor) {
  FigureOptions options;
  options.size = FigureSize{640, 480};
  options.font = "DejaVu Serif";
  options.font_size_px = 20.0;
  const auto svg = figure_files({{"one", small_figure()}}, options).front().content;
  EXPECT_THAT(svg, HasSubstr("width=\"640\" height=\"480\""));
  EXPECT_THAT(svg, HasSubstr("font-family=\"DejaVu Serif\""));
  EXPECT_THAT(svg, HasSubstr("font-size=\"20.00\""));
}

TEST(FigureFiles, AFigureIsEnlargedUntilItsPanelsHaveRoom) {
  FigureOptions options;
  options.size = FigureSize{150, 120};
  options.font_size_px = 30.0;
  const Figure enlarged = with_options(small_figure(), options);
  for (const auto& boxes : lay_out(enlarged).boxes) {
    for (const PanelBox& box : boxes) {
      EXPECT_GE(box.top_px - box.bottom_px, 3.9 * box.text.line_px());
      EXPECT_GE(box.right_px - box.left_px, 13.0 * box.text.character_px());
    }
  }
  const Figure same = with_options(small_figure(), {});
  EXPECT_EQ(same.width_px, small_figure().width_px);
  EXPECT_EQ(same.height_px, small_figure().height_px);
}

}  // namespace
}  // namespace flexarm::report
