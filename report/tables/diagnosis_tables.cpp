#include "report/tables/diagnosis_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

namespace flexarm::report {

namespace {

std::string names(const std::vector<diagnose::Cause>& causes) {
  std::vector<std::string> all;
  for (const auto& cause : causes) {
    all.push_back(cause.sensor.empty() ? cause.effect : cause.effect + " on " + cause.sensor);
  }
  return fmt::format("{}", fmt::join(all, " and "));
}

std::vector<Cell> gain_row(const std::string& runs, const diagnose::Gain& gain) {
  return {runs, 100.0 * gain.before, 100.0 * gain.after, 100.0 * gain.noise_floor};
}

}  // namespace

std::string verdict_text(const diagnose::Diagnosis& diagnosis) {
  const double before = 100.0 * diagnosis.estimation.before;
  const double after = 100.0 * diagnosis.estimation.after;
  const double noise = 100.0 * diagnosis.estimation.noise_floor;
  switch (diagnosis.verdict) {
    case diagnose::Verdict::adequate:
      return fmt::format(
          "Adequate: the simulation misses the data by {:.3g} % of the signal where noise alone "
          "makes {:.3g} %; nothing that is worth a cause.",
          before, noise);
    case diagnose::Verdict::explained:
      return fmt::format(
          "Explained by {}: the error falls from {:.3g} to {:.3g} % of the signal, of which noise "
          "makes {:.3g} %.",
          names(diagnosis.causes), before, after, noise);
    case diagnose::Verdict::partly_explained:
      return fmt::format(
          "Partly explained by {}: the error falls from {:.3g} to {:.3g} % of the signal, but "
          "noise "
          "makes only {:.3g} %; something else is there too.",
          names(diagnosis.causes), before, after, noise);
    case diagnose::Verdict::unexplained:
      return fmt::format(
          "Unexplained: the simulation misses the data by {:.3g} % of the signal where noise makes "
          "{:.3g} %, and no effect of the vocabulary, nor a pair, accounts for it.",
          before, noise);
  }
  return "";
}

Table cause_table(const diagnose::Diagnosis& diagnosis) {
  Table table{"Causes",
              {{.name = "effect"},
               {.name = "parameter"},
               {.name = "value"},
               {.name = "std error", .significant_digits = 2},
               {.name = "unit"},
               {.name = "share", .unit = "%", .significant_digits = 4},
               {.name = "confidence", .significant_digits = 2},
               {.name = "not told from"}}};
  for (const auto& cause : diagnosis.causes) {
    for (std::size_t i = 0; i < cause.parameters.size(); ++i) {
      const auto& parameter = cause.parameters[i];
      const bool first = i == 0;
      table.add_row({first ? Cell(names({cause})) : Cell(std::string()), parameter.name,
                     parameter.value, parameter.std_error, parameter.unit,
                     first ? Cell(100.0 * cause.share) : Cell(std::string()),
                     first ? Cell(cause.confidence) : Cell(std::string()),
                     first ? Cell(fmt::format("{}", fmt::join(cause.confusable_with, ", ")))
                           : Cell(std::string())});
    }
  }
  return table;
}

Table channel_gain_table(const diagnose::Diagnosis& diagnosis) {
  Table table{"Error of the simulation, per cent of the signal",
              {{.name = "run"},
               {.name = "sensor"},
               {.name = "before", .unit = "%", .significant_digits = 3},
               {.name = "after", .unit = "%", .significant_digits = 3},
               {.name = "noise", .unit = "%", .significant_digits = 3}}};
  for (const auto& channel : diagnosis.channels) {
    auto row = gain_row(channel.run, channel.error);
    row.insert(row.begin() + 1, channel.sensor);
    table.add_row(row);
  }
  return table;
}

Table near_miss_table(const diagnose::Diagnosis& diagnosis) {
  Table table{"Nearest, but not named",
              {{.name = "effects"},
               {.name = "takes away", .unit = "%", .significant_digits = 3},
               {.name = "information", .significant_digits = 3},
               {.name = "error left", .unit = "%", .significant_digits = 3}}};
  for (const auto& miss : diagnosis.near_misses) {
    table.add_row({miss.effects, 100.0 * miss.share, miss.information, 100.0 * miss.error});
  }
  return table;
}

Table refitted_table(const diagnose::Diagnosis& diagnosis) {
  Table table{"Uncertain numbers of the arm, refitted",
              {{.name = "key"},
               {.name = "file"},
               {.name = "uncertain by", .unit = "%", .significant_digits = 3},
               {.name = "value"},
               {.name = "std error", .significant_digits = 2},
               {.name = "unit"}}};
  for (const auto& number : diagnosis.refitted) {
    table.add_row({number.key, number.file_value, 100.0 * number.uncertainty, number.value,
                   number.std_error, number.unit});
  }
  return table;
}

std::string formulations_text(const diagnose::FormulationCheck& check) {
  if (!check.refused.empty()) {
    return fmt::format("The extended arm was not compared in three formulations: {}.",
                       check.refused);
  }
  return fmt::format(
      "Finite elements, assumed modes and the exact transfer function {} on the linear part of the "
      "extended arm: they are at most {:.1e} apart, in {}.",
      check.agree ? "agree" : "do not agree", check.largest_distance, check.quantity);
}

Table gain_table(const diagnose::Diagnosis& diagnosis) {
  Table table{"Gain",
              {{.name = "runs"},
               {.name = "before", .unit = "%", .significant_digits = 3},
               {.name = "after", .unit = "%", .significant_digits = 3},
               {.name = "noise", .unit = "%", .significant_digits = 3}}};
  table.add_row(gain_row("estimation", diagnosis.estimation));
  if (diagnosis.validation) table.add_row(gain_row("validation", *diagnosis.validation));
  return table;
}

}  // namespace flexarm::report
