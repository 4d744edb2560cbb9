#include "report/tables/identification_tables.hpp"

#include "report/tables/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace flexarm::report {

namespace {

/// The order of the pole that a fit has at this frequency.
std::optional<int> order_of_mode(const compare::IdentifiedCondition& condition,
                                 double frequency_Hz) {
  for (const auto& roots : condition.roots) {
    const auto root = std::ranges::find_if(roots, [&](const compare::IdentifiedRoot& one) {
      return one.measured.feature == measured::Feature::pole && one.order &&
             one.measured.frequency_Hz == frequency_Hz;
    });
    if (root != roots.end()) return root->order;
  }
  return std::nullopt;
}

}  // namespace

std::string joined(const std::vector<std::string>& run_ids) {
  return fmt::format("{}", fmt::join(run_ids, "+"));
}

std::vector<std::string> ids_of(const measured::RunsFit& fit,
                                const measured::Identification& identification) {
  std::vector<std::string> ids;
  for (const std::size_t r : fit.runs) ids.push_back(identification.runs[r].run.id);
  return ids;
}

std::vector<std::string> doubts(const measured::Identification& identification) {
  std::vector<std::string> found;
  for (const auto& fit : identification.fits) {
    if (const std::string doubt = measured::doubt_of(fit); !doubt.empty()) {
      found.push_back(fmt::format("{}: {}", joined(ids_of(fit, identification)), doubt));
    }
  }
  return found;
}

std::vector<std::string> data_notes(const measured::Identification& identification) {
  std::vector<std::string> notes;
  if (!identification.are_checks_complete) {
    notes.emplace_back("the time limit left no time for all data checks");
  }
  for (const auto& run : identification.runs) {
    for (const auto& finding : run.findings) {
      notes.push_back(fmt::format("{}: {}: {}: {}", run.run.id, finding.channel,
                                  to_string(finding.fault), finding.text));
    }
    if (run.left_out_before_decay > 0) {
      notes.push_back(fmt::format("{}: free decay from {:.4g} s; the samples before are left out",
                                  run.run.id, *run.decay_begins_s));
    }
    if (run.hub_at_rest) {
      notes.push_back(
          fmt::format("{}: the hub is at rest: poles are those with the hub held", run.run.id));
    }
    for (const auto& sensor : run.left_out) {
      notes.push_back(fmt::format("{}: {} excluded", run.run.id, arm::to_string(sensor)));
    }
    if (!run.refusal.empty()) {
      notes.push_back(fmt::format("{}: no estimate: {}", run.run.id, run.refusal));
    }
    if (run.distortion && !run.distortion->testable) {
      notes.push_back(fmt::format("{}: distortion: {}", run.run.id, run.distortion->reason));
    }
  }
  for (const auto& fit : identification.fits) {
    const auto ids = ids_of(fit, identification);
    if (!fit.refusal.empty()) {
      notes.push_back(fmt::format("{}: no fit: {}", joined(ids), fit.refusal));
    }
    for (const auto& sensor : fit.fit.sensors) {
      const bool untold = std::ranges::any_of(sensor.zeros, [](const measured::FittedZero& zero) {
        return zero.in_band && !zero.is_told;
      });
      if (untold) {
        notes.push_back(
            fmt::format("{}: {}: zeros in the band with large standard errors omitted (not "
                        "identifiable from these data)",
                        joined(ids), arm::to_string(sensor.sensor)));
      }
    }
    if (!fit.gains_refusal.empty()) {
      notes.push_back(fmt::format("{}: {}", joined(ids), fit.gains_refusal));
    }
  }
  return notes;
}

std::vector<std::string> setting_lines(const measured::RunIdentification& run) {
  std::vector<std::string> lines;
  if (!run.estimate) return lines;
  for (const auto& report : run.estimate->settings.reports) {
    lines.push_back(fmt::format("{}: {} ({})", report.name, report.value, report.reason));
  }
  lines.push_back(fmt::format("line spacing {:.4g} Hz, {:.3g} effective averages",
                              run.estimate->spacing_Hz, run.estimate->averages));
  return lines;
}

