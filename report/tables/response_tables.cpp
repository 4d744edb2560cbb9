#include "report/tables/response_tables.hpp"

#include "report/figures/phase.hpp"
#include "report/tables/zero_kind.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace flexarm::report {

namespace {

using Complex = std::complex<double>;

constexpr int kResponseDigits = 10;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double in_Hz(double omega_rad_per_s) {
  return omega_rad_per_s / (2.0 * std::numbers::pi);
}

double decibel(const Complex& value) {
  return 20.0 * std::log10(std::abs(value));
}

/// A number, or a missing cell: NaN counts as missing.
double if_known(bool known, double value) {
  return known ? value : kNone;
}

/// A row of name, undamped frequency and one root: Re, Im, |s| in Hz, damping ratio.
void add_root(Table& table, std::string name, double undamped_Hz, const Complex& s) {
  const double size = std::abs(s);
  std::vector<Cell> row;
  row.emplace_back(std::move(name));
  for (const double value : {undamped_Hz, s.real(), s.imag(), in_Hz(size),
                             if_known(size > 0.0, -s.real() / size + 0.0)}) {
    row.emplace_back(value);
  }
  table.add_row(std::move(row));
}

void add_pair(Table& table, const std::string& name, double undamped_Hz,
              const arm::PolePair& pair) {
  add_root(table, name, undamped_Hz, pair.first_rad_per_s);
  const bool real = pair.first_rad_per_s.imag() == 0.0;
  if (real && pair.second_rad_per_s != pair.first_rad_per_s) {
    add_root(table, name, undamped_Hz, pair.second_rad_per_s);
  }
}

}  // namespace

std::string response_unit(const arm::Sensor& sensor, const std::optional<arm::Sensor>& input) {
  const std::string_view per = input ? arm::unit(*input) : "N m";
  return per == "rad" ? fmt::format("{}/rad", arm::unit(sensor))
                      : fmt::format("{}/({})", arm::unit(sensor), per);
}

Table response_poles_table(const response::ResponseStudy& study, std::size_t most) {
  Table table{"Poles (one per complex-conjugate pair)",
              {{"pole"},
               {"undamped", "Hz", kResponseDigits},
               {"Re s", "rad/s", kResponseDigits},
               {"Im s", "rad/s", kResponseDigits},
               {"|s|/2 pi", "Hz", kResponseDigits},
               {"damping ratio", "", 5}}};
  const double lowest = study.poles.lowest_omega_squared_rad2_per_s2;
  add_pair(table, "0", if_known(lowest >= 0.0, in_Hz(std::sqrt(lowest))),
           study.damped_poles.lowest);
  const auto& flexible = study.damped_poles.flexible;
  for (std::size_t i = 0; i < std::min(most, flexible.size()); ++i) {
    const bool known = i < study.poles.omega_rad_per_s.size();
    add_pair(table, fmt::format("{}", i + 1),
             if_known(known, known ? in_Hz(study.poles.omega_rad_per_s[i]) : 0.0), flexible[i]);
  }
  if (study.chain.lag_s > 0.0) add_root(table, "actuator lag", kNone, -1.0 / study.chain.lag_s);
  for (const auto& stages : study.chain.sensor_chains) {
    if (stages.lag_s > 0.0) add_root(table, "sensor lag", kNone, -1.0 / stages.lag_s);
  }
  return table;
}

std::vector<std::string> formulas(const response::ResponseStudy& study, std::size_t index) {
  const auto& product = study.products[index];
  const int derivatives = arm::derivative_order(product.sensor);
  const std::string power = product.power == 0 ? "" : fmt::format(" s^{}", product.power);
  const std::string factor = derivatives == 0 ? "" : derivatives == 1 ? "s " : "s^2 ";
  return {
      fmt::format("G = {:.10g}{} prod (1 - s^2/z_i^2)/(1 + s^2/omega_i^2), undamped", product.gain,
                  power),
      fmt::format(
          "G = {}sum r_i/(s^2 + d_i s + omega_i^2), r_i = sensor value times hub slope over I_T",
          factor)};
}

