#include "diagnose/unknown/missing_force.hpp"

#include "arm/rigid_hub.hpp"
#include "diagnose/unknown/jackknife.hpp"
#include "diagnose/unknown/tried_places.hpp"

#include <algorithm>
#include <functional>
#include <iterator>

namespace flexarm::diagnose {

namespace {

std::size_t lines_of(const std::vector<ResidualSpectra>& segments) {
  std::size_t lines = 0;
  for (const ResidualSpectra& segment : segments) lines += segment.frequency_Hz.size();
  return lines;
}

/// Places of one port, as indices of TriedPlaces::places.
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
std::size_t best_place(const TriedPlaces& tried, const PlacesOfPort& places, const Counts& counts) {
  const auto left = [&](std::size_t place) {
    double sum = 0.0;
    for (const TriedPart& part : tried.parts) {
      if (counts(part)) sum += part.left[place];
    }
    return sum;
  };
  return std::ranges::min(places, {}, left);
}

/// What a port leaves of each part, at the place that is best in the others.
std::vector<double> left_by(const TriedPlaces& tried, const PlacesOfPort& places) {
  const bool has_runs = std::ranges::any_of(
      tried.parts, [&](const TriedPart& part) { return part.run != tried.parts.front().run; });
  std::vector<double> left;
  for (const TriedPart& own : tried.parts) {
    const std::size_t place = best_place(tried, places, [&](const TriedPart& other) {
      return has_runs ? other.run != own.run : &other != &own;
    });
    left.push_back(own.left[place]);
  }
  return left;
}

std::vector<double> totals_of(const std::vector<TriedPart>& parts) {
  std::vector<double> totals;
  std::ranges::transform(parts, std::back_inserter(totals), &TriedPart::total);
  return totals;
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

TriedPort tried_port(const TriedPlaces& tried, const std::vector<double>& totals,
                     const PlacesOfPort& places) {
  TriedPort made;
  made.place = best_place(tried, places, [](const TriedPart&) { return true; });
  made.left = left_by(tried, places);
  const ForcePlace& place = tried.places[made.place];
  made.share.port = place.port;
  for (const arm::Sensor& sensor : place.sensors) {
    made.share.sensors.push_back(to_string(sensor));
  }
  made.share.place = place.what;
  const JackknifedRatio left = jackknifed_ratio(made.left, totals);
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

}  // namespace

std::optional<MissingForce> missing_force(const Problem& problem, const arm::Arm& arm,
                                          const Eigen::VectorXd& errors,
                                          const arm::Deadline& deadline) {
  if (!arm::has_beam(arm) || is_driven_by_motion(problem.experiment())) return std::nullopt;
  auto segments = residual_spectra(problem, errors);
  MissingForce made{.lines = lines_of(segments)};
  if (made.lines < kFewestLines) return std::nullopt;
  std::erase_if(segments, [](const auto& segment) { return segment.sensors.size() < 2; });
  if (lines_of(segments) < kFewestLines) return made;
  const TriedPlaces tried = try_places(problem, arm, segments, deadline);
  const std::vector<double> totals = totals_of(tried.parts);
  std::vector<TriedPort> ports;
  for (const PlacesOfPort& places : ports_of(tried.places)) {
    ports.push_back(tried_port(tried, totals, places));
  }
  std::ranges::stable_sort(ports, std::greater(),
                           [](const TriedPort& port) { return port.share.share; });
  for (TriedPort& port : ports) {
    port.share.distance_std_error =
        jackknifed_ratio(difference(port.left, ports.front().left), totals).std_error;
    made.ports.push_back(port.share);
  }
  const std::size_t alike = indistinguishable(made.ports);
  if (made.ports.front().share < kLeastPortShare || alike > kMostPorts) return made;
  made.stated = alike;
  const std::size_t place = ports.front().place;
  const bool has_size = tried.places[place].spread.empty() && !tried.segments.empty();
  if (has_size) made.size = force_size(tried, place);
  return made;
}

}  // namespace flexarm::diagnose
