#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace flexarm::trials {

/// A cause as the program names it.
struct NamedCause {
  struct Value {
    double value = 0.0;
    double std_error = 0.0;
  };
  std::string effect;
  std::string sensor;
  std::map<std::string, Value> parameters;
  std::vector<std::string> confusable_with;
  double probability = 1.0;  ///< that it is the cause, as the program claims
};

/// Relative errors; all 0 where the file has none.
struct AnsweredGain {
  double before = 0.0;
  double after = 0.0;
  double noise_floor = 0.0;
};

/// What `flexarm diagnose` says (docs/formats.md), and what it took.
struct Answer {
  std::string verdict;  ///< empty where the program did not answer
  std::vector<NamedCause> causes;
  /// Ports that the missing force is stated to act at: "hub", "sensor hub_angle+hub_velocity".
  std::vector<std::string> ports;
  AnsweredGain estimation;
  AnsweredGain validation;
  double time_s = 0.0;       ///< elapsed
  double processor_s = 0.0;  ///< of all threads
};

/// Reads the JSON file of a diagnosis. Throws std::exception where it is none.
Answer read_answer(const std::filesystem::path& json_file);

/// Runs `program diagnose` on the measurement in `case_folder` and reads its answer; the program
/// writes into `work_folder`. After `time_limit_s` it answers with the best so far.
Answer ask(const std::filesystem::path& program, const std::filesystem::path& case_folder,
           const std::filesystem::path& work_folder, double time_limit_s);

}  // namespace flexarm::trials
