#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flexarm::measured {

using KeyValues = std::vector<std::pair<std::string, std::string>>;

/// "KEY=VALUE,KEY=VALUE", in their order. Throws InputError for a key given twice, and "PART: must
/// be `allowed`" for a part without an equals sign.
KeyValues read_key_values(std::string_view text, std::string_view allowed);

}  // namespace flexarm::measured