Table factors_table(const response::ResponseStudy& study, std::size_t index) {
  const auto& product = study.products[index];
  const auto& fractions = study.fractions[index];
  const bool off_axis = std::ranges::any_of(product.zeros_rad_per_s,
                                            [](Complex z) { return is_non_minimum_phase(z); });
  Table table{
      fmt::format("Torque to {}{}", arm::to_string(product.sensor),
                  off_axis ? " (zeros +-z_i; non-minimum phase where Re z_i is not 0)" : ""),
      {{"i"},
       {"omega_i", "rad/s", kResponseDigits},
       {"Re z_i", "rad/s", kResponseDigits},
       {"Im z_i", "rad/s", kResponseDigits},
       {"r_i", "", kResponseDigits},
       {"d_i", "rad/s", 6}}};
  const std::size_t zeros = product.zeros_rad_per_s.size();
  for (std::size_t i = 0; i < std::max(fractions.size(), zeros + 1); ++i) {
    const bool has_mode = i < fractions.size();
    const bool has_zero = i > 0 && i <= zeros;
    const Complex zero = has_zero ? product.zeros_rad_per_s[i - 1] : Complex();
    const response::PartialFraction term = has_mode ? fractions[i] : response::PartialFraction{};
    const double squared = term.omega_squared_rad2_per_s2;
    std::vector<Cell> row;
    row.emplace_back(std::int64_t(i));
    row.emplace_back(if_known(has_mode && squared >= 0.0, std::sqrt(squared)));
    row.emplace_back(if_known(has_zero, zero.real()));
    row.emplace_back(if_known(has_zero, zero.imag()));
    row.emplace_back(if_known(has_mode, term.residue));
    row.emplace_back(if_known(has_mode, term.damping_rad_per_s));
    table.add_row(std::move(row));
  }
  return table;
}

namespace {

/// The continuous phase; the principal one of a response that has none.
std::vector<double> phase_of(const response::FrequencyResponse& response, std::size_t k) {
  return response.phase_deg.empty() ? principal_phase_deg(response.values[k])
                                    : response.phase_deg[k];
}

}  // namespace

Table response_table(const response::FrequencyResponse& response, std::size_t most) {
  Table table{"Response", {{"frequency", "Hz", 7}}};
  std::vector<std::vector<double>> phases;
  for (std::size_t k = 0; k < response.sensors.size(); ++k) {
    table.columns.push_back(
        {arm::to_string(response.sensors[k]), response_unit(response.sensors[k]), 7});
    table.columns.push_back({"magnitude", "dB", 6});
    table.columns.push_back({"phase", "deg", 6});
    phases.push_back(phase_of(response, k));
  }
  const auto add = [&](std::size_t i) {
    std::vector<Cell> row = {response.frequency_Hz[i]};
    for (std::size_t k = 0; k < response.sensors.size(); ++k) {
      const Complex value = response.values[k][i];
      row.emplace_back(std::abs(value));
      row.emplace_back(decibel(value));
      row.emplace_back(phases[k][i]);
    }
    table.add_row(std::move(row));
  };
  const auto& frequency = response.frequency_Hz;
  if (most == 0 || frequency.size() <= most || most < 2) {
    for (std::size_t i = 0; i < frequency.size(); ++i) add(i);
    return table;
  }
  // The nearest frequency to each place of a logarithmic scale.
  std::size_t last = frequency.size();
  for (std::size_t j = 0; j < most; ++j) {
    const double wanted =
        frequency.front() * std::pow(frequency.back() / frequency.front(),
                                     static_cast<double>(j) / static_cast<double>(most - 1));
    const auto above = std::ranges::lower_bound(frequency, wanted);
    auto i = static_cast<std::size_t>(above - frequency.begin());
    if (i == frequency.size()) --i;
    if (i > 0 && wanted - frequency[i - 1] < frequency[i] - wanted) --i;
    if (i != last) add(i);
    last = i;
  }
  return table;
}

