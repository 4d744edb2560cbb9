#pragma once

#include <functional>
#include <stdexcept>
#include <string_view>

namespace flexarm::fuzz {

/// A reader did what its contract excludes. No std::exception of a reader is one.
class Finding : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Throws Finding unless the text may be shown to a user: one line of UTF-8 without control
/// characters, those of U+0080 to U+009F included, which terminals obey as well.
void require_clean_line(std::string_view text);

/// Runs `read`, which returns or throws an InputError with a clean line; whether it returned.
/// Throws Finding for an unclean line and for any other exception.
bool returns_or_refuses(const std::function<void()>& read);

/// Throws Finding with `what` unless `holds`.
void require(bool holds, const char* what);

}  // namespace flexarm::fuzz
