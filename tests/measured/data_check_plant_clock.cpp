#include "tests/measured/data_check_plant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace flexarm::measured {

using response::RandomNumbers;

namespace {

void remove_rows(TimeRecord& record, std::size_t first, std::size_t count) {
  const auto cut = [&](std::vector<double>& values) {
    values.erase(values.begin() + static_cast<std::ptrdiff_t>(first),
                 values.begin() + static_cast<std::ptrdiff_t>(first + count));
  };
  cut(record.time_s);
  cut(record.torque_N_m);
  for (auto& channel : record.channels) cut(channel.values);
}

/// A run at instants off its even times; `off_periods` one a sample.
TimeRecord sampled_off_time(const DrawnRun& run, const std::vector<double>& off_periods) {
  const auto stride = static_cast<double>(run.refinement);
  const auto last = static_cast<double>(run.fine.time_s.size() - 2);
  TimeRecord record;
  for (const auto& channel : run.fine.channels) record.channels.push_back({channel.sensor, {}});
  for (std::size_t k = 0; k < off_periods.size(); ++k) {
    const auto even = k * static_cast<std::size_t>(run.refinement);
    record.time_s.push_back(run.fine.time_s[even]);
    record.torque_N_m.push_back(run.fine.torque_N_m[even]);
    const double at = std::clamp(stride * (static_cast<double>(k) + off_periods[k]), 0.0, last);
    const auto before = static_cast<std::size_t>(at);
    for (std::size_t i = 0; i < record.channels.size(); ++i) {
      const auto& values = run.fine.channels[i].values;
      record.channels[i].values.push_back(
          std::lerp(values[before], values[before + 1], at - static_cast<double>(before)));
    }
  }
  return record;
}

/// The largest error over noise of a channel, both rms, that instants off their times make.
double error_over_noise(const TimeRecord& even, const TimeRecord& off, double noise) {
  double largest = 0.0;
  for (std::size_t i = 0; i < even.channels.size(); ++i) {
    std::vector<double> error = off.channels[i].values;
    for (std::size_t k = 0; k < error.size(); ++k) error[k] -= even.channels[i].values[k];
    largest = std::max(largest, deviation(error) / (noise * deviation(even.channels[i].values)));
  }
  return largest;
}

}  // namespace

PlantedFault clock_jitter(std::uint64_t seed, RandomNumbers& random) {
  const auto run = draw_run(seed);
  auto result = planted(run, sampled(run, random));
  auto& times = result.record.time_s;
  const double period_s = times[1] - times[0];
  const double how = random.uniform();
  if (how < 0.4) {
    const double most = log_between(random, 0.08, 0.45);
    for (auto& time : times) time += most * period_s * between(random, -1.0, 1.0);
  } else if (how < 0.75) {  // times may change places
    const double rms = log_between(random, 0.3, 1.0);
    for (auto& time : times) time += rms * period_s * random.normal();
    result.description += fmt::format(", jitter of {} periods rms", rms);
  } else {
    const double share = log_between(random, 0.15, 3.0) * 8.0 / static_cast<double>(times.size());
    const std::size_t from = times.size() / 2;
    for (std::size_t k = from; k < times.size(); ++k) {
      times[k] += share * period_s * static_cast<double>(k - from);
    }
  }
  result.channel = "time";
  return result;
}

PlantedFault missing_samples(std::uint64_t seed, RandomNumbers& random) {
  const auto run = draw_run(seed);
  auto result = planted(run, sampled(run, random));
  auto& record = result.record;
  const std::size_t places = 1 + random.below(5);
  std::size_t first = record.time_s.size();
  for (std::size_t i = 0; i < places; ++i) {
    const std::size_t count = 1 + random.below(30);
    const std::size_t at = 10 + random.below(record.time_s.size() - count - 20);
    remove_rows(record, at, count);
    first = std::min(first, at);
  }
  result.channel = "time";
  result.first_sample = first;
  result.last_sample = first;
  if (chance(random, 0.5)) {
    constexpr std::size_t kUncertain = 10;  // samples by which jitter hides the place of a gap
    const double rms = log_between(random, 0.05, 0.3);
    const double period_s = record.time_s[1] - record.time_s[0];
    for (auto& time : record.time_s) time += rms * period_s * random.normal();
    result.beside = {Fault::clock_jitter};
    result.first_sample -= std::min(first, kUncertain);
    result.last_sample += kUncertain;
    result.description += fmt::format(", {} gaps beside jitter of {} periods rms", places, rms);
  }
  return result;
}

