#include "tests/app/flexarm_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace flexarm::testing_app {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class FigureOptionsOf : public Flexarm {
 protected:
  FigureOptionsOf() { run({"new", "rig.toml"}); }
  Ended modes(const std::vector<std::string>& options) const {
    std::vector<std::string> arguments = {"modes", "rig.toml"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run(arguments);
  }
};

TEST_F(FigureOptionsOf, WriteEachFormat) {
  EXPECT_EQ(modes({"--out", "out", "--figure-format", "pdf,png"}).status, 0);
  EXPECT_THAT(names_in("out"), ElementsAre("damped_poles.csv", "modes.csv", "shapes.csv",
                                           "shapes.pdf", "shapes.png", "zeros.csv"));
  EXPECT_THAT(text_of("out/shapes.pdf"), StartsWith("%PDF-"));
  EXPECT_THAT(text_of("out/shapes.png"), StartsWith("\x89PNG"));
}

TEST_F(FigureOptionsOf, SetSizeAndFont) {
  EXPECT_EQ(modes({"--out", "out", "--figure-size", "254x140mm", "--font", "DejaVu Serif",
                   "--font-size", "12"})
                .status,
            0);
  const std::string svg = text_of("out/shapes.svg");
  EXPECT_THAT(svg, HasSubstr("width=\"960\" height=\"529\""));
  EXPECT_THAT(svg, HasSubstr("font-family=\"DejaVu Serif\""));
  EXPECT_THAT(svg, HasSubstr("font-size=\"16.00\""));
}

TEST_F(FigureOptionsOf, AreRefusedInOneLineBeforeAnythingIsWritten) {
  const std::string size =
      ": must be WIDTHxHEIGHT in pixels of 1/96 in, or with mm, cm or in, such as 160x100mm; each "
      "side from 100 to 10000 pixels";
  expect_refused(modes({"--out", "out", "--figure-format", "eps"}),
                 "--figure-format eps: must be svg, pdf or png");
  for (const char* text : {"800", "800x", "x600", "20x20", "800x600pt", "1e9x600", "nanx600",
                           "-800x600", "800x600x400"}) {
    expect_refused(modes({"--out", "out", std::string("--figure-size=") + text}),
                   std::string("--figure-size ") + text + size);
  }
  expect_refused(modes({"--out", "out", "--font", "Sans,20"}),
                 "--font Sans,20: must be the name of a font family, such as Helvetica");
  expect_refused(modes({"--out", "out", "--font", "a'b"}),
                 "--font a'b: must be the name of a font family, such as Helvetica");
  for (const char* points : {"3", "100", "nan"}) {
    const Ended ended = modes({"--out", "out", "--font-size", points});
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.errors, StartsWith("--font-size = "));
    EXPECT_THAT(ended.errors, HasSubstr("from 4 to 72"));
  }
  expect_refused(modes({"--out", "out", "--magnitude", "db"}),
                 "--magnitude db: must be absolute or dB");
  expect_refused(modes({"--out", "out", "--frequency-unit", "rpm"}),
                 "--frequency-unit rpm: must be Hz or rad/s");
  expect_refused(modes({"--out", "out", "--nyquist", "minus-one,circle"}),
                 "--nyquist circle: must be minus-one or negative-frequencies");
  EXPECT_THAT(names_in(), Not(Contains("out")));
}

TEST_F(FigureOptionsOf, UnitsAreThoseOfEveryBodeDiagram) {
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"response", "rig.toml"}, {"compare", "rig.toml", "--quick"}}) {
    std::vector<std::string> with = command;
    const std::string picture = command.front() + "/bode-hub_angle.svg";
    with.insert(with.end(), {"--sensor", "hub_angle", "--out", command.front(), "--force"});
    ASSERT_EQ(run(with).status, 0);
    const std::string absolute = text_of(picture);
    EXPECT_THAT(absolute, HasSubstr("[rad/(N m)]"));
    EXPECT_THAT(absolute, HasSubstr("frequency [Hz]"));
    with.insert(with.end(), {"--magnitude", "dB", "--frequency-unit", "rad/s"});
    ASSERT_EQ(run(with).status, 0);
    const std::string decibel = text_of(picture);
    EXPECT_THAT(decibel, HasSubstr("[dB re 1 rad/(N m)]"));
    EXPECT_THAT(decibel, HasSubstr("frequency [rad/s]"));
  }
}

