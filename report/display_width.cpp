#include "report/display_width.hpp"

#include <clocale>
#include <cwchar>
#include <locale.h>
#include <wchar.h>

namespace flexarm::report {
namespace {

/// The C library's own UTF-8 tables, whatever the user's locale is.
class Utf8Scope {
 public:
  Utf8Scope() : before_(uselocale(utf8())) {}
  ~Utf8Scope() { uselocale(before_); }
  Utf8Scope(const Utf8Scope&) = delete;
  Utf8Scope& operator=(const Utf8Scope&) = delete;

 private:
  static locale_t utf8() {
    static const locale_t locale = newlocale(LC_CTYPE_MASK, "C.UTF-8", locale_t{});
    return locale;
  }
  locale_t before_;
};

}  // namespace

std::size_t display_width(std::string_view text) {
  const Utf8Scope utf8;
  std::size_t width = 0;
  std::mbstate_t state{};
  while (!text.empty()) {
    wchar_t character = 0;
    std::size_t bytes = std::mbrtowc(&character, text.data(), text.size(), &state);
    if (bytes == 0 || bytes > text.size()) {  // a null, or -1 and -2: not UTF-8, cut short
      state = {};
      bytes = 1;
      ++width;
    } else {
      const int columns = ::wcwidth(character);
      width += columns < 0 ? 1 : static_cast<std::size_t>(columns);
    }
    text.remove_prefix(bytes);
  }
  return width;
}

}  // namespace flexarm::report
