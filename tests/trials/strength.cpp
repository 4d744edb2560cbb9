#include "tests/trials/strength.hpp"

#include "tests/trials/excitations.hpp"
#include "tests/trials/frequency_simulation.hpp"
#include "tests/trials/time_simulation.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>

namespace flexarm::trials {

namespace {

constexpr double kModalPart = 0.1;
constexpr double kDampingPart = 0.02;
constexpr double kErrorTolerance = 0.05;
constexpr int kMostBisections = 14;
/// A step of 0.1 ms and few modes are enough to compare a simulation with another of the same.
const TimeOptions kCoarseTime{
    .sample_time_s = kSampleTime_s, .substeps = 20, .plant = {.flexible_modes = 6}};
constexpr int kCoarseLines = 60;

/// Readings in time, responses by frequency, or logarithms of poles and zeros; a vector a channel.
using Signals = std::vector<std::vector<std::complex<double>>>;

/// The error of a simulation of `simulated`, by the world that the data are of.
class SimulationError {
 public:
  SimulationError(const World& simulated, const TrialArm& of, measured::RunKind kind,
                  const std::vector<PlannedRun>& runs, std::span<const arm::Sensor> sensors)
      : of_(of), kind_(kind), runs_(runs), sensors_(sensors) {
    if (kind == measured::RunKind::time) {
      std::erase_if(runs_, [](const PlannedRun& run) {
        return run.id != "random-high" && run.id != "bang-bang" && run.id != "payload-random";
      });
    }
    for (const PlannedRun& run : runs_) simulated_.push_back(signals(simulated, run));
  }

  /// Mean of the channels of all runs; infinite for an arm that is held, or falls out of all
  /// bounds.
  double operator()(const World& world) const {
    double sum = 0.0;
    int count = 0;
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      const Signals hidden = signals(world, runs_[r]);
      for (std::size_t c = 0; c < hidden.size(); ++c, ++count) {
        sum += relative_error_of(hidden[c], simulated_[r][c]);
      }
    }
    return std::isfinite(sum) ? sum / count : std::numeric_limits<double>::infinity();
  }

 private:
  /// Responses range over decades, so that each line counts relative to itself; differences of
  /// logarithms are relative as they are.
  double relative_error_of(const std::vector<std::complex<double>>& hidden,
                           const std::vector<std::complex<double>>& simulated) const {
    double squares = 0.0;
    double scale = 0.0;
    for (std::size_t i = 0; i < hidden.size(); ++i) {
      double square = std::norm(hidden[i] - simulated[i]);
      if (kind_ == measured::RunKind::frf) square /= std::abs(hidden[i]) * std::abs(simulated[i]);
      squares += square;
      scale += kind_ == measured::RunKind::time ? std::norm(hidden[i]) : 1.0;
    }
    return std::sqrt(squares / scale);
  }

  Signals signals(World world, const PlannedRun& run) const {
    world.arm.payload.mass_kg = run.payload_kg;
    if (kind_ == measured::RunKind::modal) return {modal_logarithms(world)};
    if (kind_ == measured::RunKind::frf) {
      return frequency_responses(world, sensors_, planned_frequencies_Hz(of_, kCoarseLines));
    }
    Signals readings;
    for (const auto& channel : simulate_in_time(world, sensors_, run.torque_N_m, kCoarseTime)) {
      readings.emplace_back(channel.begin(), channel.end());
    }
    return readings;
  }

  static std::vector<std::complex<double>> modal_logarithms(const World& world) {
    constexpr double kNoDamping = 1e-6;
    std::vector<std::complex<double>> values;
    for (const auto& entry : poles_and_zeros(world, kModalOrders)) {
      values.emplace_back(std::log(*entry.frequency_Hz));
      const double damping = std::max(entry.damping_ratio.value_or(kNoDamping), kNoDamping);
      values.emplace_back(kDampingPart * std::log(damping));
    }
    return values;
  }

  const TrialArm& of_;
  measured::RunKind kind_;
  std::vector<PlannedRun> runs_;
  std::span<const arm::Sensor> sensors_;
  std::vector<Signals> simulated_;
};

}  // namespace

std::string_view to_string(Strength strength) {
  constexpr std::array<std::string_view, 4> kNames = {"faint", "weak", "middle", "strong"};
  return kNames.at(static_cast<std::size_t>(strength));
}

double error_of(Strength strength, measured::RunKind kind) {
  constexpr std::array kErrors = {0.015, 0.05, 0.15, 0.5};
  const double error = kErrors.at(static_cast<std::size_t>(strength));
  return kind == measured::RunKind::modal ? kModalPart * error : error;
}

double error_at(const TrialArm& of, measured::RunKind kind, const std::vector<PlannedRun>& runs,
                const Cause& cause, const Chance& chance, double size,
                std::span<const arm::Sensor> sensors) {
  const SimulationError error_made(World{of.arm}, of, kind, runs, sensors);
  return error_made(with_hidden(World{of.arm}, of, cause, size, chance));
}

FoundSize find_size(const TrialArm& of, measured::RunKind kind, const std::vector<PlannedRun>& runs,
                    const Cause& cause, const Chance& chance, double error,
                    std::span<const arm::Sensor> sensors) {
  const SimulationError error_made(World{of.arm}, of, kind, runs, sensors);
  const auto made_by = [&](double size) {
    return error_made(with_hidden(World{of.arm}, of, cause, size, chance));
  };
  FoundSize found{cause.largest, made_by(cause.largest)};
  if (found.error <= error) return found;
  double low = std::log(cause.smallest_part * cause.largest);
  double high = std::log(cause.largest);
  for (int i = 0; i < kMostBisections; ++i) {
    const double middle = 0.5 * (low + high);
    found = {std::exp(middle), made_by(std::exp(middle))};
    if (std::abs(found.error - error) <= kErrorTolerance * error) break;
    (found.error < error ? low : high) = middle;
  }
  if (!std::isfinite(found.error)) throw std::runtime_error(cause.name + ": no size was found");
  return found;
}

std::vector<double> errors_without_each(const TrialArm& of, const std::vector<PlannedRun>& runs,
                                        const World& world, std::span<const arm::Sensor> sensors) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < world.hidden.size(); ++i) {
    World others = world;
    others.hidden.erase(others.hidden.begin() + static_cast<std::ptrdiff_t>(i));
    errors.push_back(SimulationError(others, of, measured::RunKind::time, runs, sensors)(world));
  }
  return errors;
}

}  // namespace flexarm::trials
