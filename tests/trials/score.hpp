#pragma once

#include "tests/trials/answer.hpp"
#include "tests/trials/rig_score.hpp"
#include "tests/trials/trial_case.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::trials {

/// How an answer compares with the truth.
enum class Outcome {
  exact,        ///< the hidden causes are named and no other
  in_class,     ///< as exact with a cause that is said to be confusable with the one named
  partly,       ///< some of the hidden causes are named, or others beside them
  wrong,        ///< others are named; or one is beside what is not explained in full
  missed,       ///< adequate, though something is hidden
  abstained,    ///< unexplained, though the vocabulary has the cause
  quiet,        ///< nothing is hidden and nothing is said
  false_alarm,  ///< nothing is hidden, but a cause is named
  doubted,      ///< nothing is hidden and none is named, but the arm is not found adequate
  recognised,   ///< a cause outside the vocabulary: not explained, and none named that is likely
  mistaken,     ///< a cause outside the vocabulary is explained by one in it
  no_answer,    ///< the program failed or took too long
};
std::string_view to_string(Outcome outcome);
Outcome parse_outcome(std::string_view name);

/// A class of causes that data cannot tell apart has this many members at most, the named one
/// included, to count as an answer.
inline constexpr std::size_t kLargestClass = 3;
/// A parameter is recovered within this part of its value.
inline constexpr double kRecovered = 0.05;
/// What is left of validation data against their noise, at most.
inline constexpr double kNoiseReached = 1.1;

/// A cause that is named where the one that is hidden has no name is wrong above this probability.
inline constexpr double kClaimed = 0.5;

/// A cause that the program named, with the probability that it claimed.
struct Claim {
  double probability = 1.0;
  bool right = false;  ///< it was hidden
};

/// What the program says of the dirt of a recording.
enum class DirtAnswer {
  none,     ///< there is no dirt, or it has no name in the library
  named,    ///< by its effect, or a class of at most three with it
  unnamed,  ///< it is not, though the library has it
};
std::string_view to_string(DirtAnswer answer);
DirtAnswer parse_dirt_answer(std::string_view name);

/// Whether the port of the missing force is right where one cause outside the library is hidden.
enum class PortAnswer {
  none,          ///< another truth, or no answer
  right,         ///< stated, alone or beside one that is indistinguishable
  wrong,         ///< others are stated
  undetermined,  ///< none is
};
std::string_view to_string(PortAnswer answer);
PortAnswer parse_port_answer(std::string_view name);

/// One trial as a line of the results. An effect that is the dirt of the recording is not among
/// `named`, and counts neither for nor against the outcome.
struct TrialResult {
  std::string version;  ///< of the program that answered
  std::string id;
  std::string kind;
  std::string arm;
  double noise = 0.0;
  std::string strength;  ///< "-" where nothing is hidden
  std::vector<std::string> hidden;
  bool outside = false;
  double error = 0.0;  ///< that the hidden causes make, the mean of each by itself
  Outcome outcome = Outcome::no_answer;
  std::string verdict;
  std::vector<std::string> named;
  std::vector<Claim> claims;   ///< one a named cause
  std::size_t class_size = 1;  ///< the largest of the named causes
  int parameters = 0;          ///< of causes named rightly
  int recovered = 0;           ///< within kRecovered
  int covered = 0;             ///< within 1.96 standard errors
  double before = 0.0;         ///< relative error on estimation runs
  double after = 0.0;
  double validation_after = 0.0;
  double validation_floor = 0.0;
  double time_s = 0.0;       ///< elapsed
  double processor_s = 0.0;  ///< of all threads
  std::string dirt = "-";    ///< "-" for none
  DirtAnswer dirt_answer = DirtAnswer::none;
  PortAnswer port_answer = PortAnswer::none;
  std::vector<std::string> ports;  ///< that are stated
  std::optional<RigScore> rig;
  std::string values;  ///< found (hidden), for a reader
  std::string folder;
};

TrialResult score(const Truth& truth, const Answer& answer);

}  // namespace flexarm::trials
