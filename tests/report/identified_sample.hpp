#pragma once

#include "compare/identification.hpp"
#include "measured/run_identification.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace flexarm::report {

/// A number with its standard error.
struct Stated {
  double value = 0.0;
  double std = 0.0;
};

/// What was read off one run, "log", of one payload; filled reading by reading.
struct IdentifiedSample {
  measured::Identification identification;
  std::vector<compare::IdentifiedCondition> conditions{1};

  IdentifiedSample() {
    identification.runs.push_back(
        {.run = {.id = "log", .kind = measured::RunKind::time, .file = "log.csv"}});
    conditions[0].runs = {0};
  }

  /// A reading with one pole. A fit is of all sensors, others of the hub angle.
  void add_pole(measured::Method method, std::optional<int> order, Stated frequency_Hz,
                std::optional<Stated> damping_ratio = {}) {
    measured::ModalReading reading{method, {"log"}, {}, {}, {}};
    if (method != measured::Method::rational_fit) {
      reading.sensor = arm::Sensor{arm::SensorKind::hub_angle, 0.0};
    }
    measured::ModalEntry entry{.sensor = reading.sensor,
                               .feature = measured::Feature::pole,
                               .order = {},
                               .frequency_Hz = frequency_Hz.value,
                               .frequency_std_Hz = frequency_Hz.std,
                               .damping_ratio = {},
                               .damping_ratio_std = {}};
    if (damping_ratio) {
      entry.damping_ratio = damping_ratio->value;
      entry.damping_ratio_std = damping_ratio->std;
    }
    reading.table = {entry};
    conditions[0].readings.push_back(identification.readings.size());
    conditions[0].roots.push_back({{entry, order, {}, {}}});
    identification.readings.push_back(std::move(reading));
  }

  /// The fit that the readings by it are of, with residuals of one sensor.
  measured::RunsFit& add_fit(bool converged, double whiteness_probability) {
    measured::RunsFit fit;
    fit.runs = {0};
    fit.fit.converged = converged;
    fit.fit.iterations = 60;
    measured::FittedSensor sensor;
    sensor.sensor = {arm::SensorKind::hub_angle, 0.0};
    sensor.residual.whiteness_probability = whiteness_probability;
    fit.fit.sensors = {sensor};
    conditions[0].fits.push_back(identification.fits.size());
    identification.fits.push_back(std::move(fit));
    return identification.fits.back();
  }
};

}  // namespace flexarm::report
