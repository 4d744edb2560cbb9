#pragma once

#include <functional>
#include <string>

namespace flexarm::measured {

/// What `read` returns, called in a process of its own: for a library that a damaged file can
/// crash. Throws InputError as `read` does, and "is damaged: ..." where the process ends in another
/// way or needs more than 120 s of processor; std::system_error where there is no process to be
/// had.
std::string in_own_process(const std::function<std::string()>& read);

}  // namespace flexarm::measured
