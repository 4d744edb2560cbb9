#include "compare/for_each_index.hpp"

#include <optional>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace flexarm::compare {

void for_each_index(std::size_t count, int threads, const std::function<void(std::size_t)>& visit) {
  // An arena alone is limited to the cores there are.
  std::optional<tbb::global_control> limit;
  if (threads > 0) {
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  }
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, visit); });
}

}  // namespace flexarm::compare
