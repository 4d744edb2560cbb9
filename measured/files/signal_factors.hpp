#pragma once

#include <string>
#include <string_view>

namespace flexarm::measured {

/// A sentence on the number at `path` of a structure, "tau.scale", that is by its name a scale or
/// an offset of the signal beside it: it is not applied. Empty for any other, for one of a file's
/// own, and for a scale of 1 or an offset of 0.
std::string unapplied_factor(std::string_view path, double value);

}  // namespace flexarm::measured
