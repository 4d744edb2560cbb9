#pragma once

#include "compare/paper/paper_topics.hpp"

#include <string>

namespace flexarm::report {

/// A Markdown document with its marked blocks made anew. A block runs from the line
/// `<!-- flexarm paper: NAME -->` to the next line `<!-- end -->`; NAME is a topic's name,
/// `overview` or `cells`. Text outside the blocks is kept. Throws arm::InputError for an unknown
/// name, for a block without an end and for a document without a block.
std::string updated_paper_document(const std::string& document,
                                   const compare::paper::Findings& findings);

/// What stands in one block.
std::string paper_block(const compare::paper::Findings& findings, const std::string& name);

}  // namespace flexarm::report
