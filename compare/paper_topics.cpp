#include "compare/paper_topics.hpp"

namespace flexarm::compare::paper {

std::vector<Topic> check_paper() {
  return {check_motion(),         check_mode_shapes(),
          check_state_space(),    check_transfer_functions(),
          check_identification(), check_tables()};
}

}  // namespace flexarm::compare::paper