TEST_F(FigureOptionsOf, UnitsAreThoseOfMeasuredResponses) {
  ASSERT_EQ(run({"simulate", "rig.toml", "--duration", "3", "--period", "0.005", "--sensor",
                 "hub_velocity", "--noise", "0.01", "--excitation", "random:rms=0.05,to=60,id=a",
                 "--out", "sim"})
                .status,
            0);
  std::vector<std::string> command = {
      "identify", "sim/measurement.toml", "--no-fit", "--out", "out", "--force"};
  ASSERT_EQ(run(command).status, 0);
  const std::string absolute = text_of("out/frf-a-hub_velocity.svg");
  EXPECT_THAT(absolute, HasSubstr("[rad/s/(N m)]"));
  EXPECT_THAT(absolute, HasSubstr("frequency [Hz]"));
  command.insert(command.end(), {"--magnitude", "dB", "--frequency-unit", "rad/s"});
  ASSERT_EQ(run(command).status, 0);
  const std::string decibel = text_of("out/frf-a-hub_velocity.svg");
  EXPECT_THAT(decibel, HasSubstr("[dB re 1 rad/s/(N m)]"));
  EXPECT_THAT(decibel, HasSubstr("frequency [rad/s]"));
}

TEST_F(FigureOptionsOf, NyquistDiagramsShowMoreOnRequest) {
  write("damped.toml", text_of("rig.toml") + "\n[effects.structural_damping]\ntime = 1e-4\n");
  const std::vector<std::string> command = {"response", "damped.toml", "--sensor", "hub_angle",
                                            "--out",    "out",         "--force"};
  ASSERT_EQ(run(command).status, 0);
  EXPECT_THAT(text_of("out/nyquist-hub_angle.svg"), Not(HasSubstr("negative frequencies")));
  auto with = command;
  with.insert(with.end(), {"--nyquist", "minus-one,negative-frequencies"});
  ASSERT_EQ(run(with).status, 0);
  const std::string svg = text_of("out/nyquist-hub_angle.svg");
  EXPECT_THAT(svg, HasSubstr("negative frequencies"));
  EXPECT_THAT(svg, HasSubstr(">−1<"));
}

TEST_F(FigureOptionsOf, NeedAFolder) {
  expect_refused(modes({"--figure-format", "pdf"}), "--figure-format: needs --out FOLDER");
  expect_refused(modes({"--figure-size", "800x600"}), "--figure-size: needs --out FOLDER");
  expect_refused(modes({"--font", "Serif"}), "--font: needs --out FOLDER");
  expect_refused(modes({"--font-size", "12"}), "--font-size: needs --out FOLDER");
  expect_refused(modes({"--magnitude", "dB"}), "--magnitude: needs --out FOLDER");
  expect_refused(modes({"--frequency-unit", "Hz"}), "--frequency-unit: needs --out FOLDER");
  expect_refused(modes({"--nyquist", "minus-one"}), "--nyquist: needs --out FOLDER");
}

TEST_F(FigureOptionsOf, AreThoseOfEveryCommandThatDraws) {
  for (const char* command :
       {"compare", "response", "modes", "sweep", "simulate", "identify", "diagnose", "plan"}) {
    const std::string help = run({command, "--help"}).output;
    for (const char* option : {"--figure-format", "--figure-size", "--font", "--font-size",
                               "--magnitude", "--frequency-unit", "--nyquist"}) {
      EXPECT_THAT(help, HasSubstr(option)) << command;
    }
  }
}

TEST_F(FigureOptionsOf, AFolderWithPdfAndPngIsReplacedByForce) {
  const std::vector<std::string> simulate = {"simulate", "rig.toml", "--duration",     "1", "--out",
                                             "out",      "--force",  "--figure-format"};
  auto with = [&](const char* formats) {
    auto arguments = simulate;
    arguments.emplace_back(formats);
    return run(arguments).status;
  };
  EXPECT_EQ(with("pdf,png"), 0);
  EXPECT_THAT(names_in("out"), Contains("bang-bang.pdf"));
  EXPECT_EQ(with("svg"), 0);
  EXPECT_THAT(names_in("out"), Not(Contains("bang-bang.pdf")));
}

}  // namespace
}  // namespace flexarm::testing_app
