#pragma once

#include "tests/trials/experiment_plan.hpp"
#include "tests/trials/world.hpp"

#include <array>
#include <span>
#include <string_view>
#include <vector>

namespace flexarm::trials {

/// How strong a hidden cause is: by the error of a simulation that does not know it, so that
/// strengths compare between causes.
enum class Strength { faint, weak, middle, strong };
inline constexpr std::array kStrengths = {Strength::faint, Strength::weak, Strength::middle,
                                          Strength::strong};

/// "faint", "weak", "middle", "strong".
std::string_view to_string(Strength strength);

/// Root mean square of the error over that of the signal in data without noise: 1.5, 5, 15, 50 %;
/// of poles and zeros a tenth of it, where a damping ratio's error counts a fiftieth of a
/// frequency's.
double error_of(Strength strength, measured::RunKind kind);

struct FoundSize {
  double size = 0.0;
  double error = 0.0;  ///< that this size makes; less than asked for where nothing makes as much
};

/// The error that `cause` of this size makes in the readings of `sensors`.
double error_at(const TrialArm& of, measured::RunKind kind, const std::vector<PlannedRun>& runs,
                const Cause& cause, const Chance& chance, double size,
                std::span<const arm::Sensor> sensors = planned_sensors());

/// The size at which `cause` makes this error, to 5 % of it, by bisection of its logarithm.
FoundSize find_size(const TrialArm& of, measured::RunKind kind, const std::vector<PlannedRun>& runs,
                    const Cause& cause, const Chance& chance, double error,
                    std::span<const arm::Sensor> sensors = planned_sensors());

/// The errors of simulations of time runs that know all hidden causes of `world` but one, an error
/// a cause. A simulation that knows them all has none.
std::vector<double> errors_without_each(const TrialArm& of, const std::vector<PlannedRun>& runs,
                                        const World& world, std::span<const arm::Sensor> sensors);

}  // namespace flexarm::trials
