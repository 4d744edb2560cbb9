#include "compare/paper/paper_topics.hpp"

namespace flexarm::compare::paper {

Findings check_paper() {
  return {.topics = {check_motion(), check_mode_shapes(), check_state_space(),
                     check_transfer_functions(), check_identification(), check_tables()},
          .cells = check_cells()};
}

}  // namespace flexarm::compare::paper
