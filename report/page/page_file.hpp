#pragma once

#include "report/page/page_document.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace flexarm::report::page {

/// The page without data, report/page/built/page.html: HTML, style and program in one text.
std::string_view built_page();

/// The page with a document: one file that opens without a network. The document's ids are made
/// unique. Throws as `page_texts`.
std::string page_html(PageDocument document);

}  // namespace flexarm::report::page
