#include "tests/fuzz/mutation.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace flexarm::fuzz {

namespace {

constexpr std::size_t kLargestInput_bytes = 1 << 15;
constexpr std::size_t kMostChanges = 5;
constexpr std::size_t kMostRepeats = 20;

constexpr std::string_view kDigits = "0123456789";

/// What stands in place of a number.
constexpr std::array<std::string_view, 16> kExtremes = {
    "0",    "-0.0", "-1",   "1e308",      "1e-320",     "1e400",      "nan",
    "-inf", "0x10", "\"\"", "2147483647", "2147483648", "4294967296", "99999999999999999999",
    "1,5",  ""};

/// Bytes that begin, end or separate something in one of the formats, or are no text.
constexpr char kSpecial[] = "\0\n\r\t \"'#,;.=[]{}()-+@\\\x7f\x80\x9b\xc2\xe2\xff";
constexpr std::string_view kSpecialBytes(kSpecial, sizeof(kSpecial) - 1);

}  // namespace

std::size_t Mutator::below(std::size_t count) {
  // std::uniform_int_distribution is not the same everywhere.
  return static_cast<std::size_t>(random_() % count);
}

void Mutator::change_byte(std::string& text) {
  if (text.empty()) return;
  char& byte = text[below(text.size())];
  switch (below(3)) {
    case 0:
      byte = static_cast<char>(static_cast<unsigned char>(byte) ^ (1U << below(8)));
      break;
    case 1:
      byte = static_cast<char>(below(256));
      break;
    default:
      byte = kSpecialBytes[below(kSpecialBytes.size())];
  }
}

void Mutator::remove_stretch(std::string& text) {
  if (text.empty()) return;
  const std::size_t begin = below(text.size());
  text.erase(begin, 1 + below(std::min<std::size_t>(text.size() - begin, 64)));
}

void Mutator::repeat_stretch(std::string& text) {
  if (text.empty()) return;
  const std::size_t begin = below(text.size());
  const std::string stretch =
      text.substr(begin, 1 + below(std::min<std::size_t>(text.size() - begin, 64)));
  const std::size_t place = below(text.size());
  for (std::size_t times = 1 + below(kMostRepeats); times > 0; --times) text.insert(place, stretch);
}

void Mutator::splice(std::string& text) {
  const std::string& other = seeds_[below(seeds_.size())];
  if (other.empty()) return;
  const std::size_t begin = below(other.size());
  text.insert(below(text.size() + 1), other, begin,
              1 + below(std::min<std::size_t>(other.size() - begin, 256)));
}

void Mutator::replace_number(std::string& text) {
  if (text.empty()) return;
  const std::size_t begin = text.find_first_of(kDigits, below(text.size()));
  if (begin == std::string::npos) return;
  const std::size_t end = std::min(text.find_first_not_of("0123456789.eE", begin), text.size());
  text.replace(begin, end - begin, kExtremes[below(kExtremes.size())]);
}

std::string Mutator::next() {
  std::string text = seeds_[below(seeds_.size())];
  for (std::size_t changes = 1 + below(kMostChanges); changes > 0; --changes) {
    switch (below(5)) {
      case 0:
        change_byte(text);
        break;
      case 1:
        remove_stretch(text);
        break;
      case 2:
        repeat_stretch(text);
        break;
      case 3:
        splice(text);
        break;
      default:
        replace_number(text);
    }
  }
  if (text.size() > kLargestInput_bytes) text.resize(kLargestInput_bytes);
  return text;
}

}  // namespace flexarm::fuzz
