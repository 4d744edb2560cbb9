#include "report/tables/symptom_tables.hpp"

#include "report/tables/text_table.hpp"
#include "report/tables/zero_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace flexarm::report {

namespace {

using diagnose::Symptom;
using diagnose::Symptoms;

Column probability_column() {
  return error_column("p-value");
}

Cell number(const std::optional<double>& value) {
  if (!value) return Cell(std::monostate{});
  return Cell(*value);
}

std::string yes(bool value) {
  return value ? "yes" : "no";
}

Table table_of_regimes(const std::vector<diagnose::RegimeError>& regimes, std::string caption) {
  Table table{std::move(caption),
              {{.name = "quantity"},
               {.name = "from", .significant_digits = 3},
               {.name = "to", .significant_digits = 3},
               {.name = "unit"},
               {.name = "share", .unit = "%", .significant_digits = 2},
               {.name = "arm file", .unit = "%", .significant_digits = 3},
               {.name = "extended arm", .unit = "%", .significant_digits = 3},
               {.name = "noise floor", .unit = "%", .significant_digits = 2},
               {.name = "ratio", .significant_digits = 2},
               {.name = "innovation ratio", .significant_digits = 2},
               probability_column()}};
  for (const auto& regime : regimes) {
    table.add_row({std::string(to_string(regime.quantity)), regime.from, regime.to,
                   std::string(unit_of(regime.quantity)), 100.0 * regime.share,
                   100.0 * regime.before, 100.0 * regime.after, 100.0 * regime.noise_floor,
                   regime.ratio, number(regime.innovation_ratio), regime.p_value});
  }
  return table;
}

/// The first of each kind, then the others, errors last: those of further sensors say little more.
/// Else in the order of the statements.
std::vector<const Symptom*> told_first(const std::vector<Symptom>& statements) {
  std::vector<const Symptom*> order;
  std::vector<const Symptom*> others;
  for (const Symptom& one : statements) {
    const bool is_new =
        std::ranges::none_of(order, [&](const Symptom* told) { return told->kind == one.kind; });
    (is_new ? order : others).push_back(&one);
  }
  std::ranges::stable_partition(others, [](const Symptom* one) {
    return one->is_significant && one->kind != diagnose::SymptomKind::error;
  });
  order.insert(order.end(), others.begin(), others.end());
  return order;
}

}  // namespace

std::string what_is_wrong_text(const Symptoms& symptoms, std::size_t most_lines,
                               std::size_t max_width) {
  if (symptoms.statements.empty()) return "";
  std::vector<const Symptom*> told;
  std::size_t lines = 0;
  for (const Symptom* one : told_first(symptoms.statements)) {
    const std::string paragraph = to_paragraph("- " + one->text, 2, max_width);
    lines += static_cast<std::size_t>(std::ranges::count(paragraph, '\n'));
    if (lines > most_lines) break;
    told.push_back(one);
  }
  std::string text = "Residual analysis of the baseline\n";
  for (const Symptom& one : symptoms.statements) {
    if (std::ranges::find(told, &one) == told.end()) continue;
    text += to_paragraph("- " + one.text, 2, max_width);
  }
  return text;
}

Table symptom_table(const Symptoms& symptoms) {
  Table table{"Findings of the residual analysis",
              {{.name = "kind"},
               {.name = "significant"},
               {.name = "deviate", .unit = "sigma", .significant_digits = 3},
               probability_column(),
               {.name = "run"},
               {.name = "sensor"},
               {.name = "finding"}}};
  for (const Symptom& one : symptoms.statements) {
    table.add_row({std::string(to_string(one.kind)), yes(one.is_significant), one.deviate,
                   one.probability, one.run, one.sensor, one.text});
  }
  return table;
}

Table band_table(const Symptoms& symptoms) {
  Table table{"NRMSE by frequency band",
              {{.name = "run"},
               {.name = "sensor"},
               {.name = "band"},
               {.name = "from", .unit = "Hz", .significant_digits = 3},
               {.name = "to", .unit = "Hz", .significant_digits = 3},
               {.name = "torque rms", .unit = "N m", .significant_digits = 3},
               {.name = "payload", .unit = "kg", .significant_digits = 3},
               {.name = "arm file", .unit = "%", .significant_digits = 3},
               {.name = "extended arm", .unit = "%", .significant_digits = 3},
               {.name = "noise floor", .unit = "%", .significant_digits = 3},
               probability_column()}};
  for (const auto& error : symptoms.bands) {
    table.add_row({error.run_id, error.sensor, error.band.name, error.band.from_Hz,
                   error.band.to_Hz, number(error.torque_rms_N_m), error.payload_kg,
                   100.0 * error.before, 100.0 * error.after, 100.0 * error.noise,
                   error.probability});
  }
  return table;
}

