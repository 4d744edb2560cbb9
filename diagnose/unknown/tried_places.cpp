#include "diagnose/unknown/tried_places.hpp"

#include "diagnose/predictors/predictor.hpp"
#include "measured/spectra/frequency_response.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <optional>
#include <utility>
#include <variant>

namespace flexarm::diagnose {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;

/// The segments of one arm and grid of frequencies, which share its responses.
struct SharedLines {
  std::optional<arm::Payload> payload;
  std::vector<arm::Sensor> sensors;
  std::vector<double> frequency_Hz;  ///< all lines of the segments, ascending
  std::vector<const ResidualSpectra*> segments;
};

std::vector<SharedLines> shared_lines(const Problem& problem,
                                      const std::vector<ResidualSpectra>& segments) {
  std::vector<SharedLines> all;
  for (const ResidualSpectra& segment : segments) {
    const auto& payload = problem.experiment().runs[segment.run].run.payload;
    auto at = std::ranges::find_if(all, [&](const SharedLines& one) {
      return one.payload == payload && one.sensors == segment.sensors;
    });
    if (at == all.end()) at = all.insert(at, {payload, segment.sensors, {}, {}});
    at->segments.push_back(&segment);
    std::ranges::copy(segment.frequency_Hz, std::back_inserter(at->frequency_Hz));
  }
  for (SharedLines& one : all) {
    std::ranges::sort(one.frequency_Hz);
    const auto repeated = std::ranges::unique(one.frequency_Hz);
    one.frequency_Hz.erase(repeated.begin(), repeated.end());
  }
  return all;
}

/// Columns of the shared lines that are those of a segment.
std::vector<Index> columns_of(const SharedLines& shared, const ResidualSpectra& segment) {
  std::vector<Index> columns;
  for (const double frequency_Hz : segment.frequency_Hz) {
    columns.push_back(std::ranges::lower_bound(shared.frequency_Hz, frequency_Hz) -
                      shared.frequency_Hz.begin());
  }
  return columns;
}

/// A force at one place on the lines of a segment.
struct FittedForce {
  Eigen::ArrayXd explained;  ///< beyond what it explains of noise, weighted
  Eigen::ArrayXd power;      ///< |F|^2 less what noise makes of it
};

/// The residuals of a segment with their weights.
class WeightedResiduals {
 public:
  WeightedResiduals(const ResidualSpectra& spectra, Eigen::MatrixXcd errors)
      : errors_(std::move(errors)),
        noise_(spectra.noise),
        weights_(
            (spectra.noise + kRelativeError * kRelativeError * spectra.excess).cwiseInverse()) {}

  /// E^H W E - sum W N of each line.
  Eigen::ArrayXd total() const {
    return ((errors_.cwiseAbs2() - noise_).cwiseProduct(weights_)).colwise().sum().transpose();
  }

  FittedForce fitted(const Eigen::MatrixXcd& response) const {
    const Index lines = errors_.cols();
    FittedForce made{Eigen::ArrayXd::Zero(lines), Eigen::ArrayXd::Zero(lines)};
    for (Index k = 0; k < lines; ++k) {
      const Eigen::VectorXd squared = response.col(k).cwiseAbs2();
      const double norm = squared.dot(weights_.col(k));
      // A sensor that errs may be none of this run's; the place may lie on a node of the torque.
      if (!(norm > 0.0) || !std::isfinite(norm)) continue;
      const Eigen::VectorXcd weighted =
          weights_.col(k).cast<Complex>().cwiseProduct(errors_.col(k));
      const double found = std::norm(response.col(k).dot(weighted));
      const double by_noise = squared.cwiseProduct(weights_.col(k).cwiseAbs2()).dot(noise_.col(k));
      made.explained(k) = (found - by_noise) / norm;
      made.power(k) = (found - by_noise) / (norm * norm);
    }
    return made;
  }

 private:
  Eigen::MatrixXcd errors_;
  Eigen::MatrixXd noise_;
  Eigen::MatrixXd weights_;
};

/// Lines in which the error of the simulated torque is no part of what is left.
Eigen::MatrixXcd without_torque_error(const Problem& problem, const ResidualSpectra& segment,
                                      const Eigen::MatrixXcd& of_command) {
  if (segment.torque_errors.size() == 0) return segment.errors;
  const auto& [run, data] = problem.experiment().runs[segment.run];
  const double period_s = measured::sampling_period_s(std::get<measured::TimeRecord>(data));
  Eigen::MatrixXcd made = segment.errors;
  for (Index k = 0; k < made.cols(); ++k) {
    const Complex hold = measured::hold_response(
        run.torque_hold, segment.frequency_Hz[static_cast<std::size_t>(k)], period_s);
    made.col(k) -= of_command.col(k) * (hold * segment.torque_errors(k));
  }
  return made;
}

void add_parts(const ResidualSpectra& segment, const Eigen::ArrayXd& total,
               const std::vector<FittedForce>& forces, TriedPlaces& tried) {
  const auto sensors = static_cast<double>(segment.sensors.size());
  const double adjusted = sensors / (sensors - 1.0);
  const auto bands = static_cast<Index>(std::min<std::size_t>(kBands, segment.frequency_Hz.size()));
  for (Index band = 0; band < bands; ++band) {
    const Index from = band * total.size() / bands;
    const Index count = (band + 1) * total.size() / bands - from;
    TriedPart part{segment.run, total.segment(from, count).sum(), {}};
    for (const FittedForce& force : forces) {
      part.left.push_back(adjusted * (part.total - force.explained.segment(from, count).sum()));
    }
    tried.parts.push_back(std::move(part));
  }
}

std::vector<arm::Sensor> all_sensors(const std::vector<ResidualSpectra>& segments) {
  std::vector<arm::Sensor> sensors;
  for (const ResidualSpectra& segment : segments) {
    for (const arm::Sensor& sensor : segment.sensors) {
      if (std::ranges::find(sensors, sensor) == sensors.end()) sensors.push_back(sensor);
    }
  }
  return sensors;
}

}  // namespace

TriedPlaces try_places(const Problem& problem, const arm::Arm& arm,
                       const std::vector<ResidualSpectra>& segments,
                       const arm::Deadline& deadline) {
  TriedPlaces tried{force_places(arm, all_sensors(segments)), {}, {}};
  for (const SharedLines& shared : shared_lines(problem, segments)) {
    arm::require_time(deadline);
    arm::Arm of_run = arm;
    of_run.payload = shared.payload.value_or(arm.payload);
    const PortResponses port(of_run, shared.sensors, shared.frequency_Hz);
    const std::vector<Eigen::MatrixXcd> responses = port(tried.places);
    const Eigen::MatrixXcd of_command = port.of_command();
    for (const ResidualSpectra* segment : shared.segments) {
      arm::require_time(deadline);
      const auto columns = columns_of(shared, *segment);
      const WeightedResiduals residuals(
          *segment,
          without_torque_error(problem, *segment, of_command(Eigen::all, columns).eval()));
      std::vector<FittedForce> forces;
      TriedSegment made{segment->frequency_Hz, {}};
      for (const Eigen::MatrixXcd& response : responses) {
        forces.push_back(residuals.fitted(response(Eigen::all, columns)));
        made.power.push_back(forces.back().power);
      }
      add_parts(*segment, residuals.total(), forces, tried);
      if (!segment->is_per_torque) tried.segments.push_back(std::move(made));
    }
  }
  return tried;
}

}  // namespace flexarm::diagnose
