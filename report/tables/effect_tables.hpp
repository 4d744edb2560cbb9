#pragma once

#include "effects/registry/entry.hpp"
#include "report/terminal.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace flexarm::report {

/// "`torque` [N m] 0 or more; `sensor`, optional", as the documents say it; without code marks for
/// a terminal.
std::string parameters_of(const arm::EffectDefinition& definition, bool markdown);

/// One line an effect for a terminal, by port.
std::string effect_list(const std::vector<effects::Entry>& entries,
                        std::size_t max_width = kPipeWidth);

/// All that is known of one effect, for a terminal.
std::string effect_page(const effects::Entry& entry, std::size_t max_width = kPipeWidth);

/// docs/effects.md: the ports, a table of all effects, a section each.
std::string effects_document(const std::vector<effects::Entry>& entries);

}  // namespace flexarm::report
