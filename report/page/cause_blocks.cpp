#include "report/page/cause_blocks.hpp"

#include "report/page/page_curves.hpp"
#include "report/page/page_words.hpp"
#include "report/tables/missing_force_table.hpp"
#include "report/words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace flexarm::report::page {

namespace {

std::string explained_text(double share) {
  return fmt::format("{:.3g} %", explained_percent(share));
}

std::string joined_words(const std::vector<std::string>& names) {
  std::vector<std::string> words;
  for (const std::string& name : names) words.push_back(text_in_words(name));
  return fmt::format("{}", fmt::join(words, ", "));
}

/// The values of a table that belong to one velocity of a law over angle and velocity.
std::vector<double> column_of(const diagnose::EmpiricalLaw& law, const std::vector<double>& values,
                              std::size_t column) {
  if (law.means.size() < 2) return values;
  std::vector<double> made;
  for (std::size_t i = column; i < values.size(); i += law.table.columns()) {
    made.push_back(values[i]);
  }
  return made;
}

}  // namespace

std::string probability_text(double probability) {
  constexpr double kSmallest = 0.01;
  return probability >= kSmallest || probability == 0.0 ? fmt::format("{:.2f}", probability)
                                                        : fmt::format("{:.1e}", probability);
}

std::string cause_label(const diagnose::Cause& cause) {
  const std::string effect = sentence_of(cause.effect);
  return cause.sensor.empty() ? effect : effect + " on " + text_in_words(cause.sensor);
}

RankingBlock cause_ranking(const diagnose::Diagnosis& diagnosis) {
  RankingBlock block{
      {"ranking", "Probability of each cause",
       "Posterior probability of each effect by itself, relative to the sets of "
       "effects that were tried. Several may be present: the probabilities do not add "
       "up."},
      {}};
  for (const auto& cause : diagnosis.causes) {
    const bool is_explaining = explained_percent(cause.share) > 0.0;
    RankingItem item{cause_label(cause),
                     cause.confidence,
                     probability_text(cause.confidence),
                     is_explaining,
                     {}};
    for (const auto& parameter : cause.parameters) {
      item.details.push_back({text_in_words(parameter.name),
                              estimate_of(parameter.value, parameter.std_error, parameter.unit)});
    }
    item.details.push_back({"explains of the excess residual", explained_text(cause.share)});
    if (!cause.confusable_with.empty()) {
      item.details.push_back({"indistinguishable from", joined_words(cause.confusable_with)});
      item.details.push_back(
          {"probability of it or one of these", probability_text(cause.class_confidence)});
    }
    block.items.push_back(std::move(item));
  }
  return block;
}

TableBlock evidence_table(const diagnose::Diagnosis& diagnosis) {
  TableBlock block{{"evidence", "Evidence", ""}, {{"cause"}, {"for or against"}, {"evidence"}}, {}};
  for (const auto& cause : diagnosis.causes) {
    const std::string label = cause_label(cause);
    for (const auto& sentence : cause.evidence) {
      block.rows.push_back({label, "for", sentence_of(sentence)});
    }
    if (!cause.refuted_by.empty()) {
      block.rows.push_back({label, "would be against", sentence_of(cause.refuted_by)});
    }
  }
  return block;
}

TableBlock indistinguishable_table(const diagnose::Diagnosis& diagnosis) {
  TableBlock block{
      {"indistinguishable", "Indistinguishable in these data", ""},
      {{"cause"}, {"indistinguishable from"}, {"probability of one of them", "", true}},
      {}};
  for (const auto& cause : diagnosis.causes) {
    if (cause.confusable_with.empty()) continue;
    block.rows.push_back({cause_label(cause), joined_words(cause.confusable_with),
                          probability_text(cause.class_confidence)});
  }
  return block;
}

CurvesBlock empirical_law_block(const diagnose::EmpiricalLaw& law) {
  const bool is_over_angle = !law.table.angle_rad.empty();
  const auto& axis = is_over_angle ? law.table.angle_rad : law.table.velocity_rad_per_s;
  const bool has_views = law.means.size() > 1;
  CurvesBlock block{
      {"empirical-law", "Empirical law of hub torque", "Bands show one standard error."},
      is_over_angle ? Axis{"hub angle", "rad"} : Axis{"hub velocity", "rad/s"},
      has_views ? std::vector<std::string>{"hub velocity"} : std::vector<std::string>{},
      {}};
  for (std::size_t column = 0; column < law.means.size(); ++column) {
    CurvesPanel panel{{"hub torque", "N m"}, 1.0, {}};
    panel.series.push_back({"empirical law", Role::after, Draw::line,
                            Samples{axis, column_of(law, law.table.torque_N_m, column),
                                    column_of(law, law.std_errors_N_m, column)}});
    std::vector<double> at;
    std::vector<double> torque;
    std::vector<double> std_error;
    for (const auto& mean : law.means[column]) {
      at.push_back(mean.at);
      torque.push_back(mean.torque_N_m);
      std_error.push_back(mean.std_error_N_m);
    }
    if (!at.empty()) {
      panel.series.push_back({"mean residual hub torque", Role::measured, Draw::points,
                              Samples{std::move(at), std::move(torque), std::move(std_error)}});
    }
    CurvesView view{{}, {}, {std::move(panel)}};
    if (has_views) {
      view.labels.push_back(fmt::format("{:.3g} rad/s", law.table.velocity_rad_per_s[column]));
    }
    block.views.push_back(std::move(view));
  }
  return block;
}

RankingBlock missing_force_ranking(const diagnose::MissingForce& force) {
  RankingBlock block{
      {"missing-force", "Port of the missing force",
       "Part of the excess residual that an arbitrary force at each port explains by "
       "itself; the parts do not add up."},
      {},
      "port stated"};
  for (std::size_t i = 0; i < force.ports.size(); ++i) {
    const diagnose::PortShare& port = force.ports[i];
    RankingItem item{
        sentence_of(port_name(port)),
        explained_percent(port.share) / 100.0,
        fmt::format("{:.0f} ± {:.0f} %", explained_percent(port.share), 100.0 * port.std_error),
        i < force.stated,
        {}};
    if (!port.place.empty()) item.details.push_back({"best place", text_in_words(port.place)});
    block.items.push_back(std::move(item));
  }
  return block;
}

}  // namespace flexarm::report::page
