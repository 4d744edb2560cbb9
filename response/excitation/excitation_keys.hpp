#pragma once

#include "response/excitation/excitation.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace flexarm::response {

/// One number of an excitation, as a command line or a report has it.
struct ExcitationKey {
  std::string name;   ///< "amplitude"
  std::string unit;   ///< "N m"; empty for a count or a word
  std::string value;  ///< "0.3"; a number so that it reads back to the same double
};

/// The names that `excitation_of` takes.
const std::vector<std::string>& excitation_names();

/// The excitation of that name with its defaults. Throws InputError for an unknown one, with the
/// name that was probably meant, which may be one of `further`.
Excitation excitation_of(std::string_view name, const std::vector<std::string>& further = {});

/// Its numbers, in the order of its members.
std::vector<ExcitationKey> keys_of(const Excitation& excitation);

/// Sets one number. Throws InputError for a name that the excitation does not have, with `further`
/// among those allowed, and for a value that is no such number.
void set_key(Excitation& excitation, std::string_view name, std::string_view value,
             const std::vector<std::string>& further = {});

/// "bang-bang, amplitude 0.3 N m, pulse 0.3 s, ..."
std::string describe(std::string_view excitation, const std::vector<ExcitationKey>& keys);

}  // namespace flexarm::response