Table gain_table(const measured::RunsFit& fit, const compare::IdentifiedCondition& condition) {
  const compare::AnalyticalModes& analytical = condition.analytical;
  Table table{"Hub slopes and accelerometer gains, modal mass I_T",
              {{"quantity"},
               {"mode"},
               {"unit"},
               {"equation"},
               {"measured", "", 5},
               qualifying("+-", "", 2)}};
  for (const auto& gains : analytical.gains) table.columns.push_back({gains.model, "", 5});
  if (!analytical.gains.empty()) table.columns.push_back({"error", "%", 3});
  if (!fit.gains) return table;
  const auto add = [&](const std::string& quantity, Cell mode, const std::string& unit,
                       const std::string& by, const measured::Estimate& estimate,
                       const std::vector<double>& expected) {
    std::vector<Cell> row = {quantity, std::move(mode), unit,
                             by,       estimate.value,  estimate.standard_error};
    for (const double value : expected) row.emplace_back(value);
    if (expected.empty()) return table.add_row(std::move(row));
    row.emplace_back(100.0 * (estimate.value - expected.front()) / std::abs(expected.front()));
    table.add_row(std::move(row));
  };
  std::vector<double> inertia;
  for (const auto& gains : analytical.gains) inertia.push_back(gains.total_inertia_kg_m2);
  add("I_T", Cell(), "kg m^2", "rigid body", fit.gains->total_inertia_kg_m2, inertia);
  for (const auto& mode : fit.gains->modes) {
    const auto root = order_of_mode(condition, mode.frequency_Hz);
    if (!root) continue;
    const auto index = static_cast<std::size_t>(*root - 1);
    std::vector<double> slopes, tips;
    for (const auto& gains : analytical.gains) {
      slopes.push_back(gains.hub_slope[index]);
      tips.push_back(gains.tip_gain_m[index]);
    }
    const Cell order = std::int64_t{*root};
    if (mode.hub_slope) add("phi'(0)", order, "1", "(48)", *mode.hub_slope, slopes);
    if (mode.hub_slope_of_product) {
      add("phi'(0)", order, "1", "(47), truncated", *mode.hub_slope_of_product, slopes);
    }
    if (mode.tip_gain_m) add("phi(l)", order, "m", "(49)", *mode.tip_gain_m, tips);
    if (mode.tip_gain_of_ratio_m) {
      add("phi(l)", order, "m", "(52), at the peak", *mode.tip_gain_of_ratio_m, tips);
    }
  }
  return table;
}

Table residual_table(const measured::RunsFit& fit) {
  Table table{"Residual analysis of the fit",
              {{"sensor"},
               {"standard deviation", "", 3},
               {"unit"},
               {"relative to signal", "%", 3},
               {"whiteness"},
               {"explained by past torque", "%", 2}}};
  for (const auto& sensor : fit.fit.sensors) {
    const auto& residual = sensor.residual;
    std::string kind = "white";
    if (residual.whiteness_probability < measured::ResidualQuality::kSignificance) {
      kind = "coloured";
    }
    const bool explained =
        residual.explained_probability < measured::ResidualQuality::kSignificance;
    if (explained) kind = "correlated with torque";
    table.add_row({arm::to_string(sensor.sensor), residual.standard_deviation,
                   std::string(arm::unit(sensor.sensor)), 100.0 * residual.relative, kind,
                   explained ? Cell(100.0 * residual.explained_share) : Cell()});
  }
  return table;
}

Table distortion_table(const measured::RunIdentification& run) {
  Table table{fmt::format("{}: nonlinear distortion at the detection lines", run.run.id),
              {{"sensor"},
               {"odd", "dB", 3},
               {"noise level", "dB", 3},
               {"significant"},
               {"even", "dB", 3},
               {"noise level", "dB", 3},
               {"significant"}}};
  if (!run.distortion || !run.distortion->testable || !run.estimate) return table;
  for (std::size_t i = 0; i < run.distortion->channels.size(); ++i) {
    const auto& channel = run.distortion->channels[i];
    std::vector<Cell> row = {arm::to_string(run.estimate->channels[i].sensor)};
    for (const auto* test : {&channel.odd, &channel.even}) {
      row.emplace_back(std::isfinite(test->level_dB) ? test->level_dB : kMissing);
      row.emplace_back(std::isfinite(test->noise_dB) ? test->noise_dB : kMissing);
      row.emplace_back(std::string(test->lines == 0 ? "no lines" : test->found ? "yes" : "no"));
    }
    table.add_row(std::move(row));
  }
  return table;
}

}  // namespace flexarm::report
