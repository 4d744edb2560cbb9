#pragma once

#include <cstddef>
#include <functional>

namespace flexarm::compare {

/// Calls visit(0) to visit(count - 1), each once, from `threads` threads; 0: one a core. What visit
/// throws ends the work and is thrown on.
void for_each_index(std::size_t count, int threads, const std::function<void(std::size_t)>& visit);

}  // namespace flexarm::compare
