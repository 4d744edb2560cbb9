#pragma once

#include "compare/paper/paper_topics.hpp"

namespace flexarm::compare::paper {

/// Computed once a program.
inline const Findings& findings() {
  static const Findings all = check_paper();
  return all;
}

}  // namespace flexarm::compare::paper
