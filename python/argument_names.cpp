#include "python/argument_names.hpp"

#include <algorithm>
#include <map>

namespace flexarm::python {

std::string as_argument(std::string_view option) {
  static const std::map<std::string_view, std::string> others = {
      {"duration", "duration_s"},
      {"overlap", "overlap_percent"},
      {"order", "highest_order"},
      {"payload-inertia", "payload_inertia_kg_m2"},
      {"payload-mass", "payload_mass_kg"},
      {"period", "sample_time_s"},
      {"resolution", "resolution_Hz"},
      {"run", "runs"},
      {"sensor", "sensors"},
      {"time-limit", "time_limit_s"},
      {"total-inertia", "total_inertia_kg_m2"},
  };
  if (const auto found = others.find(option); found != others.end()) return found->second;
  std::string name(option);
  std::ranges::replace(name, '-', '_');
  return name;
}

}  // namespace flexarm::python
