#pragma once

#include <string>

namespace flexarm::report::page {

/// Where a page comes from.
struct PageOrigin {
  std::string program;  ///< "flexarm 0.1.0"
  std::string command;  ///< the command line
  std::string subject;  ///< what the report is of: "bench/measurement.toml"
};

}  // namespace flexarm::report::page
