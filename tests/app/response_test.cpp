#include "tests/app/flexarm_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace flexarm::testing_app {
namespace {

using Json = nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Adds an arm file with damping, an actuator and friction.
class Response : public Flexarm {
 protected:
  void write_rig() const {
    write("rig.toml",
          "[beam]\nlength = 0.96\nwidth = 0.019008\nthickness = 0.0032004\ndensity = 2710.0\n"
          "youngs_modulus = 7.11e10\n[hub]\ninertia = 5.86e-4\nviscous_friction = 0.002\n"
          "[damping]\nkelvin_voigt = 1e-4\n[effects.coulomb_friction]\ntorque = 0.012\n"
          "[effects.torque_saturation]\nlimit = 1.0\n[effects.time_delay]\ndelay = 0.001\n"
          "[effects.actuator_lag]\ntime_constant = 0.002\n");
  }
  /// Standard output of a shell command in the folder.
  std::string output_of(const std::string& command) const {
    return shell_output(command, folder_.string());
  }
};

TEST_F(Response, WithoutArgumentsItIsThePapersArm) {
  const Ended ended = run({"response", "--verbose"});
  EXPECT_EQ(ended.status, 0);
  EXPECT_EQ(ended.errors, "");
  EXPECT_THAT(ended.output,
              AllOf(HasSubstr("\nby exact_tf\n"), HasSubstr("11.86182864"),
                    HasSubstr("57.44089325"), HasSubstr("s^-2 prod"), HasSubstr("\nnext: ")));
}

TEST_F(Response, EveryFormulationGivesTheSameResponse) {
  constexpr double kAgreement = 1e-9;  // the formulations' own
  write_rig();
  const auto by = [&](const std::string& formulation) {
    const Ended ended = run({"response", "rig.toml", "--formulation", formulation, "--frequencies",
                             "0.5,7.3,30,80", "--json", formulation + ".json"});
    EXPECT_EQ(ended.status, 0) << ended.errors;
    return Json::parse(text_of(formulation + ".json"))["arms"][0]["sensors"];
  };
  const auto exact = by("exact_tf");
  for (const std::string name : {"fem", "assumed_modes"}) {
    const auto other = by(name);
    for (std::size_t k = 0; k < exact.size(); ++k) {
      for (std::size_t i = 0; i < 4; ++i) {
        const double re = exact[k]["response"]["re"][i];
        const double im = exact[k]["response"]["im"][i];
        const double tolerance = kAgreement * std::hypot(re, im);
        EXPECT_NEAR(other[k]["response"]["re"][i], re, tolerance) << name;
        EXPECT_NEAR(other[k]["response"]["im"][i], im, tolerance) << name;
      }
    }
  }
}

TEST_F(Response, WhatIsNotLinearIsLeftOutByName) {
  write_rig();
  const Ended ended = run({"response", "rig.toml", "--json", "out.json"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output,
              HasSubstr("not included (nonlinear): coulomb_friction, torque_saturation"));
  EXPECT_THAT(ended.output, HasSubstr("included: delay 0.001 s, actuator lag 0.002 s"));
  EXPECT_EQ(Json::parse(text_of("out.json"))["arms"][0]["left_out"],
            Json({"coulomb_friction", "torque_saturation"}));
}

TEST_F(Response, TheFolderHoldsTablesAndDiagrams) {
  write_rig();
  const Ended ended = run({"response", "rig.toml", "--out", "out", "--sensor", "hub_angle"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(names_in("out"), ElementsAre("bode-hub_angle.svg", "factors-hub_angle.csv", "frf.csv",
                                           "nyquist-hub_angle.svg", "poles.csv", "response.csv"));
}

TEST_F(Response, AnUndampedArmHasNoNyquistDiagramAndItIsSaid) {
  const Ended ended = run({"response", "--out", "out", "--sensor", "hub_angle"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output,
              HasSubstr("no Nyquist diagrams: no damped pole in the frequency range"));
  EXPECT_THAT(names_in("out"), Not(Contains(HasSubstr("nyquist"))));
}

TEST_F(Response, AListOfFrequenciesIsTakenAsItIs) {
  const Ended ended = run({"response", "--frequencies", "1,2,5", "--json", "out.json"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_EQ(Json::parse(text_of("out.json"))["arms"][0]["frequency_Hz"], Json({1.0, 2.0, 5.0}));
}

TEST_F(Response, AStaticCorrectionBringsTheStateSpaceNearer) {
  write_rig();
  const auto median_error = [&](std::vector<std::string> further) {
    std::vector<std::string> arguments = {"response", "rig.toml", "--state-space", "a.csv",
                                          "--json",   "out.json", "--modes",       "3"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    EXPECT_EQ(run(arguments).status, 0);
    const auto arm = Json::parse(text_of("out.json"))["arms"][0];
    EXPECT_EQ(arm["static_correction"], further.empty());
    return arm["sensors"][1]["state_space"]["median_error"].get<double>();
  };
  EXPECT_LT(median_error({}), 0.01 * median_error({"--modes-alone"}));
}

TEST_F(Response, TheStateSpaceHasAsManyModesAsItsErrorAsksFor) {
  write_rig();
  const auto truncation = [&](std::vector<std::string> further) {
    std::vector<std::string> arguments = {"response", "rig.toml", "--state-space",
                                          "a.json",   "--json",   "out.json"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    EXPECT_EQ(run(arguments).status, 0);
    return Json::parse(text_of("out.json"))["arms"][0]["truncation"];
  };
  const Json chosen = truncation({});
  EXPECT_TRUE(chosen["chosen"].get<bool>());
  ASSERT_FALSE(chosen["errors"].empty());
  for (const Json& sensor : chosen["errors"]) {
    EXPECT_LE(sensor["error"].get<double>(), chosen["tolerance"].get<double>()) << sensor;
  }
  const std::size_t flexible = chosen["modes"].get<std::size_t>();
  // Two states of the rigid body and of the residual mode each, one of the actuator.
  EXPECT_EQ(Json::parse(text_of("a.json"))["A"].size(), 2 * flexible + 5);
  const Json given = truncation({"--modes", "1", "--modes-alone"});
  EXPECT_FALSE(given["chosen"].get<bool>());
  EXPECT_EQ(given["modes"], 1);
  EXPECT_THAT(run({"response", "rig.toml", "--state-space", "b.json", "--modes", "1"}).output,
              HasSubstr("Truncation: 1 flexible mode given; estimated error"));
}

/// What a script in another language needs to compare A, B, C, D with `response`.
constexpr const char* kTolerance = "1e-9";  // solutions of 12 equations by another library

TEST_F(Response, SciPyReadsTheMatFileAndFindsTheSameBodeValues) {
  if (output_of("/usr/bin/python3 -c 'import scipy; print(1)' 2>/dev/null") != "1\n") {
    GTEST_SKIP() << "no SciPy for /usr/bin/python3 (Debian package python3-scipy)";
  }
  write_rig();
  EXPECT_EQ(run({"response", "rig.toml", "--state-space", "rig.mat"}).status, 0);
  write("check.py",
        "import numpy, scipy.io\n"
        "m = scipy.io.loadmat('rig.mat', squeeze_me=False)\n"
        "A, B, C, D = m['A'], m['B'], m['C'], m['D']\n"
        "G = []\n"
        "for f in m['frequency_Hz'].ravel():\n"
        "    s = 2j * numpy.pi * f\n"
        "    x = numpy.linalg.solve(s * numpy.eye(len(A)) - A, B)\n"
        "    G.append(((C @ x + D) * numpy.exp(-s * m['delay_s'][0, 0])).ravel())\n"
        "G = numpy.array(G).T\n"
        "print(', '.join(str(name[0][0]) for name in m['sensors']))\n"
        "error = abs(20 * numpy.log10(abs(G) / abs(m['response']))).max()\n"
        "turn = abs(numpy.angle(G / m['response'])).max()\n"
        "print('same' if G.shape[1] > 100 and error < " +
            std::string(kTolerance) + " and turn < " + kTolerance +
            " else f'{error} dB, {turn} rad')\n");
  EXPECT_EQ(output_of("/usr/bin/python3 check.py"), "hub_angle, tip_acceleration\nsame\n");
}

TEST_F(Response, OctaveReadsTheMatFileAndFindsTheSameBodeValues) {
  if (output_of("octave-cli --quiet --eval 'disp(1)' 2>/dev/null") != "1\n") {
    GTEST_SKIP() << "no GNU Octave";
  }
  write_rig();
  EXPECT_EQ(run({"response", "rig.toml", "--state-space", "rig.mat"}).status, 0);
  write("check.m",
        "load('rig.mat');\n"
        "error = 0; turn = 0;\n"
        "for k = 1:numel(frequency_Hz)\n"
        "  s = 2i * pi * frequency_Hz(k);\n"
        "  G = (C * ((s * eye(rows(A)) - A) \\ B) + D) * exp(-s * delay_s);\n"
        "  error = max([error; abs(20 * log10(abs(G) ./ abs(response(:, k))))]);\n"
        "  turn = max([turn; abs(arg(G ./ response(:, k)))]);\n"
        "end\n"
        "printf('%s, %s\\n', sensors{:});\n"
        "if error < " +
            std::string(kTolerance) + " && turn < " + kTolerance +
            ", printf('same\\n'); else, printf('%g dB, %g rad\\n', error, turn); end\n");
  EXPECT_EQ(output_of("octave-cli --quiet check.m 2>/dev/null"),
            "hub_angle, tip_acceleration\nsame\n");
}

TEST_F(Response, BadInputIsOneLineAndStatusTwo) {
  expect_refused(run({"response", "--state-space", "arm.txt"}),
                 "--state-space arm.txt: unknown extension; allowed: .json, .csv, .mat");
  expect_refused(run({"response", "--frequencies", "1,5,2"}),
                 "--frequencies = 2 Hz: must be above 5 Hz, the one before");
  expect_refused(run({"response", "--frequencies", "1.0,5", "--to-Hz", "9"}),
                 "--frequencies: not together with --from-Hz or --to-Hz");
  expect_refused(run({"response", "--from-Hz", "0"}), "--from-Hz = 0 Hz: must be above 0");
  expect_refused(run({"response", "--from-Hz", "9", "--to-Hz", "3"}),
                 "--to-Hz = 3 Hz: must be above 9 Hz");
  expect_refused(run({"response", "--points", "1"}), "--points = 1: must be 2 to 1000000");
  expect_refused(run({"response", "--modes", "0"}), "--modes = 0: must be 1 or more");
  expect_refused(run({"response", "--modes-alone"}), "--modes-alone: needs --state-space FILE");
  expect_refused(run({"response", "--state-space", "a.mat", "--payload-mass", "0,0.1"}),
                 "--state-space: needs one arm; --payload-mass has several values");
  expect_refused(run({"response", "--sensor", "strain@0.96"}),
                 "--sensor strain@0.96: strain at the tip is identically zero without "
                 "payload.inertia; place it below 0.96 m");
  EXPECT_THAT(run({"response", "--sensor", "tip_accelaration"}).errors,
              HasSubstr("did you mean tip_acceleration?"));
  EXPECT_THAT(run({"response", "--formulation", "fem", "--to-Hz", "1e6"}).errors,
              HasSubstr("exact_tf has no limit"));
  EXPECT_THAT(names_in(), ElementsAre());
}

TEST_F(Response, TheExampleInItsHelpWorks) {
  EXPECT_THAT(output_of_example("response"), HasSubstr("strain@0.05"));
}

}  // namespace
}  // namespace flexarm::testing_app
