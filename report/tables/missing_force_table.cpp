#include "report/tables/missing_force_table.hpp"

#include "arm/unit_suffix.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace flexarm::report {

namespace {

std::string share_text(double share, double std_error) {
  return fmt::format("{:.3g} % (standard error {:.2g} %)", explained_percent(share),
                     100.0 * std_error);
}

std::string size_text(const diagnose::ForceSize& size) {
  const std::string unit = arm::unit_suffix(size.unit);
  std::string text = fmt::format(" Its RMS value is {:.3g}{}", size.rms, unit);
  if (size.std_error) text += fmt::format(" (standard error {:.2g}{})", *size.std_error, unit);
  return text +
         fmt::format(", 80 % of its mean square at {:.3g} to {:.3g} Hz.", size.from_Hz, size.to_Hz);
}

std::string undetermined_text(const diagnose::MissingForce& force) {
  const std::string begin = "Port of the missing force: not determined";
  if (force.ports.empty()) {
    return begin + ". No run has an excess residual and two sensors.";
  }
  const diagnose::PortShare& best = force.ports.front();
  if (best.share < diagnose::kLeastPortShare) {
    return begin + fmt::format(". Of the excess residual the best port, {}, explains {}.",
                               port_name(best), share_text(best.share, best.std_error));
  }
  return begin + fmt::format(
                     ". The best port, {}, explains {} of the excess residual and is "
                     "indistinguishable from more than one other.",
                     port_name(best), share_text(best.share, best.std_error));
}

}  // namespace

std::string port_name(const diagnose::PortShare& port) {
  const std::string name(to_string(port.port));
  return port.sensors.empty() ? name : fmt::format("{} {}", name, fmt::join(port.sensors, ", "));
}

std::string missing_force_text(const diagnose::MissingForce& force) {
  if (force.stated == 0) return undetermined_text(force);
  const diagnose::PortShare& best = force.ports.front();
  std::string text = fmt::format(
      "Port of the missing force: {} ({}). An arbitrary force there explains {} of the "
      "excess residual of the sensors on {} spectral lines.",
      port_name(best), best.place, share_text(best.share, best.std_error), force.lines);
  if (force.size) text += size_text(*force.size);
  for (std::size_t i = 1; i < force.stated; ++i) {
    const diagnose::PortShare& other = force.ports[i];
    text += fmt::format(" Indistinguishable from it: {} ({}), {}.", port_name(other), other.place,
                        share_text(other.share, other.std_error));
  }
  if (force.stated < force.ports.size()) {
    const diagnose::PortShare& next = force.ports[force.stated];
    text += fmt::format(" Next: {}, {}.", port_name(next), share_text(next.share, next.std_error));
  }
  return text;
}

Table missing_force_table(const diagnose::MissingForce& force) {
  Table made{"Port of the missing force",
             {{.name = "port"},
              {.name = "place"},
              {.name = "explained share", .unit = "%", .significant_digits = 3},
              {.name = "standard error", .unit = "%", .significant_digits = 2},
              {.name = "standard error of distance to best", .unit = "%", .significant_digits = 2},
              {.name = "stated"}}};
  for (std::size_t i = 0; i < force.ports.size(); ++i) {
    const diagnose::PortShare& port = force.ports[i];
    made.add_row({port_name(port), port.place, explained_percent(port.share),
                  100.0 * port.std_error, 100.0 * port.distance_std_error,
                  std::string(i < force.stated ? "yes" : "no")});
  }
  return made;
}

}  // namespace flexarm::report