Table response_listing(const response::FrequencyResponse& response) {
  Table table{"Response", {{"frequency", "Hz"}}};
  std::vector<std::vector<double>> phases;
  for (std::size_t k = 0; k < response.sensors.size(); ++k) {
    const std::string name = arm::to_string(response.sensors[k]);
    const std::string unit = response_unit(response.sensors[k]);
    table.columns.push_back({name + " re", unit});
    table.columns.push_back({name + " im", unit});
    table.columns.push_back({name + " magnitude", unit});
    table.columns.push_back({name + " magnitude", "dB"});
    table.columns.push_back({name + " phase", "deg"});
    phases.push_back(phase_of(response, k));
  }
  for (std::size_t i = 0; i < response.frequency_Hz.size(); ++i) {
    std::vector<Cell> row = {response.frequency_Hz[i]};
    for (std::size_t k = 0; k < response.sensors.size(); ++k) {
      const Complex value = response.values[k][i];
      for (const double number :
           {value.real(), value.imag(), std::abs(value), decibel(value), phases[k][i]}) {
        row.emplace_back(number);
      }
    }
    table.add_row(std::move(row));
  }
  return table;
}

Table frf_listing(const response::FrequencyResponse& response) {
  Table table{"", {{"frequency", "Hz"}, {"sensor"}, {"re"}, {"im"}, {"coherence"}}};
  for (std::size_t k = 0; k < response.sensors.size(); ++k) {
    for (std::size_t i = 0; i < response.frequency_Hz.size(); ++i) {
      const Complex value = response.values[k][i];
      table.add_row({response.frequency_Hz[i], arm::to_string(response.sensors[k]), value.real(),
                     value.imag(), Cell()});
    }
  }
  return table;
}

Table state_space_table(const response::ResponseStudy& study) {
  Table table{"State space: " + describe_state_space(study),
              {{"sensor"},
               {"feedthrough D", "", kResponseDigits},
               {"unit"},
               error_column("largest error"),
               {"at", "Hz", 5},
               error_column("median error")}};
  const auto errors = response::state_space_errors(study);
  for (std::size_t k = 0; k < errors.size(); ++k) {
    const auto& sensor = study.response.sensors[k];
    table.add_row({arm::to_string(sensor), study.state_space->d(static_cast<Eigen::Index>(k), 0),
                   response_unit(sensor), errors[k].largest, errors[k].largest_at_Hz,
                   errors[k].median});
  }
  return table;
}

std::string describe_state_space(const response::ResponseStudy& study) {
  return fmt::format("{} states, {} flexible modes{}", study.state_space->a.rows(),
                     study.truncation->modes,
                     study.residual_mode ? " and a static correction" : "");
}

std::vector<std::string> chain_notes(const response::ResponseStudy& study) {
  std::vector<std::string> parts;
  const auto& chain = study.chain;
  if (chain.delay_s != 0.0) parts.push_back(fmt::format("delay {:g} s", chain.delay_s));
  if (chain.gain != 1.0) parts.push_back(fmt::format("torque gain {:g}", chain.gain));
  if (chain.lag_s > 0.0) parts.push_back(fmt::format("actuator lag {:g} s", chain.lag_s));
  for (const auto& stages : chain.sensor_chains) {
    const std::string sensor = arm::to_string(stages.sensor);
    if (stages.gain != 1.0) parts.push_back(fmt::format("gain of {} {:g}", sensor, stages.gain));
    if (stages.delay_s > 0.0) {
      parts.push_back(fmt::format("delay of {} {:g} s", sensor, stages.delay_s));
    }
    if (stages.lag_s > 0.0) parts.push_back(fmt::format("lag of {} {:g} s", sensor, stages.lag_s));
  }
  std::vector<std::string> notes;
  if (!parts.empty()) notes.push_back(fmt::format("included: {}", fmt::join(parts, ", ")));
  if (!study.left_out.empty()) {
    notes.push_back(fmt::format("not included (nonlinear): {}", fmt::join(study.left_out, ", ")));
  }
  return notes;
}

}  // namespace flexarm::report
