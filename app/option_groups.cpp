#include "app/option_groups.hpp"

#include <algorithm>

namespace flexarm::app {

namespace {

struct Group {
  std::string_view command;  ///< empty: all
  std::string_view heading;
  std::vector<std::string_view> options;
};

constexpr std::string_view kOthers = "Options";

/// What a command is about comes first, what all have in common last.
const std::vector<Group>& groups() {
  static const std::vector<Group> all = {
      {"compare",
       "Comparison",
       {"--measured", "--measured-tolerance", "--sensor", "--poles", "--zeros", "--tolerance",
        "--accuracy", "--quick", "--time-limit"}},
      {"modes", "Modes", {"--modes", "--sensor", "--certificate"}},
      {"response",
       "Response",
       {"--sensor", "--from-Hz", "--to-Hz", "--points", "--frequencies", "--modes"}},
      {"simulate",
       "Torque or reference",
       {"--excitation", "--torque", "--reference", "--controller", "--duration", "--period",
        "--seed", "--hold"}},
      {"simulate", "Sensors", {"--sensor", "--noise", "--noise-of", "--quantisation"}},
      {"sweep", "Parameters", {"--over", "--figure"}},
      {"sweep", "Quantities", {"--poles", "--zeros", "--sensor", "--roots-only", "--tolerance"}},
      {"import",
       "Columns",
       {"--column", "--compute", "--torque", "--time-unit", "--reference", "--controller",
        "--own-rate", "--leave-out", "--raw-columns"}},
      {"import",
       "Runs",
       {"--id", "--join", "--join-grid", "--rows", "--times", "--run", "--decimate", "--clock",
        "--fill-gaps", "--purpose", "--validation", "--hold", "--initial", "--payload-mass",
        "--payload-inertia"}},
      {"identify", "Data", {"--run", "--sensor", "--input"}},
      {"identify", "Spectra", {"--window", "--resolution", "--overlap", "--detrend", "--peaks"}},
      {"identify",
       "Modal fit",
       {"--from-Hz", "--to-Hz", "--modes", "--order", "--total-inertia", "--no-fit"}},
      {"diagnose",
       "Search",
       {"--effects", "--exclude", "--max-causes", "--time-limit", "--predictor", "--policy"}},
      {"diagnose", "Data", {"--accept"}},
      {"plan", "Effects", {"--effects", "--refit"}},
      {"", kOthers, {}},
      {"", "Arm", {"--payload-mass", "--payload-inertia", "--hub-inertia", "--arm"}},
      {"",
       "Formulation",
       {"--formulation", "--elements", "--degree", "--basis", "--functions",
        "--static-correction"}},
      {"",
       "Output",
       {"--out", "--json", "--verbose", "--full", "--force", "--name", "--save-as", "--to",
        "--write", "--state-space", "--modes-alone", "--hide-effects", "--update", "--report"}},
      {"", "General", {"--help", "--version"}}};
  return all;
}

bool is_for(const Group& group, std::string_view command) {
  return group.command.empty() || group.command == command;
}

}  // namespace

std::vector<std::string> option_groups(std::string_view command) {
  std::vector<std::string> headings;
  for (const auto& group : groups()) {
    if (is_for(group, command)) headings.emplace_back(group.heading);
  }
  return headings;
}

std::string group_of(std::string_view command, std::string_view option) {
  const auto group = std::ranges::find_if(groups(), [&](const Group& one) {
    return is_for(one, command) && std::ranges::count(one.options, option) > 0;
  });
  return std::string(group == groups().end() ? kOthers : group->heading);
}

}  // namespace flexarm::app
