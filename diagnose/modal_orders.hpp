#pragma once

#include "arm/arm.hpp"
#include "measured/files/modal_table.hpp"

#include <string>
#include <vector>

namespace flexarm::diagnose {

/// Gives the entries of a modal table that state no order the order of the arm's root that they
/// are (compare/root_numbering.hpp), counted as `predict_roots` counts, and leaves out those that
/// are none. Returns what was assigned and left out, a sentence each; none where all orders are
/// stated.
std::vector<std::string> put_orders(const arm::Arm& arm, measured::ModalTable& table);

}  // namespace flexarm::diagnose
