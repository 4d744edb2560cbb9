#include "report/page/page_document.hpp"

#include <fmt/format.h>

#include <set>
#include <utility>

namespace flexarm::report::page {

namespace {

/// "strain@0.05" -> "strain-0-05".
std::string slug(const std::string& text) {
  std::string made;
  for (const char c : text) {
    const bool is_upper = c >= 'A' && c <= 'Z';
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (is_upper || is_plain) {
      made += is_upper ? static_cast<char>(c - 'A' + 'a') : c;
    } else if (!made.empty() && made.back() != '-') {
      made += '-';
    }
  }
  while (!made.empty() && made.back() == '-') made.pop_back();
  return made.empty() ? "part" : made;
}

}  // namespace

std::size_t count_of(const Numbers& numbers) {
  if (const auto* range = std::get_if<EvenRange>(&numbers)) return range->count;
  if (const auto* singles = std::get_if<std::vector<float>>(&numbers)) return singles->size();
  return std::get<std::vector<double>>(numbers).size();
}

Role numbered_role(std::size_t index) {
  constexpr std::array kRoles = {Role::first,  Role::second, Role::third,
                                 Role::fourth, Role::fifth,  Role::sixth};
  return kRoles[index % kRoles.size()];
}

const BlockHead& head_of(const Block& block) {
  return std::visit([](const auto& any) -> const BlockHead& { return any.head; }, block);
}

BlockHead& head_of(Block& block) {
  return std::visit([](auto& any) -> BlockHead& { return any.head; }, block);
}

void Section::add(Block block) {
  const bool is_shown = std::visit(
      [](const auto& any) {
        if constexpr (requires { any.views; }) {
          return !any.views.empty();
        } else if constexpr (requires { any.rows; }) {
          return !any.rows.empty();
        } else {
          return true;
        }
      },
      block);
  if (is_shown) blocks.push_back(std::move(block));
}

void PageDocument::add(Section section) {
  if (!section.is_empty()) sections.push_back(std::move(section));
}

void make_ids_unique(PageDocument& document) {
  std::set<std::string> taken;
  const auto settle = [&taken](std::string& id) {
    const std::string wanted = slug(id);
    id = wanted;
    for (int number = 2; !taken.insert(id).second; ++number) {
      id = fmt::format("{}-{}", wanted, number);
    }
  };
  if (document.headline) settle(head_of(*document.headline).id);
  for (Section& section : document.sections) {
    settle(section.id);
    for (Block& block : section.blocks) settle(head_of(block).id);
  }
}

}  // namespace flexarm::report::page