Table regime_table(const Symptoms& symptoms) {
  return table_of_regimes(symptoms.regimes, "Error by regime");
}

Table where_it_fails_table(const Symptoms& symptoms) {
  std::vector<diagnose::RegimeError> regimes = symptoms.regimes;
  std::ranges::stable_sort(regimes, [](const auto& one, const auto& other) {
    return std::pair(one.is_significant(), one.excess_share()) >
           std::pair(other.is_significant(), other.excess_share());
  });
  return table_of_regimes(regimes,
                          "Where it fails: error by regime, significant with a p-value below 0.01");
}

Table root_shift_table(const Symptoms& symptoms) {
  Table table{"Poles and zeros",
              {{.name = "run"},
               {.name = "payload", .unit = "kg"},
               {.name = "pole or zero"},
               {.name = "order"},
               {.name = "quantity"},
               {.name = "unit"},
               {.name = "measured"},
               {.name = "std error", .significant_digits = 2},
               {.name = "arm file"},
               {.name = "extended arm"},
               {.name = "shift", .unit = "%", .significant_digits = 3},
               {.name = "deviation", .unit = "sigma", .significant_digits = 3}}};
  for (const auto& shift : symptoms.roots) {
    const auto& damping = shift.damping_ratio;
    std::string name = shift.zero_of ? arm::to_string(*shift.zero_of) + " zero" : "pole";
    if (shift.zero_of && damping && is_non_minimum_phase(damping->measured, damping->std_error)) {
      name += " (non-minimum phase)";
    }
    const auto add = [&](const std::string& quantity, const std::string& unit,
                         const std::optional<diagnose::RootNumber>& number) {
      if (!number) return;
      table.add_row({shift.run, shift.payload_kg, name, std::int64_t{shift.order}, quantity, unit,
                     number->measured, number->std_error, number->before, number->after,
                     number->shift_percent(), number->deviates()});
    };
    add("frequency", "Hz", shift.frequency_Hz);
    add("damping ratio", "1", shift.damping_ratio);
  }
  return table;
}

Table hub_torque_table(const Symptoms& symptoms) {
  Table table{"Residual hub torque",
              {{.name = "term"},
               {.name = "accepted"},
               {.name = "coefficient"},
               {.name = "std error", .significant_digits = 2},
               {.name = "unit"},
               {.name = "threshold or cycles"},
               {.name = "explained share", .unit = "%", .significant_digits = 3},
               probability_column()}};
  const auto add = [&](const diagnose::HubTorqueTerm& term, bool accepted) {
    const bool has_place = term.kind == diagnose::HubTorqueKind::ripple ||
                           term.kind == diagnose::HubTorqueKind::saturation;
    table.add_row({std::string(term_name(term.kind)), yes(accepted), term.coefficient,
                   term.std_error, term.unit, has_place ? Cell(term.at) : Cell(kMissing),
                   explained_percent(term.share), term.probability});
  };
  for (const auto& term : symptoms.hub_torque.terms) add(term, true);
  for (const auto& term : symptoms.hub_torque.left_over) add(term, false);
  return table;
}

Table run_value_table(const Symptoms& symptoms) {
  Table table{"Estimates from each run",
              {{.name = "effect"},
               {.name = "parameter"},
               {.name = "run"},
               {.name = "value"},
               {.name = "std error", .significant_digits = 2},
               {.name = "unit"}}};
  if (!symptoms.drift) return table;
  const auto& drift = *symptoms.drift;
  for (const auto& value : drift.values) {
    table.add_row(
        {drift.effect, drift.parameter, value.run, value.value, value.std_error, drift.unit});
  }
  return table;
}

Table distortion_table(const Symptoms& symptoms) {
  Table table{"Distortion",
              {{.name = "run"},
               {.name = "sensor"},
               {.name = "parity"},
               {.name = "lines"},
               {.name = "level", .unit = "dB", .significant_digits = 3},
               {.name = "noise floor", .unit = "dB", .significant_digits = 3},
               probability_column()}};
  for (const auto& run : symptoms.distortion) {
    for (std::size_t c = 0; c < run.sensors.size(); ++c) {
      const auto& channel = run.distortion.channels[c];
      const auto add = [&](const char* parity, const measured::DistortionTest& test) {
        table.add_row({run.run, arm::to_string(run.sensors[c]), std::string(parity),
                       static_cast<std::int64_t>(test.lines), test.level_dB, test.noise_dB,
                       test.probability});
      };
      add("odd", channel.odd);
      add("even", channel.even);
    }
  }
  return table;
}

}  // namespace flexarm::report
