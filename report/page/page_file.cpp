#include "report/page/page_file.hpp"

#include "report/page/page_json.hpp"
#include "report/xml_text.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace flexarm::report::page {

namespace {

/// Behind the opening tag of the script element with that id.
std::size_t inside_element(std::string_view html, std::string_view id) {
  const std::size_t at = html.find(fmt::format("id=\"{}\"></script>", id));
  if (at == std::string_view::npos) {
    throw std::logic_error(fmt::format("page.html has no empty element \"{}\"", id));
  }
  return html.find('>', at) + 1;
}

}  // namespace

std::string page_html(PageDocument document) {
  make_ids_unique(document);
  const auto [json, arrays] = page_texts(document);
  std::string html(built_page());
  html.reserve(html.size() + json.size() + arrays.size() + document.title.size());
  // From the end on: what stands before keeps its place.
  std::pair<std::size_t, const std::string*> first = {inside_element(html, "document"), &json};
  std::pair<std::size_t, const std::string*> second = {inside_element(html, "arrays"), &arrays};
  if (second.first < first.first) std::swap(first, second);
  html.insert(second.first, *second.second);
  html.insert(first.first, *first.second);
  constexpr std::string_view kTitle = "<title>";
  if (const std::size_t from = html.find(kTitle); from != std::string::npos) {
    const std::size_t begin = from + kTitle.size();
    html.replace(begin, html.find("</title>", begin) - begin, xml_escaped(document.title));
  }
  return html;
}

}  // namespace flexarm::report::page
