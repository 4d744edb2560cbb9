#include "python/archive.hpp"

#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace flexarm::python {

void ByteReader::transfer(void* to, std::size_t size) {
  if (size > rest_.size()) throw arm::InputError("the state of a pickle ends too early");
  if (size > 0) std::memcpy(to, rest_.data(), size);
  rest_.remove_prefix(size);
}

namespace archive {

std::string text_of(const std::string& text) {
  return text;
}
std::string text_of(const std::filesystem::path& path) {
  return path.string();
}
std::string text_of(const arm::Arm& arm) {
  return measured::format_arm(arm);
}

std::string text_of(const arm::Effect& effect) {
  if (!effect.definition) return "";
  arm::Arm arm = arm::paper_arm();  // one that carries any effect
  arm.effects.emplace(effect.definition->name, effect);
  return measured::format_arm(arm);
}

std::string text_of(const std::shared_ptr<const effects::Entry>& entry) {
  if (!entry) return "";
  arm::Effect effect{.definition = entry->definition};
  for (const auto& parameter : entry->definition->parameters) {
    effect.parameters[parameter.name] = parameter.example;
  }
  return text_of(effect);
}

void set_from_text(std::string& object, const std::string& text) {
  object = text;
}
void set_from_text(std::filesystem::path& object, const std::string& text) {
  object = text;
}
void set_from_text(arm::Arm& object, const std::string& text) {
  object = measured::parse_arm(text, "<pickle>", effects::vocabulary());
}

void set_from_text(arm::Effect& object, const std::string& text) {
  if (text.empty()) return;
  arm::Arm arm;
  set_from_text(arm, text);
  object = arm.effects.begin()->second;
}

void set_from_text(std::shared_ptr<const effects::Entry>& object, const std::string& text) {
  arm::Effect effect;
  set_from_text(effect, text);
  if (!effect.definition) return;
  const auto known = std::ranges::find(effects::entries(), effect.definition->name,
                                       [](const auto& entry) { return entry.definition->name; });
  effects::Entry entry;
  entry.definition = effect.definition;
  if (known != effects::entries().end()) entry = *known;
  object = std::make_shared<const effects::Entry>(std::move(entry));
}

std::string head_of(const std::type_info& type) {
  return fmt::format("flexarm {} {}\n", FLEXARM_VERSION, type.name());
}

std::string_view without_head(std::string_view state, const std::string& head) {
  if (state.starts_with(head)) return state.substr(head.size());
  const std::string_view first_line = state.substr(0, state.find('\n'));
  throw arm::InputError(fmt::format("a pickle of {}; this is flexarm {}, which reads its own",
                                    arm::shown(first_line.substr(0, first_line.rfind(' '))),
                                    FLEXARM_VERSION));
}

}  // namespace archive
}  // namespace flexarm::python
