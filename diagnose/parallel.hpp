#pragma once

#include <cstddef>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

namespace flexarm::diagnose {

/// `work(i)` for i from 0 to before `count`, many at a time, also within such work. All of it is
/// done, or an exception of it passes through. A thread that waits for the last of it takes up none
/// of the other work that goes on: its stack would grow with each.
template <class Work>
void in_parallel(std::size_t count, const Work& work) {
  // Bound to the work around it, it would end without a word where that is cancelled.
  tbb::task_group_context context(tbb::task_group_context::isolated);
  tbb::this_task_arena::isolate([&] { tbb::parallel_for(std::size_t{0}, count, work, context); });
}

}  // namespace flexarm::diagnose
