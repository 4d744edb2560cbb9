#pragma once

#include "arm/arm.hpp"
#include "measured/files/modal_table.hpp"

#include <string>
#include <vector>

namespace flexarm::diagnose {

/// Gives the entries of a modal table that state no order the order of the arm's root that they
/// are (compare/root_numbering.hpp), and leaves out those that are none, and zeros on the real axis
/// or near it, which no antiresonance shows. Returns what was assigned and left out, a sentence
/// each.
std::vector<std::string> put_orders(const arm::Arm& arm, measured::ModalTable& table);

}  // namespace flexarm::diagnose
