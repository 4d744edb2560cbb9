#include "diagnose/unknown/missing_force.hpp"

#include "arm/rigid_hub.hpp"
#include "diagnose/predictors/predictor.hpp"
#include "diagnose/unknown/residual_spectra.hpp"
#include "measured/spectra/frequency_response.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <iterator>
#include <numeric>
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

/// A band of a segment: what is left of how much.
struct Part {
  std::size_t run = 0;
  std::size_t segment = 0;
  double total = 0.0;
  std::vector<double> left;  ///< a place each, adjusted
};

/// What is known of a segment when all places were tried.
struct TriedSegment {
  std::vector<double> frequency_Hz;
  std::vector<Eigen::ArrayXd> power;  ///< of the force, a place each
};

struct Tried {
  std::vector<ForcePlace> places;
  std::vector<Part> parts;
  std::vector<TriedSegment> segments;
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
               const std::vector<FittedForce>& forces, Tried& tried) {
  const auto sensors = static_cast<double>(segment.sensors.size());
  const double adjusted = sensors / (sensors - 1.0);
  const auto bands = static_cast<Index>(std::min<std::size_t>(kBands, segment.frequency_Hz.size()));
  for (Index band = 0; band < bands; ++band) {
    const Index from = band * total.size() / bands;
    const Index count = (band + 1) * total.size() / bands - from;
    Part part{segment.run, tried.segments.size(), total.segment(from, count).sum(), {}};
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

Tried try_places(const Problem& problem, const arm::Arm& arm,
                 const std::vector<ResidualSpectra>& segments) {
  Tried tried{force_places(arm, all_sensors(segments)), {}, {}};
  for (const SharedLines& shared : shared_lines(problem, segments)) {
    arm::Arm of_run = arm;
    of_run.payload = shared.payload.value_or(arm.payload);
    const PortResponses port(of_run, shared.sensors, shared.frequency_Hz);
    const std::vector<Eigen::MatrixXcd> responses = port(tried.places);
    const Eigen::MatrixXcd of_command = port.of_command();
    for (const ResidualSpectra* segment : shared.segments) {
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
      tried.segments.push_back(std::move(made));
    }
  }
  return tried;
}

/// Places of one port, as indices of Tried::places.
using PlacesOfPort = std::vector<std::size_t>;

std::vector<PlacesOfPort> ports_of(const std::vector<ForcePlace>& places) {
  std::vector<PlacesOfPort> ports;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto own = std::ranges::find_if(ports, [&](const PlacesOfPort& port) {
      const ForcePlace& first = places[port.front()];
      return first.port == places[i].port && first.sensors == places[i].sensors;
    });
    if (own == ports.end()) {
      ports.push_back({i});
    } else {
      own->push_back(i);
    }
  }
  return ports;
}

/// Which of the places leaves least of the parts that `counts` chooses.
template <class Counts>
std::size_t best_place(const Tried& tried, const PlacesOfPort& places, const Counts& counts) {
  const auto left = [&](std::size_t place) {
    double sum = 0.0;
    for (const Part& part : tried.parts) {
      if (counts(part)) sum += part.left[place];
    }
    return sum;
  };
  return std::ranges::min(places, {}, left);
}

/// What a port leaves of each part, at the place that is best in the others.
std::vector<double> left_by(const Tried& tried, const PlacesOfPort& places) {
  const bool has_runs = std::ranges::any_of(
      tried.parts, [&](const Part& part) { return part.run != tried.parts.front().run; });
  std::vector<double> left;
  for (const Part& own : tried.parts) {
    const std::size_t place = best_place(tried, places, [&](const Part& other) {
      return has_runs ? other.run != own.run : &other != &own;
    });
    left.push_back(own.left[place]);
  }
  return left;
}

/// sum values/sum totals with its standard error by the jackknife.
struct JackknifedRatio {
  double value = 0.0;
  double std_error = 0.0;
};

JackknifedRatio jackknifed_ratio(const std::vector<double>& values,
                                 const std::vector<Part>& parts) {
  double sum = 0.0;
  double total = 0.0;
  for (std::size_t g = 0; g < parts.size(); ++g) {
    sum += values[g];
    total += parts[g].total;
  }
  std::vector<double> without;
  for (std::size_t g = 0; g < parts.size(); ++g) {
    without.push_back((sum - values[g]) / (total - parts[g].total));
  }
  const auto n = static_cast<double>(parts.size());
  const double mean = std::reduce(without.begin(), without.end()) / n;
  double squares = 0.0;
  for (const double one : without) squares += (one - mean) * (one - mean);
  return {sum / total, std::sqrt((n - 1.0) / n * squares)};
}

std::vector<double> difference(const std::vector<double>& one, const std::vector<double>& other) {
  std::vector<double> made;
  std::ranges::transform(one, other, std::back_inserter(made), std::minus());
  return made;
}

/// A port with the place that is best in all parts.
struct TriedPort {
  PortShare share;
  std::size_t place = 0;
  std::vector<double> left;
};

TriedPort tried_port(const Tried& tried, const PlacesOfPort& places) {
  TriedPort made;
  made.place = best_place(tried, places, [](const Part&) { return true; });
  made.left = left_by(tried, places);
  const ForcePlace& place = tried.places[made.place];
  made.share.port = place.port;
  for (const arm::Sensor& sensor : place.sensors) {
    made.share.sensors.push_back(to_string(sensor));
  }
  made.share.place = place.what;
  const JackknifedRatio left = jackknifed_ratio(made.left, tried.parts);
  made.share.share = 1.0 - left.value;
  made.share.std_error = left.std_error;
  return made;
}

/// How many of `ports`, the best first, are indistinguishable from the best.
std::size_t indistinguishable(const std::vector<PortShare>& ports) {
  const PortShare& best = ports.front();
  const auto other = std::ranges::find_if(ports, [&](const PortShare& port) {
    return best.share - port.share > kDistance * port.distance_std_error &&
           1.0 - port.share > kMoreLeft * (1.0 - best.share);
  });
  return static_cast<std::size_t>(other - ports.begin());
}

/// The frequency below which that part of the squares lies.
double quantile_Hz(const std::vector<std::pair<double, double>>& power, double part) {
  double all = 0.0;
  for (const auto& [frequency_Hz, square] : power) all += square;
  double sum = 0.0;
  for (const auto& [frequency_Hz, square] : power) {
    sum += square;
    if (sum >= part * all) return frequency_Hz;
  }
  return power.back().first;
}

ForceSize size_of(const Tried& tried, std::size_t place) {
  ForceSize size{.unit = tried.places[place].unit};
  std::vector<double> squares;
  std::vector<std::pair<double, double>> power;
  for (const TriedSegment& segment : tried.segments) {
    squares.push_back(std::max(0.0, segment.power[place].sum()));
    for (std::size_t k = 0; k < segment.frequency_Hz.size(); ++k) {
      power.emplace_back(segment.frequency_Hz[k], segment.power[place](static_cast<Index>(k)));
    }
  }
  std::ranges::sort(power);
  size.from_Hz = quantile_Hz(power, 0.1);
  size.to_Hz = quantile_Hz(power, 0.9);
  const auto n = static_cast<double>(squares.size());
  const double mean = std::reduce(squares.begin(), squares.end()) / n;
  size.rms = std::sqrt(mean);
  if (squares.size() < 2 || mean == 0.0) return size;
  double spread = 0.0;
  for (const double square : squares) spread += (square - mean) * (square - mean);
  size.std_error = 0.5 * std::sqrt(spread / (n * (n - 1.0))) / size.rms;
  return size;
}

}  // namespace

