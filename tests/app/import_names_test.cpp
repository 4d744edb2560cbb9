// Names and units in a log that say more than a quantity, imported by the program.
#include "tests/app/import_files.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace flexarm::testing_app {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ImportNames : public ImportFiles {
 protected:
  /// A log of three rows under the header.
  void write_log(const std::string& header) const {
    write("log.csv", header + "\n0,1,90\n1,2,90\n2,3,90\n");
  }
};

TEST_F(ImportNames, ASignInANameIsNeverIgnored) {
  write_log("t [s],-Torque [Nm],theta [deg]");
  EXPECT_THAT(import({"log.csv"}).errors,
              HasSubstr("-Torque [Nm] may be torque, but its name has -; state it with --column "
                        "'torque=-Torque:N m:-1', without -1 where its numbers are torque itself"));
  EXPECT_EQ(record({"log.csv", "--column", "torque=-Torque:N m:-1"}).torque_N_m[2], -3.0);
  write("log.json",
        R"({"t": [0, 1, 2], "tau": [1, 2, 3], "-theta": [1, 2, 3], "omega": [1, 2, 3]})");
  const auto made = record({"log.json"});
  ASSERT_EQ(made.channels.size(), 1U);
  EXPECT_THAT(output_, HasSubstr("warning: not imported: -theta may be hub_angle"));
}

TEST_F(ImportNames, AFunctionInANameIsNeverIgnored) {
  for (const std::string name : {"|tau|", "abs(tau)", "log(tau)", "d(tau)/dt", "1-tau", "1/tau",
                                 "tau+90", "\xce\x94tau", "-tau"}) {
    write_log("t [s]," + name + " [N m],theta [deg]");
    EXPECT_THAT(import({"log.csv"}).errors, AllOf(HasSubstr("torque: column not recognised"),
                                                  HasSubstr("may be torque, but its name has")))
        << name;
  }
}

TEST_F(ImportNames, PartsOfAResponseAreReadWithoutSignsAndNumbersInTheirNamesAlone) {
  const std::string rows = "\n1,2,3\n2,3,4\n";
  for (const std::string columns :
       {"Real,-Imag", "Re(H1),-Im(H1)", "Magnitude (dB),-Phase (deg)", "-Gain (dB),Phase (deg)",
        "1/Magnitude,Phase (deg)", "Magnitude (dB),Phase (deg) + 180",
        "Magnitude (dB) - 20,Phase (deg)"}) {
    write("f.csv", "Frequency (Hz)," + columns + rows);
    EXPECT_THAT(import({"f.csv"}).errors, HasSubstr("write the numbers without it")) << columns;
  }
  for (const std::string columns :
       {"Inverse magnitude (dB),Phase (deg)", "Tau/Theta Magnitude,Tau/Theta Phase (deg)"}) {
    write("f.csv", "Frequency (Hz)," + columns + rows);
    EXPECT_THAT(import({"f.csv"}).errors, HasSubstr("an inverse of the response")) << columns;
  }
  write("f.csv", "Frequency (Hz),conj H real,conj H imag" + rows);
  EXPECT_THAT(import({"f.csv"}).errors, HasSubstr("a conjugate, whose phase has the other sign"));
  for (const std::string columns :
       {"Theta/Tau Magnitude (rad/Nm),Theta/Tau Phase (deg)", "|H1|,arg(H1) (rad)",
        "abs(H1),phase(H1) (rad)", "H1-2 mag,H1-2 phase (rad)"}) {
    write("f.csv", "Frequency (Hz)," + columns + rows);
    EXPECT_EQ(response({"f.csv"}).channels.size(), 1U) << columns;
  }
}

TEST_F(ImportNames, MarksOfDerivativesAndReferencesAreAskedAbout) {
  for (const std::string name : {"theta'", "theta.", "\xce\xb8\xcc\x87", "\xce\xb8\xcc\x88"}) {
    write_log("t [s],tau [N m]," + name);
    EXPECT_THAT(import({"log.csv"}).errors, HasSubstr("may be hub_angle, but its name has"))
        << name;
  }
  write_log("t [s],tau [N m],\xce\xb8* [rad]");
  EXPECT_THAT(import({"log.csv"}).errors, HasSubstr("it may be a reference; state it with"));
  write_log("t [s],tau [N m],\xce\xb8\xcc\x87 [rad/s]");
  EXPECT_EQ(record({"log.csv"}).channels.at(0).sensor.kind, arm::SensorKind::hub_velocity);
}

TEST_F(ImportNames, ATorqueThatItsUnitAloneTellsIsWarnedAbout) {
  for (const std::string name : {"foo", "Channel A", "torque at link side", "maxon"}) {
    write_log("t [s]," + name + " [N m],theta [deg]");
    EXPECT_EQ(record({"log.csv"}).torque_N_m[2], 3.0);
    EXPECT_THAT(output_, HasSubstr("warning: " + name + " [N m] is taken as torque by its unit"));
    record({"log.csv", "--column", "torque=" + name});
    EXPECT_THAT(output_, Not(HasSubstr("by its unit")));
  }
  for (const std::string name : {"Drehmoment", "motor torque", "tau"}) {
    write_log("t [s]," + name + " [N m],theta [deg]");
    record({"log.csv"});
    EXPECT_THAT(output_, Not(HasSubstr("by its unit")));
  }
}

