#include "measured/files/mat_packing.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace flexarm::measured {

namespace {

enum class PackedKind : std::uint64_t { real, complex, text, texts };

class Packer {
 public:
  std::string bytes;

  void add(std::uint64_t number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  void add(const std::string& text) {
    add(std::uint64_t{text.size()});
    bytes += text;
  }
  void add(const MatStrings& texts) {
    add(std::uint64_t{texts.size()});
    for (const auto& text : texts) add(text);
  }
  template <class T>
  void add(const MatArray<T>& matrix) {
    add(std::uint64_t{matrix.rows});
    add(std::uint64_t{matrix.columns});
    bytes.append(reinterpret_cast<const char*>(matrix.values.data()),
                 matrix.values.size() * sizeof(T));
  }
};

class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : rest_(bytes) {}

  std::uint64_t number() {
    std::uint64_t value = 0;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string text() { return std::string(take(number())); }
  MatStrings texts() {
    MatStrings list(number());
    for (auto& one : list) one = text();
    return list;
  }
  template <class T>
  MatArray<T> matrix() {
    MatArray<T> made;
    made.rows = number();
    made.columns = number();
    made.values.resize(made.rows * made.columns);
    const std::size_t size = made.values.size() * sizeof(T);
    if (size > 0) std::memcpy(made.values.data(), take(size).data(), size);
    return made;
  }

 private:
  std::string_view take(std::size_t size) {
    if (size > rest_.size()) throw std::logic_error("packed contents are cut off");
    const std::string_view part = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return part;
  }

  std::string_view rest_;
};

}  // namespace

std::string packed_contents(const MatContents& contents) {
  Packer packer;
  packer.add(contents.left_out);
  packer.add(std::uint64_t{contents.variables.size()});
  for (const auto& variable : contents.variables) {
    packer.add(variable.name);
    const auto add = [&](PackedKind kind, const auto& value) {
      packer.add(static_cast<std::uint64_t>(kind));
      packer.add(value);
    };
    if (const auto* real = std::get_if<MatMatrix>(&variable.value)) {
      add(PackedKind::real, *real);
    } else if (const auto* complex = std::get_if<MatComplexMatrix>(&variable.value)) {
      add(PackedKind::complex, *complex);
    } else if (const auto* text = std::get_if<std::string>(&variable.value)) {
      add(PackedKind::text, *text);
    } else {
      add(PackedKind::texts, std::get<MatStrings>(variable.value));
    }
  }
  return std::move(packer.bytes);
}

MatContents unpacked_contents(std::string_view bytes) {
  Unpacker unpacker(bytes);
  MatContents contents;
  contents.left_out = unpacker.texts();
  for (std::uint64_t count = unpacker.number(); count > 0; --count) {
    MatVariable variable{unpacker.text(), {}};
    switch (static_cast<PackedKind>(unpacker.number())) {
      case PackedKind::real:
        variable.value = unpacker.matrix<double>();
        break;
      case PackedKind::complex:
        variable.value = unpacker.matrix<std::complex<double>>();
        break;
      case PackedKind::text:
        variable.value = unpacker.text();
        break;
      case PackedKind::texts:
        variable.value = unpacker.texts();
        break;
    }
    contents.variables.push_back(std::move(variable));
  }
  return contents;
}

}  // namespace flexarm::measured