std::optional<MissingForce> missing_force(const Problem& problem, const arm::Arm& arm,
                                          const Eigen::VectorXd& errors) {
  if (!arm::has_beam(arm) || is_driven_by_motion(problem.experiment())) return std::nullopt;
  auto segments = residual_spectra(problem, errors);
  MissingForce made;
  for (const ResidualSpectra& segment : segments) made.lines += segment.frequency_Hz.size();
  if (made.lines < kFewestLines) return std::nullopt;
  std::erase_if(segments, [](const auto& segment) { return segment.sensors.size() < 2; });
  std::size_t usable = 0;
  for (const ResidualSpectra& segment : segments) usable += segment.frequency_Hz.size();
  if (usable < kFewestLines) return made;
  const Tried tried = try_places(problem, arm, segments);
  std::vector<TriedPort> ports;
  for (const PlacesOfPort& places : ports_of(tried.places)) {
    ports.push_back(tried_port(tried, places));
  }
  std::ranges::stable_sort(ports, std::greater(),
                           [](const TriedPort& port) { return port.share.share; });
  for (TriedPort& port : ports) {
    port.share.distance_std_error =
        jackknifed_ratio(difference(port.left, ports.front().left), tried.parts).std_error;
    made.ports.push_back(port.share);
  }
  const std::size_t alike = indistinguishable(made.ports);
  if (made.ports.front().share < kLeastPortShare || alike > kMostPorts) return made;
  made.stated = alike;
  if (tried.places[ports.front().place].spread.empty())
    made.size = size_of(tried, ports.front().place);
  return made;
}

}  // namespace flexarm::diagnose
