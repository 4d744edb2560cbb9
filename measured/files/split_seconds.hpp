#pragma once

#include "measured/files/foreign_table.hpp"

namespace flexarm::measured {

/// Adds milliseconds, and microseconds, that stand in columns of their own (`ms`, `Millisecond`) to
/// the only time of whole seconds, takes these columns out and says so. A column that never falls
/// while seconds both repeat and change counts on its own, and stays.
void complete_whole_seconds(ForeignTable& table);

}  // namespace flexarm::measured
