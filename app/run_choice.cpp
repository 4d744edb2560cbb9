#include "app/run_choice.hpp"

#include "app/command.hpp"
#include "arm/input_error.hpp"
#include "arm/number.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdint>
#include <string>

namespace flexarm::app {

namespace {

/// The library reads -1 as 2^64 - 1.
CLI::Validator whole_number() {
  return {[](const std::string& value) {
            return arm::parse_number<std::uint64_t>(value)
                       ? std::string()
                       : fmt::format("{}: must be a whole number, 0 or more", arm::shown(value));
          },
          ""};
}

}  // namespace

void add_run_choice(CLI::App& parser, RunChoice& choice) {
  parser
      .add_option(
          "--excitation", choice.excitations,
          "KIND:KEY=VALUE,... in N m, s and Hz. KIND is bang-bang (amplitude, pulse, start, pairs; "
          "pairs=0: to the end of the run), step (amplitude, start), random (rms, from, to, seed), "
          "multisine (rms, from, to, period, detection, seed), chirp (amplitude, from, to, sweep), "
          "staircase (amplitude of a step, dwell, start, levels), prbs (amplitude, clock, "
          "register, "
          "seed), sine (amplitude, frequency, offset, phase, start) or stepped-sine (amplitude, "
          "offset, from and to or bands=FROM:TO/FROM:TO/..., step or points, settle, cycles). All "
          "kinds: id, payload [kg], purpose. Repeat for more runs")
      ->check(not_empty())
      ->allow_extra_args(false);
  parser
      .add_option("--torque", choice.torque_files,
                  "CSV file with the torque over time, or a time record. Repeat for more runs")
      ->check(not_empty())
      ->allow_extra_args(false);
  parser
      .add_option("--reference", choice.references,
                  "Closed loop: reference of the controller, KIND:KEY=VALUE,... as for "
                  "--excitation with the unit of its sensor in place of N m, or a CSV file with "
                  "the columns time [s] and reference [UNIT]. Repeat for more runs")
      ->check(not_empty())
      ->allow_extra_args(false);
  parser
      .add_option("--controller", choice.controller,
                  "Controller of --reference: KEY=VALUE,... with sensor, kp, kd, ki, derivative "
                  "(error or measurement), limit [N m] and sample_time [s], or a TOML file with "
                  "these keys or A, B, C, D")
      ->check(not_empty());
  parser.add_option(
      "--duration", choice.duration_s,
      fmt::format("Duration of each excitation [s]; default {}", experiment::kDefaultDuration_s));
  parser.add_option("--period", choice.period_s,
                    fmt::format("Sampling period [s]; default {}", experiment::kDefaultPeriod_s));
  parser
      .add_option("--seed", choice.seed,
                  "Seed of the noise; incremented for excitations without a seed")
      ->check(whole_number())
      ->capture_default_str();
}

}  // namespace flexarm::app
