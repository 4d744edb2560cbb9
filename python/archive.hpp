#pragma once

#include "arm/arm.hpp"
#include "effects/registry/entry.hpp"

#include <Eigen/Core>

#include <array>
#include <boost/preprocessor/repetition/enum_params.hpp>
#include <boost/preprocessor/repetition/repeat_from_to.hpp>
#include <complex>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <pybind11/pybind11.h>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace flexarm::python {

/// Bytes of a result, which the same version of flexarm reads back.
class ByteWriter {
 public:
  static constexpr bool kReads = false;
  void transfer(const void* from, std::size_t size) {
    bytes_.append(static_cast<const char*>(from), size);
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class ByteReader {
 public:
  static constexpr bool kReads = true;
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}
  /// Throws arm::InputError where less is left.
  void transfer(void* to, std::size_t size);
  std::size_t left() const { return rest_.size(); }

 private:
  std::string_view rest_;
};

namespace archive {

/// Converts to any member of an aggregate; only its type is asked for.
struct Anything {
  template <class T>
  operator T() const;  // NOLINT: an implicit conversion is what it is for
};

/// Members of an aggregate.
template <class T, class... Found>
consteval std::size_t member_count() {
  if constexpr (requires { T{Found()..., Anything()}; }) {
    return member_count<T, Found..., Anything>();
  } else {
    return sizeof...(Found);
  }
}

/// Calls `each` with all members of an aggregate. Structured bindings of another number than that
/// of its members do not compile.
template <class T, class Each>
void visit_members(T& object, const Each& each) {
  constexpr std::size_t kCount = member_count<std::remove_const_t<T>>();
  static_assert(kCount <= 48, "an aggregate with more members than are counted");
  if constexpr (kCount == 0) {
    return;
  }
#define FLEXARM_MEMBERS(z, n, unused)                \
  else if constexpr (kCount == n) {                  \
    auto& [BOOST_PP_ENUM_PARAMS(n, member)] = object; \
    each(BOOST_PP_ENUM_PARAMS(n, member));           \
  }
  BOOST_PP_REPEAT_FROM_TO(1, 49, FLEXARM_MEMBERS, ~)
#undef FLEXARM_MEMBERS
}

template <class T>
inline constexpr bool kIsPlain = std::is_arithmetic_v<T> || std::is_enum_v<T>;
template <class T>
inline constexpr bool kIsPlain<std::complex<T>> = true;

/// What has no structure that `visit_members` could know. Arms and effects are their TOML, and
/// entries of the library their names.
template <class Archive, class T>
void transfer_text(Archive& archive, T& object);
std::string text_of(const std::string& text);
std::string text_of(const std::filesystem::path& path);
std::string text_of(const arm::Arm& arm);
std::string text_of(const arm::Effect& effect);
std::string text_of(const std::shared_ptr<const effects::Entry>& entry);
void set_from_text(std::string& object, const std::string& text);
void set_from_text(std::filesystem::path& object, const std::string& text);
void set_from_text(arm::Arm& object, const std::string& text);
void set_from_text(arm::Effect& object, const std::string& text);
void set_from_text(std::shared_ptr<const effects::Entry>& object, const std::string& text);

template <class T>
inline constexpr bool kIsText =
    std::is_same_v<T, std::string> || std::is_same_v<T, std::filesystem::path> ||
    std::is_same_v<T, arm::Arm> || std::is_same_v<T, arm::Effect> ||
    std::is_same_v<T, std::shared_ptr<const effects::Entry>>;

/// Everything else.
template <class T>
struct Transfer {
  static_assert(std::is_aggregate_v<T>, "a type that no archive knows");
  template <class Archive, class Object>
  static void of(Archive& archive, Object& object);
};

template <class Archive, class Object>
void transfer(Archive& archive, Object& object) {
  using T = std::remove_const_t<Object>;
  if constexpr (kIsPlain<T>) {
    archive.transfer(&object, sizeof object);
  } else if constexpr (kIsText<T>) {
    transfer_text(archive, object);
  } else {
    Transfer<T>::of(archive, object);
  }
}

/// The number of elements, written or read.
template <class Archive, class Container>
std::size_t transfer_size(Archive& archive, const Container& container) {
  std::size_t size = container.size();
  archive.transfer(&size, sizeof size);
  return size;
}

template <class Archive, class T>
void transfer_text(Archive& archive, T& object) {
  std::string text;
  if constexpr (!Archive::kReads) text = text_of(object);
  const std::size_t size = transfer_size(archive, text);
  if constexpr (Archive::kReads) {
    if (size > archive.left()) archive.transfer(nullptr, size);  // throws
    text.resize(size);
  }
  archive.transfer(text.data(), size);
  if constexpr (Archive::kReads) set_from_text(object, text);
}

template <class T>
template <class Archive, class Object>
void Transfer<T>::of(Archive& archive, Object& object) {
  visit_members(object, [&](auto&... members) { (transfer(archive, members), ...); });
}

template <class T>
struct Transfer<std::vector<T>> {
  template <class Archive, class Object>
  static void of(Archive& archive, Object& object) {
    const std::size_t size = transfer_size(archive, object);
    if constexpr (Archive::kReads) {
      if (size > archive.left()) archive.transfer(nullptr, size);  // throws: a byte each at least
      object.resize(size);
    }
    if constexpr (std::is_same_v<T, bool>) {
      for (std::size_t i = 0; i < size; ++i) {
        bool value = object[i];
        transfer(archive, value);
        if constexpr (Archive::kReads) object[i] = value;
      }
    } else if constexpr (kIsPlain<T>) {
      archive.transfer(object.data(), size * sizeof(T));
    } else {
      for (auto& element : object) transfer(archive, element);
    }
  }
};

template <class T, std::size_t kSize>
struct Transfer<std::array<T, kSize>> {
  template <class Archive, class Object>
  static void of(Archive& archive, Object& object) {
    for (auto& element : object) transfer(archive, element);
  }
};

template <class First, class Second>
struct Transfer<std::pair<First, Second>> {
  template <class Archive, class Object>
  static void of(Archive& archive, Object& object) {
    transfer(archive, object.first);
    transfer(archive, object.second);
  }
};

template <class Key, class Value>
struct Transfer<std::map<Key, Value>> {
  template <class Archive, class Object>
  static void of(Archive& archive, Object& object) {
    std::size_t size = transfer_size(archive, object);
    if constexpr (Archive::kReads) {
      for (; size > 0; --size) {
        std::pair<Key, Value> entry;
        transfer(archive, entry);
        object.insert(std::move(entry));
      }
    } else {
      for (const auto& entry : object) transfer(archive, entry);
    }
  }
};

template <class Key, class Value>
struct Transfer<std::pair<const Key, Value>> : Transfer<std::pair<Key, Value>> {};

template <class T>
struct Transfer<std::optional<T>> {
  template <class Archive, class Object>
  static void of(Archive& archive, Object& object) {
    bool has_value = object.has_value();
    transfer(archive, has_value);
    if (!has_value) return;
    if constexpr (Archive::kReads) object.emplace();
    transfer(archive, *object);
  }
};

template <class... Ts>
struct Transfer<std::variant<Ts...>> {
  template <class Archive, class Object>
  static void of(Archive& archive, Object& object) {
    std::size_t index = object.index();
    transfer(archive, index);
    if constexpr (Archive::kReads) {
      std::size_t i = 0;
      ((i++ == index ? void(object.template emplace<Ts>()) : void()), ...);
    }
    std::visit([&](auto& value) { transfer(archive, value); }, object);
  }
};

template <>
struct Transfer<std::monostate> {
  template <class Archive, class Object>
  static void of(Archive&, Object&) {}
};

template <class Scalar, int kRows, int kColumns, int kOptions, int kMostRows, int kMostColumns>
struct Transfer<Eigen::Matrix<Scalar, kRows, kColumns, kOptions, kMostRows, kMostColumns>> {
  template <class Archive, class Object>
  static void of(Archive& archive, Object& object) {
    std::array<Eigen::Index, 2> size = {object.rows(), object.cols()};
    transfer(archive, size);
    if constexpr (Archive::kReads) {
      const auto bytes = static_cast<std::size_t>(size[0] * size[1]) * sizeof(Scalar);
      if (bytes > archive.left()) archive.transfer(nullptr, bytes);  // throws
      object.resize(size[0], size[1]);
    }
    archive.transfer(object.data(), static_cast<std::size_t>(object.size()) * sizeof(Scalar));
  }
};

/// A function is part of how something was asked for; what was read has none.
template <class Signature>
struct Transfer<std::function<Signature>> {
  template <class Archive, class Object>
  static void of(Archive&, Object&) {}
};

/// Throws arm::InputError unless the state begins with `head`; returns what is behind it.
std::string_view without_head(std::string_view state, std::string_view head);

/// "flexarm VERSION CLASS": what a state begins with.
std::string head_of(const std::type_info& type);

}  // namespace archive

/// Makes a class picklable, member by member. The state is read by the version that wrote it; any
/// other raises InputError.
template <class T>
auto pickled() {
  return pybind11::pickle(
      [](const T& self) {
        ByteWriter writer;
        archive::transfer(writer, self);
        return pybind11::bytes(archive::head_of(typeid(T)) + writer.take());
      },
      [](const pybind11::bytes& state) {
        ByteReader reader(
            archive::without_head(std::string_view(state), archive::head_of(typeid(T))));
        T made{};
        archive::transfer(reader, made);
        return made;
      });
}

}  // namespace flexarm::python
