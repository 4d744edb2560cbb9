#include "report/page/sweep_page.hpp"

#include "report/page/page_table.hpp"
#include "report/page/page_words.hpp"
#include "report/page/sweep_blocks.hpp"
#include "report/tables/sweep_tables.hpp"
#include "report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace flexarm::report::page {

namespace {

using compare::SweepResult;

Verdict sweep_verdict(const SweepResult& result) {
  if (result.agreement.empty()) {
    return {Status::neutral, "computed",
            fmt::format("{} points by {} alone.", result.task.points(),
                        text_in_words(result.task.models.front().name))};
  }
  std::string line = sweep_verdict_line(result);
  line.erase(line.find_last_not_of("\n ") + 1);
  // "Agree: largest relative difference ..."
  std::string found = text_in_words(line.substr(line.find(": ") + 2));
  for (const auto& axis : result.task.axes) {
    const std::string& key = axis.parameter.name;
    if (const auto at = found.find(key); at != std::string::npos) {
      found.replace(at, key.size(), in_words(key));
    }
  }
  const bool agree = result.agrees();
  return {agree ? Status::good : Status::bad,
          agree ? "formulations agree" : "formulations disagree", sentence_of(found) + "."};
}

std::vector<Fact> sweep_facts(const SweepResult& result) {
  std::vector<Fact> facts;
  for (const auto& axis : result.task.axes) {
    const std::string unit = unit_text(axis.parameter.unit);
    facts.push_back(
        {in_words(axis.parameter.name),
         fmt::format("{} to {}{}", number_of(axis.values.front(), 4),
                     number_of(axis.values.back(), 4), unit.empty() ? "" : " " + unit)});
  }
  facts.push_back({"points", fmt::format("{}", result.task.points())});
  if (const auto* worst = largest_sweep_difference(result);
      worst != nullptr && worst->compared > 0) {
    facts.push_back({"largest relative difference",
                     fmt::format("{:.2g} (tolerance {:g})", worst->worst, worst->tolerance)});
  }
  facts.push_back({"events", fmt::format("{}", result.events.size())});
  return facts;
}

}  // namespace

PageDocument sweep_page(const SweepResult& result, const PageOrigin& origin) {
  PageDocument document{origin.program,
                        origin.command,
                        "Sweep of " + origin.subject,
                        sweep_verdict(result),
                        {},
                        sweep_facts(result),
                        {}};
  auto maps = sweep_maps(result);
  Section others{"maps", "Further sensors"};
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (i == 0) {
      document.headline = std::move(maps[i]);
    } else {
      others.blocks.emplace_back(std::move(maps[i]));
    }
  }
  document.add(std::move(others));
  Section curves{"curves", "Curves"};
  curves.add(sweep_curves(result));
  document.add(std::move(curves));
  Section ranges{"ranges", "Ranges"};
  std::size_t number = 0;
  for (const auto& table : sweep_range_tables(result)) {
    add_table(ranges, table, fmt::format("range-{}", ++number));
  }
  document.add(std::move(ranges));
  Section events{"events", "Events"};
  add_table(events, sweep_events_table(result, std::numeric_limits<std::size_t>::max()),
            "event-table", "Where zeros meet, part, appear or leave the range.");
  document.add(std::move(events));
  Section agreement{"agreement", "Agreement of the formulations"};
  add_table(agreement, sweep_agreement_table(result), "agreement-table");
  Table models = sweep_models_table(result);
  models.caption = "Models";
  add_table(agreement, models, "models");
  document.add(std::move(agreement));
  return document;
}

}  // namespace flexarm::report::page