PlantedFault backward_time(std::uint64_t seed, RandomNumbers& random) {
  const auto run = draw_run(seed);
  auto result = planted(run, sampled(run, random));
  auto& record = result.record;
  const std::size_t at = 20 + random.below(record.time_s.size() - 40);
  const std::size_t how = random.below(3);
  const auto each = [&](const std::function<void(std::vector<double>&)>& change) {
    change(record.time_s);
    change(record.torque_N_m);
    for (auto& channel : record.channels) change(channel.values);
  };
  if (how == 0) {  // a row written twice
    each([&](std::vector<double>& x) {
      x.insert(x.begin() + static_cast<std::ptrdiff_t>(at), x[at - 1]);
    });
  } else if (how == 1) {  // two rows exchanged
    each([&](std::vector<double>& x) { std::swap(x[at - 1], x[at]); });
  } else {
    const double back_s =
        std::max(2.0 * (record.time_s[1] - record.time_s[0]), log_between(random, 0.01, 1.0));
    for (std::size_t k = at; k < record.time_s.size(); ++k) record.time_s[k] -= back_s;
  }
  result.channel = "time";
  result.first_sample = at;
  result.last_sample = at;
  return result;
}

/// Rows written again behind themselves, and even times for them all: single rows, or a block of
/// them.
PlantedFault duplicated_samples(std::uint64_t seed, RandomNumbers& random) {
  const auto run = draw_run(seed);
  auto result = planted(run, sampled(run, random));
  auto& record = result.record;
  const double period_s = record.time_s[1] - record.time_s[0];
  const std::size_t count = 1 + random.below(20);
  const std::size_t block = chance(random, 0.5) ? 1 : count;
  std::size_t first = record.time_s.size();
  for (std::size_t done = 0; done < count; done += block) {
    const std::size_t at = 20 + random.below(record.time_s.size() - 80);
    const auto repeat = [&](std::vector<double>& x) {
      const std::vector<double> copy(x.begin() + static_cast<std::ptrdiff_t>(at),
                                     x.begin() + static_cast<std::ptrdiff_t>(at + block));
      x.insert(x.begin() + static_cast<std::ptrdiff_t>(at + block), copy.begin(), copy.end());
    };
    repeat(record.torque_N_m);
    for (auto& channel : record.channels) repeat(channel.values);
    record.time_s.resize(record.torque_N_m.size());
    first = std::min(first + (first > at ? block : 0), at + block);
  }
  for (std::size_t k = 0; k < record.time_s.size(); ++k) {
    record.time_s[k] = period_s * static_cast<double>(k);
  }
  result.channel = "time";
  result.first_sample = first;
  result.last_sample = first;
  result.description += fmt::format(", {} rows written twice in blocks of {}", count, block);
  return result;
}

PlantedFault sampling_jitter(std::uint64_t seed, RandomNumbers& random) {
  constexpr int kRefinement = 8;
  constexpr double kLeastError = 0.5;  // of the noise of a channel
  while (true) {
    const auto run = draw_run(seed, {{}, kRefinement});
    const bool pulses = run.description.find("bang-bang") != std::string::npos;
    const double rms = log_between(random, pulses ? 0.2 : 0.07, 0.3);
    std::vector<double> off_periods(run.fine.time_s.size() / kRefinement);
    const TimeRecord even = sampled_off_time(run, off_periods);
    for (auto& off : off_periods) off = rms * random.normal();
    TimeRecord record = sampled_off_time(run, off_periods);
    seed += 10'000;  // another run
    if (error_over_noise(even, record, run.noise) < kLeastError) continue;
    finish(record, run, random);
    auto result = planted(run, std::move(record));
    result.channel = "time";
    result.description += fmt::format(", instants off by {:.3f} periods rms", rms);
    return result;
  }
}

}  // namespace flexarm::measured