TEST_F(ImportNames, ATorqueThatIsNotTheMotorsIsAskedAbout) {
  for (const std::string name :
       {"bending moment", "Biegemoment", "Lastmoment", "torque limit", "torque rate",
        "torque noise", "max. Moment", "torque min", "friction torque", "Reibmoment",
        "St\xc3\xb6rmoment", "root moment", "torque (negated)", "torque_ref2", "gravity torque",
        "MaxTorque", "tau_f", "torque before gear", "log torque"}) {
    write_log("t [s]," + name + " [N m],theta [deg]");
    EXPECT_THAT(import({"log.csv"}).errors,
                AllOf(HasSubstr("torque: column not recognised"),
                      HasSubstr("if it is the torque on the hub, state it with --column 'torque=")))
        << name;
  }
  // Beside the torque it is nothing.
  write("log.csv", "t [s],tau [N m],load torque [N m],theta [deg]\n0,1,2,3\n1,1,2,3\n2,1,2,3\n");
  record({"log.csv"});
  EXPECT_THAT(output_, Not(HasSubstr("load torque [N m] may be")));
}

TEST_F(ImportNames, AStatedUnitThatTheFileContradictsIsWarnedOf) {
  write_log("t_ms,Torque (mNm),Angle (deg)");
  const auto expect_warned = [&](const std::vector<std::string>& options, const std::string& of) {
    std::vector<std::string> arguments = {"log.csv"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    record(arguments);
    EXPECT_THAT(output_, HasSubstr("warning: " + of)) << of;
  };
  expect_warned({"--torque", "[Torque]"}, "torque: the file tells N mm of Torque (mNm), but it is");
  expect_warned({"--column", "hub_angle=Angle (deg):rad"},
                "hub_angle: the file tells deg of Angle");
  expect_warned({"--column", "torque=Angle:V:2", "--column", "hub_angle=Torque:V:2"},
                "torque: the file tells deg of Angle");
  expect_warned({"--time-unit", "s"}, "time: the file tells ms of t_ms, but it is read in s");
  expect_warned({"--compute", "hub_velocity=ddt([Angle])"}, "hub_velocity: the file tells deg of");
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
           {"--torque", "0.001*[Torque]"},
           {"--column", "hub_angle=Angle:rad:0.0171"},
           {"--column", "hub_angle=Torque:deg:90", "--column", "torque=Angle:N m:2"},
           {"--compute", "hub_velocity [deg/s]=ddt([Angle])"}}) {
    std::vector<std::string> arguments = {"log.csv"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    record(arguments);
    EXPECT_THAT(output_, Not(HasSubstr("the file tells"))) << options[1];
  }
}

TEST_F(ImportNames, AUnitThatIsAmbiguousIsAskedAbout) {
  write_log("t [s],tau [N m],omega [1/s]");
  EXPECT_THAT(import({"log.csv"}).errors,
              HasSubstr("omega [1/s] may be hub_velocity, but 1/s is no unit of it; state it with "
                        "--column 'hub_velocity=omega:UNIT:SCALE'"));
  write_log("t [s],tau [N m],acc [G]");
  EXPECT_THAT(import({"log.csv"}).errors,
              HasSubstr("acc [G] may be tip_acceleration, but G is no unit of it; state it with"));
}

TEST_F(ImportNames, AScaleThatUndoesTheConversionOfItsUnitIsRefused) {
  write_log("t [s],tau [N m],th");
  expect_refused(import({"log.csv", "--column", "hub_angle=th:deg:180/pi"}),
                 "--column hub_angle=th:deg:180/pi: scale = 57.2958: the inverse of the conversion "
                 "of deg, 0.0174533, which is applied already; leave it out if the numbers are in "
                 "deg; write unit rad if they are in rad");
}

TEST_F(ImportNames, ThePlaceOfAGaugeIsInMetresOrHasAUnit) {
  for (const std::string name : {"strain@50mm", "strain@50 mm", "strain@0.05m", "strain@0,05"}) {
    write("log.csv", "t [s];tau [N m];" + name + " [\xc2\xb5\xce\xb5]\n0;1;90\n1;1;90\n2;1;90\n");
    const auto made = record({"log.csv"});
    ASSERT_EQ(made.channels.size(), 1U) << name;
    EXPECT_EQ(arm::to_string(made.channels[0].sensor), "strain@0.05") << name;
  }
  write_log("t [s],tau [N m],strain@50 [ustrain]");
  EXPECT_THAT(import({"log.csv"}).errors,
              HasSubstr("strain@50 [ustrain] may be a strain at a place in mm; state it with "
                        "--column 'strain@X=strain@50', X in m from the hub"));
  EXPECT_EQ(record({"log.csv", "--column", "strain@0.05=strain@50"}).channels.size(), 1U);
  write("log.csv", "t [s],tau [N m],theta [rad],strain@50 [1]\n0,1,1,1\n1,1,1,1\n2,1,1,1\n");
  EXPECT_EQ(record({"log.csv"}).channels.size(), 1U);
  EXPECT_THAT(output_, HasSubstr("warning: not imported: strain@50 [1] may be a strain"));
}

TEST_F(ImportNames, CoherencesThatAreNoneAreNoted) {
  write("f.csv",
        "Frequency (Hz),Coherence,Magnitude (rad/Nm),Phase (deg)\n1,1.02,2,30\n2,0.5,2,40\n");
  const auto made = response({"f.csv"});
  EXPECT_EQ(made.channels.at(0).coherence.at(1), 0.5);
  EXPECT_THAT(output_, HasSubstr("1 of 2 coherences of Coherence are not known: must be above 0"));
}

}  // namespace
}  // namespace flexarm::testing_app
