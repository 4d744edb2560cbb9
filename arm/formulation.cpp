#include "arm/formulation.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

namespace flexarm::arm {

namespace {

void require_scale(const char* what, double value, const char* unit) {
  if (!(value >= kSmallestScale && value <= kLargestScale)) {
    throw out_of_range(what, value, unit,
                       fmt::format("from {} to {}", kSmallestScale, kLargestScale));
  }
}

void require_ratio(const char* what, double value, double largest) {
  if (!(value <= largest)) {
    throw out_of_range(what, value, "", fmt::format("{} or less", largest));
  }
}

}  // namespace

void require_computable(const Arm& arm) {
  require_valid(arm);
  const double l = arm.beam.length_m;
  const double mass_kg = arm.beam.linear_density_kg_per_m() * l;
  require_scale("beam: m l", mass_kg, "kg");
  require_scale("beam: m l^3", mass_kg * l * l, "kg m^2");
  require_scale("beam: EI/l", arm.beam.flexural_rigidity_N_m2() / l, "N m");
  require_scale("beam: sqrt(EI/(m l^4))", omega_scale_rad_per_s(arm), "rad/s");
  require_ratio("hub.inertia/(m l^3)", hub_inertia_ratio(arm), kLargestScale);
  require_ratio("payload.mass/(m l)", payload_mass_ratio(arm), kLargestPayloadRatio);
  require_ratio("payload.inertia/(m l^3)", payload_inertia_ratio(arm), kLargestPayloadRatio);
}

void require_count(int count) {
  if (count < 1) throw out_of_range("count", count, "", "1 or more");
}

void require_stations(std::span<const double> stations_m, const Arm& arm) {
  for (const double station_m : stations_m) {
    if (!(station_m >= 0.0 && station_m <= arm.beam.length_m)) {
      throw out_of_range("station", station_m, "m",
                         fmt::format("from 0 to the beam's length, {} m", arm.beam.length_m));
    }
  }
}

}  // namespace flexarm::arm
