#pragma once

#include "arm/arm.hpp"
#include "measured/checks/data_check.hpp"
#include "measured/checks/run_check.hpp"
#include "measured/files/time_record.hpp"
#include "response/time/random_numbers.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::measured {

double between(response::RandomNumbers& random, double low, double high);
double log_between(response::RandomNumbers& random, double low, double high);
bool chance(response::RandomNumbers& random, double probability);

/// A whole number from the environment, for tests that print rates.
int setting(const char* name, int otherwise);

/// What a drawn run must have, so that a fault can be planted in it.
struct CaseNeeds {
  std::vector<arm::SensorKind> sensors;  ///< among others
  int refinement = 1;                    ///< samples simulated for one that is kept
  double least_samples = 400;
  double most_noise = 0.03;
  double least_rate_Hz = 200.0;
  std::optional<arm::Arm> arm = {};  ///< this one, with friction of its own
};

/// A run of an arm drawn at random: arm, friction, payload, torque, sampling and sensors.
struct DrawnRun {
  TimeRecord fine;  ///< without noise, `refinement` samples for one
  arm::Arm arm;
  double length_m = 0.0;  ///< from axis to tip
  double total_inertia_kg_m2 = 0.0;
  double noise = 0.0;      ///< standard deviation over the signal's own
  int rounded_digits = 0;  ///< of the file; 0: every double in full
  int refinement = 1;
  std::string description;
};

/// The paper's arm and others up to twice its size, bare or loaded, with and without friction
/// (Coulomb, Stribeck) and drag; random, multisine, bang-bang and chirp torque; 200 Hz to 2 kHz, 2
/// to 20 s; noise of 0.3 to 3 %. The seed determines it.
DrawnRun draw_run(std::uint64_t seed, const CaseNeeds& needs = {});

/// Every `refinement`-th sample, those of `sensor` `late` fine samples late; with noise, and
/// rounded as in a file.
TimeRecord sampled(const DrawnRun& run, response::RandomNumbers& random,
                   std::optional<arm::SensorKind> sensor = {}, int late = 0);

/// Adds the noise of a run, and rounds as its file does.
void finish(TimeRecord& record, const DrawnRun& run, response::RandomNumbers& random);

/// Standard deviation.
double deviation(const std::vector<double>& values);

/// Adds amplitude cos(2 pi frequency t + phase), t from 0 at the first value.
void add_line(std::vector<double>& values, double period_s, double frequency_Hz, double amplitude,
              double phase_rad = 0.0);

/// What `check_data` may know of a run's arm: length, inertia and the arm as a file describes it,
/// by another formulation than the run's, without friction, and for half of the seeds with errors
/// of 1 % (standard deviation) in rigidity, density and hub inertia.
DataCheckOptions known_arm(const DrawnRun& run, std::uint64_t seed);
/// The same with any payload.
DescribedArms known_arms(const DrawnRun& run, std::uint64_t seed);

/// An arm without effects.
arm::Arm draw_arm(response::RandomNumbers& random);

/// A record with a fault in it.
struct PlantedFault {
  TimeRecord record;
  DataCheckOptions options;
  std::string channel;  ///< that it is in
  std::size_t first_sample = 0;
  std::size_t last_sample = 0;  ///< the first sample of the finding lies between these
  std::string description;
  double value = 0.0;              ///< its size, of faults that the described arm shows
  std::vector<Fault> beside = {};  ///< planted with it, to be found or not
  std::size_t least_readings = 0;  ///< that the finding predicts
};

/// A fault of random size in a run of its own; the ranges of sizes are in docs/measured-data.md.
PlantedFault plant(Fault fault, std::uint64_t seed);

/// Those that the described arm shows.
PlantedFault plant_clock_rate(std::uint64_t seed, response::RandomNumbers& random);
PlantedFault plant_late_sensor(std::uint64_t seed, response::RandomNumbers& random);
PlantedFault plant_offset(std::uint64_t seed, response::RandomNumbers& random);
PlantedFault plant_wrong_scale(std::uint64_t seed, response::RandomNumbers& random);

/// A run without fault; half of them with the arm's length and inertia at hand.
PlantedFault clean(std::uint64_t seed);

/// A run as the simulation gives it, to the last bit or to seven digits.
PlantedFault clean_without_noise(std::uint64_t seed);

}  // namespace flexarm::measured
