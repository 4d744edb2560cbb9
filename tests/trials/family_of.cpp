#include "tests/trials/family_of.hpp"

#include "effects/registry/vocabulary.hpp"

namespace flexarm::trials {

std::string_view family_of(const std::string& effect) {
  const effects::Entry* entry = effects::find(effect);
  return entry == nullptr ? std::string_view() : effects::to_string(entry->family);
}

}  // namespace flexarm::trials
