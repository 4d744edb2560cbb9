// What one reads off runs of an arm, by every method, and what is refused.
#include "measured/run_identification.hpp"

#include "arm/input_error.hpp"
#include "response/frequency/modal_response.hpp"
#include "tests/fit_cases/fit_cases.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <thread>

namespace flexarm::measured {
namespace {

using testing::HasSubstr;

FitCase short_case() {
  FitCase fit_case;
  fit_case.duration_s = 20.0;
  fit_case.sensors = sensors_named({"hub_velocity", "tip_acceleration"});
  fit_case.relative_noise = 0.01;
  return fit_case;
}

MeasuredRun time_run(const std::string& id, const FitCase& fit_case) {
  return {{.id = id, .file = id + ".csv"}, record_of(fit_case)};
}

/// The arm's own response between `from_Hz` and `to_Hz`.
MeasuredRun frequency_run(const std::string& id, const FitCase& fit_case, double from_Hz,
                          double to_Hz, double step_Hz) {
  const auto model = model_of(fit_case);
  FrequencyRecord record;
  for (const auto& sensor : fit_case.sensors) record.channels.push_back({sensor, {}, {}, {}});
  for (double f_Hz = from_Hz; f_Hz <= to_Hz; f_Hz += step_Hz) {
    const auto values =
        response::modal_response(model, fit_case.sensors, {0.0, 2.0 * std::numbers::pi * f_Hz});
    for (std::size_t j = 0; j < values.size(); ++j) {
      record.channels[j].frequency_Hz.push_back(f_Hz);
      record.channels[j].response.push_back(values[j]);
      record.channels[j].coherence.push_back(std::nan(""));
    }
  }
  return {{.id = id, .kind = RunKind::frf, .file = id + ".csv"}, record};
}

/// Readings by one method.
std::vector<ModalReading> readings_by(Method method, const Identification& identification) {
  std::vector<ModalReading> found;
  for (const auto& reading : identification.readings) {
    if (reading.method == method) found.push_back(reading);
  }
  return found;
}

double first_pole_Hz(const ModalReading& reading) {
  for (const auto& entry : reading.table) {
    if (entry.feature == Feature::pole) return *entry.frequency_Hz;
  }
  return 0.0;
}

TEST(Identify, ReadsATimeRunByEveryMethod) {
  FitCase fit_case = short_case();
  fit_case.duration_s = 60.0;
  const Identification found = identify({time_run("random", fit_case)});
  const double pole_Hz =
      std::abs(exact_roots(model_of(fit_case), 0).poles.front()) / (2.0 * std::numbers::pi);
  for (const Method method : {Method::autopower, Method::response}) {
    const auto readings = readings_by(method, found);
    ASSERT_EQ(readings.size(), 2U) << to_string(method);
    // Of a resonance that is hardly wider than a line.
    for (const auto& reading : readings) {
      EXPECT_NEAR(first_pole_Hz(reading), pole_Hz, found.runs[0].estimate->spacing_Hz);
    }
  }
  const auto fits = readings_by(Method::rational_fit, found);
  ASSERT_GE(fits.size(), 2U);
  EXPECT_FALSE(fits[0].sensor);
  EXPECT_NEAR(first_pole_Hz(fits[0]), pole_Hz, 1e-3 * pole_Hz);
  ASSERT_EQ(found.fits.size(), 1U);
  EXPECT_TRUE(found.fits[0].gains);
  EXPECT_EQ(found.runs[0].response.channels.size(), 2U);
}

TEST(Identify, FitsRunsOfOneConditionTogether) {
  const FitCase fit_case = short_case();
  FitCase again = fit_case;
  again.seed = 2;
  MeasuredRun loaded = time_run("loaded", fit_case);
  loaded.run.payload = arm::Payload{0.1, 0.0};
  const Identification found = identify({time_run("a", fit_case), loaded, time_run("b", again)});
  ASSERT_EQ(found.fits.size(), 2U);
  EXPECT_EQ(found.fits[0].runs, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(found.fits[1].runs, (std::vector<std::size_t>{1}));
  EXPECT_EQ(found.fits[1].payload, loaded.run.payload);
  EXPECT_EQ(readings_by(Method::rational_fit, found)[0].runs, (std::vector<std::string>{"a", "b"}));
}

TEST(Identify, ReadsFrequencyResponses) {
  const FitCase fit_case = short_case();
  const Identification found = identify({frequency_run("sine", fit_case, 11.0, 13.0, 0.02)});
  const auto pole = exact_roots(model_of(fit_case), 0).poles.front();
  for (const Method method : {Method::response, Method::nyquist_circle, Method::rational_fit}) {
    const auto readings = readings_by(method, found);
    ASSERT_FALSE(readings.empty()) << to_string(method);
    // Of circles, measured/modal/nyquist_circle.hpp: what the slope of other modes makes.
    EXPECT_NEAR(first_pole_Hz(readings[0]) / (std::abs(pole) / (2.0 * std::numbers::pi)), 1.0, 5e-4)
        << to_string(method);
  }
  EXPECT_TRUE(readings_by(Method::autopower, found).empty());
}

TEST(Identify, SeesNoValleyAtTheEdgeOfABand) {
  const FitCase fit_case = short_case();
  auto run = frequency_run("sine", fit_case, 11.0, 13.0, 0.02);
  const auto second = frequency_run("sine", fit_case, 31.0, 33.5, 0.02);
  auto& channels = std::get<FrequencyRecord>(run.data).channels;
  for (std::size_t j = 0; j < channels.size(); ++j) {
    const auto& more = std::get<FrequencyRecord>(second.data).channels[j];
    std::ranges::copy(more.frequency_Hz, std::back_inserter(channels[j].frequency_Hz));
    std::ranges::copy(more.response, std::back_inserter(channels[j].response));
    std::ranges::copy(more.coherence, std::back_inserter(channels[j].coherence));
  }
  const Identification found = identify({run}, {.fit = false});
  for (const auto& reading : readings_by(Method::response, found)) {
    EXPECT_EQ(std::ranges::count(reading.table, Feature::zero, &ModalEntry::feature), 0);
    EXPECT_EQ(std::ranges::count(reading.table, Feature::pole, &ModalEntry::feature), 2);
  }
}

TEST(Identify, PassesModalTablesOnSensorBySensor) {
  ModalTable table(3);
  table[0] = {arm::parse_sensor("hub_angle"), Feature::pole, 1, 12.0, {}, {}, {}};
  table[1] = {arm::parse_sensor("tip_acceleration"), Feature::pole, 1, 12.05, {}, {}, {}};
  table[2] = {arm::parse_sensor("hub_angle"), Feature::zero, 1, 2.9, {}, {}, {}};
  const Identification found =
      identify({{{.id = "table-4", .kind = RunKind::modal, .file = "t.csv"}, table}});
  ASSERT_EQ(found.readings.size(), 2U);
  EXPECT_EQ(found.readings[0].table, (ModalTable{table[0], table[2]}));
  EXPECT_EQ(found.readings[1].table, ModalTable{table[1]});
  EXPECT_TRUE(found.fits.empty());
}

TEST(Identify, LeavesDeadChannelsOutAndSaysSo) {
  MeasuredRun run = time_run("random", short_case());
  std::get<TimeRecord>(run.data).channels[0].values.assign(4000, 0.25);
  const Identification found = identify({run});
  EXPECT_EQ(found.runs[0].left_out, (std::vector<arm::Sensor>{arm::parse_sensor("hub_velocity")}));
  EXPECT_EQ(found.runs[0].response.channels.size(), 1U);
  ASSERT_EQ(found.fits.size(), 1U);
  EXPECT_EQ(found.fits[0].fit.sensors.size(), 1U);
  EXPECT_THAT(found.fits[0].gains_refusal, HasSubstr("hub_angle"));
}

TEST(Identify, RefusesARunWithoutTorqueAndGoesOn) {
  MeasuredRun silent = time_run("silent", short_case());
  auto& torque = std::get<TimeRecord>(silent.data).torque_N_m;
  torque.assign(torque.size(), 0.0);
  const Identification found = identify({silent, time_run("random", short_case())});
  EXPECT_THAT(found.runs[0].refusal, HasSubstr("torque"));
  EXPECT_TRUE(found.runs[1].refusal.empty());
  ASSERT_EQ(found.fits.size(), 1U);
  EXPECT_EQ(found.fits[0].runs, (std::vector<std::size_t>{1}));
  try {
    identify({silent});
    ADD_FAILURE() << "nothing can be identified";
  } catch (const arm::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("run silent: "));
  }
}

TEST(Identify, StopsWhereItIsToldTo) {
  int calls = 0;
  double last = 0.0;
  const auto stop_at = [&](double most) {
    calls = 0;
    return [&calls, &last, most](std::string_view, double fraction) {
      ++calls;
      EXPECT_GE(fraction, last);
      last = fraction;
      return fraction < most;
    };
  };
  IdentificationOptions options;
  options.progress = stop_at(0.5);
  const Identification part = identify({time_run("random", short_case())}, options);
  EXPECT_EQ(part.runs.size(), 1U);
  EXPECT_TRUE(part.fits.empty());
  last = 0.0;
  options.progress = stop_at(2.0);
  EXPECT_EQ(identify({time_run("random", short_case())}, options).fits.size(), 1U);
  EXPECT_GT(calls, 3);
  EXPECT_LE(last, 1.0);
}

TEST(Identify, RefusesWhatTheDeadlineLeavesNoTimeFor) {
  IdentificationOptions options;
  options.deadline = std::chrono::steady_clock::now();
  try {
    identify({time_run("random", short_case())}, options);
    ADD_FAILURE() << "there is no time for a spectrum";
  } catch (const arm::InputError& error) {
    EXPECT_STREQ(error.what(), "run random: the time limit left no time for it");
  }
  // The fit begins, and finds that the time is over.
  constexpr std::chrono::seconds kTime{6};
  options.deadline = std::chrono::steady_clock::now() + kTime;
  options.progress = [&](std::string_view what, double) {
    if (what.starts_with("fit of")) std::this_thread::sleep_until(*options.deadline);
    return true;
  };
  const Identification found = identify({time_run("random", short_case())}, options);
  EXPECT_FALSE(readings_by(Method::response, found).empty());
  EXPECT_TRUE(readings_by(Method::rational_fit, found).empty());
  ASSERT_EQ(found.fits.size(), 1U);
  EXPECT_EQ(found.fits[0].refusal, "the time limit left no time for it");
}

}  // namespace
}  // namespace flexarm::measured
