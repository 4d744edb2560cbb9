#include "python/arrays.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

namespace flexarm::python {

std::vector<double> one_dimensional(const Numbers& numbers, const char* argument) {
  if (numbers.ndim() != 1) {
    throw arm::InputError(fmt::format("{}: an array of {} dimensions; must be of 1", argument,
                                      static_cast<long>(numbers.ndim())));
  }
  return {numbers.data(), numbers.data() + numbers.size()};
}

}  // namespace flexarm::python
