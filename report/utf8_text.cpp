#include "report/utf8_text.hpp"

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

/// Calls `visit(bytes, columns)` for each character; `columns` < 0 when it cannot be shown.
template <class Visit>
void for_each_character(std::string_view text, Visit visit) {
  const Utf8Scope utf8;
  while (!text.empty()) {
    wchar_t character = 0;
    mbstate_t state{};
    std::size_t bytes = mbrtowc(&character, text.data(), text.size(), &state);
    const bool valid = bytes != 0 && bytes <= text.size();  // else a null, -1 or -2
    if (!valid) bytes = 1;
    visit(text.substr(0, bytes), valid ? wcwidth(character) : -1);
    text.remove_prefix(bytes);
  }
}

}  // namespace

std::size_t display_width(std::string_view text) {
  std::size_t width = 0;
  for_each_character(text, [&](std::string_view, int columns) {
    width += columns < 0 ? 1 : static_cast<std::size_t>(columns);
  });
  return width;
}

std::string printable(std::string_view text) {
  std::string shown;
  for_each_character(text, [&](std::string_view bytes, int columns) {
    shown += columns >= 0 || bytes == "\n" ? bytes : "\uFFFD";
  });
  return shown;
}

}  // namespace flexarm::report
