#include "measured/files/text_file.hpp"
#include "tests/app/flexarm_fixture.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <iterator>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace flexarm::testing_app {
namespace {

using Json = nlohmann::json;

// A user waits so long for a result.
constexpr double kMost_s = 20.0;

/// An arm of a beam of 0.3 to 1.5 m by chance, and how it is excited.
struct RandomArm {
  std::string arm;
  std::string sensors;
  std::string excitation;
};

RandomArm random_session(unsigned seed) {
  std::mt19937_64 bits(seed);
  // Not std::uniform_real_distribution, whose numbers differ between libraries.
  const auto between = [&bits](double from, double to) {
    return from + (to - from) * static_cast<double>(bits() >> 11U) * 0x1p-53;
  };
  struct Material {
    double density;
    double modulus;
  };
  constexpr std::array<Material, 3> kMaterials = {{{2710, 7.1e10}, {7850, 2.1e11}, {1600, 6e10}}};
  const Material material = kMaterials[bits() % kMaterials.size()];
  const double length = between(0.3, 1.5);
  const double thickness = length * between(0.0015, 0.005);
  const double width = thickness * between(4.0, 10.0);
  const double mass = length * thickness * width * material.density;
  const double hub = mass * length * length * std::pow(10.0, between(-2.5, 0.5));
  RandomArm made;
  made.arm = fmt::format(
      "name = \"random {}\"\n[beam]\nlength = {}\nwidth = {}\nthickness = {}\ndensity = {}\n"
      "youngs_modulus = {}\n[hub]\ninertia = {}\n",
      seed, length, width, thickness, material.density, material.modulus, hub);
  if (bits() % 2 == 0) made.arm += fmt::format("viscous_friction = {}\n", hub * between(0.1, 3.0));
  if (bits() % 2 == 0) {
    made.arm += fmt::format("[payload]\nmass = {}\ninertia = {}\n", mass * between(0.05, 1.0),
                            mass * length * length * between(0.0, 1e-3));
  }
  if (bits() % 2 == 0) {
    made.arm += fmt::format("[damping]\nkelvin_voigt = {}\n", std::pow(10.0, between(-6.0, -4.0)));
  }
  made.sensors = fmt::format("hub_angle,hub_velocity,tip_acceleration,strain@{:.3f}",
                             length * between(0.02, 0.5));
  const double torque = (hub + mass * length * length / 3.0) * between(1.0, 6.0);
  const std::array<std::string, 6> excitations = {
      fmt::format("bang-bang:amplitude={}", torque),
      fmt::format("random:rms={},to=60", torque / 3.0),
      fmt::format("multisine:rms={},to=40", torque / 3.0),
      fmt::format("prbs:amplitude={},clock=0.02", torque / 3.0),
      fmt::format("prbs:amplitude={}", torque / 3.0),
      fmt::format("chirp:amplitude={},to=50", torque / 3.0)};
  made.excitation = excitations[bits() % excitations.size()];
  return made;
}

class Session : public Flexarm {
 protected:
  /// The verdict of a diagnosis of simulated/measurement.toml.
  std::string verdict() const {
    const Ended ended = run({"diagnose", "simulated/measurement.toml", "--json", "d.json"});
    EXPECT_EQ(ended.errors, "");
    return Json::parse(text_of("d.json")).at("verdict").get<std::string>();
  }

  /// Poles by the fit have the frequency of the order they are given.
  static void expect_poles_of_the_arm(const Json& identified) {
    constexpr double kOff_percent = 0.1;
    constexpr double kPeaks_percent = 7.0;  // of readings by peaks: compare::kSamePole
    int poles = 0;
    for (const auto& reading : identified["readings"]) {
      for (const auto& root : reading["roots"]) {
        if (root["feature"] != "pole" || root["order"].is_null()) continue;
        ++poles;
        const double within = reading["method"] == "fit" ? kOff_percent : kPeaks_percent;
        EXPECT_LT(std::abs(root["error_percent"].get<double>()), within)
            << reading["method"] << root;
      }
    }
    EXPECT_GE(poles, 5);
  }

  /// Simulates and diagnoses.
  void expect_adequate(const RandomArm& session) const {
    write("rig.toml", session.arm);
    const double before_s = processor_s();
    EXPECT_EQ(run({"simulate", "rig.toml", "--sensor", session.sensors, "--excitation",
                   session.excitation, "--out", "simulated", "--force"})
                  .status,
              0);
    EXPECT_EQ(verdict(), "adequate") << session.excitation << "\n" << session.arm;
    EXPECT_LT(processor_s() - before_s, kMost_s) << session.excitation << "\n" << session.arm;
  }
};

/// The commands of the README's block that begins with `flexarm doctor`, without their comments.
std::vector<std::vector<std::string>> commands_of_readme() {
  const std::string text = measured::read_text_file(FLEXARM_SOURCE_DIR "/README.md", 1 << 20);
  std::istringstream lines(text.substr(text.find("\nflexarm doctor") + 1));
  std::vector<std::vector<std::string>> commands;
  for (std::string line; std::getline(lines, line) && line != "```";) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string program;
    words >> program;
    commands.emplace_back(std::istream_iterator<std::string>(words),
                          std::istream_iterator<std::string>());
  }
  return commands;
}

TEST_F(Session, OfTheReadmeIsAdequate) {
  const double before_s = processor_s();
  const auto commands = commands_of_readme();
  ASSERT_EQ(commands.size(), 7U);
  for (auto command : commands) {
    if (command.front() == "identify") command.insert(command.end(), {"--json", "i.json"});
    if (command.front() == "diagnose") command.insert(command.end(), {"--json", "d.json"});
    const Ended ended = run(command);
    EXPECT_EQ(ended.status, 0) << command.front() << "\n" << ended.output << ended.errors;
  }
  EXPECT_EQ(Json::parse(text_of("d.json"))["verdict"], "adequate");
  EXPECT_LT(processor_s() - before_s, kMost_s);
  expect_poles_of_the_arm(Json::parse(text_of("i.json")));
}

/// Modes far above the Nyquist frequency of noise-free data are seen as aliases.
TEST_F(Session, EveryPoleThatIsIdentifiedIsOneOfTheArm) {
  run({"new", "rig.toml"});
  for (const char* excitation : {"prbs:clock=0.01", "random:to=400", "chirp:to=200"}) {
    EXPECT_EQ(
        run({"simulate", "rig.toml", "--excitation", excitation, "--out", "s", "--force"}).status,
        0);
    EXPECT_EQ(run({"identify", "s/measurement.toml", "--json", "i.json"}).status, 0);
    expect_poles_of_the_arm(Json::parse(text_of("i.json")));
  }
}

TEST_F(Session, HiddenFrictionAndRootComplianceAreExplained) {
  run({"new", "rig.toml"});
  write("rig.toml", text_of("rig.toml") +
                        "\n[effects.coulomb_friction]\ntorque = 0.012\n"
                        "[effects.root_compliance]\nstiffness = 60.0\n");
  EXPECT_EQ(run({"simulate", "rig.toml", "--hide-effects", "all", "--out", "simulated"}).status, 0);
  EXPECT_EQ(verdict(), "explained");
}

/// Seeds.
class RandomSession : public Session, public testing::WithParamInterface<unsigned> {};

INSTANTIATE_TEST_SUITE_P(, RandomSession, testing::Range(1U, 21U));

TEST_P(RandomSession, IsAdequate) {
  expect_adequate(random_session(GetParam()));
}

}  // namespace
}  // namespace flexarm::testing_app
