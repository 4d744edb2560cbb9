#pragma once

#include "measured/files/measurement.hpp"
#include "measured/files/time_record.hpp"
#include "tests/trials/excitations.hpp"
#include "tests/trials/experiment_plan.hpp"
#include "tests/trials/random.hpp"
#include "tests/trials/time_simulation.hpp"
#include "tests/trials/world.hpp"

#include <functional>
#include <string>
#include <vector>

namespace flexarm::trials {

/// A time run as it is recorded, the noise of every trial included.
struct Recording {
  measured::Run run;
  measured::TimeRecord record;
};

/// What a laboratory adds to time runs, beside the noise of every trial. Each file dirt/NAME.cpp
/// defines one function `Dirt NAME()`, which the build finds by the name of the file. The hooks act
/// where the dirt comes in, each of them may be empty. Of their size 1 is usual; at 0 a hook leaves
/// everything as it is, to the last bit.
struct Dirt {
  std::string name;
  /// Effects of the library that are this dirt: who names one names the dirt, no physical cause.
  std::vector<std::string> named_as = {};
  /// Effects on numbers that the arm file says are uncertain: those are refitted, not named.
  std::vector<std::string> refitted = {};
  /// Readings are gone, or are those of another sensor: causes on a sensor are not hidden beside
  /// it.
  bool changes_sensors = false;
  /// Of the error that a hidden cause makes, this part at size 1.
  double strength = 1.0;
  /// Which runs are made, and under which torque.
  std::function<void(double size, std::vector<PlannedRun>& runs)> plan = {};
  /// What is hidden in the arm or in the paths of torque and sensors.
  std::function<World(double size, const TrialArm& of, const World& world, Random& random)> hide =
      {};
  /// How a run is made.
  std::function<void(double size, const TrialArm& of, Random& random, TimeOptions& options)>
      simulation = {};
  /// What becomes of a recording.
  std::function<void(double size, Random& random, Recording& made)> recording = {};
  /// What the arm file says.
  std::function<void(double size, Random& random, arm::Arm& file)> arm_file = {};
};

/// By name.
const std::vector<Dirt>& dirts();
/// The dirt of that name, one without hooks for ""; throws InputError where there is none.
const Dirt& find_dirt(const std::string& name);

/// `world` with the cause at this size on that sensor, where the dirt is an effect of the library.
World with_named_dirt(const World& world, const TrialArm& of, const std::string& cause, double size,
                      const std::string& sensor, Random& random);

/// A channel that an analogue sensor gave: all but the hub angle, which an encoder counts.
bool is_analogue(const measured::Channel& channel);
/// Root mean square about the mean.
double deviation(const std::vector<double>& values);

}  // namespace flexarm::trials
