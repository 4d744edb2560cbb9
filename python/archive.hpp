#pragma once

#include "arm/arm.hpp"
#include "effects/registry/entry.hpp"
#include "measured/modal/fitted_transfer.hpp"

#include <boost/preprocessor/repetition/enum_params.hpp>
#include <boost/preprocessor/repetition/repeat_from_to.hpp>

#include <array>
#include <complex>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <pybind11/pybind11.h>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace flexarm::python {

/// Bytes of a result, member by member, which the same version of flexarm reads back.
class ByteWriter {
 public:
  static constexpr bool kReads = false;
  void transfer(const void* from, std::size_t size) {
    bytes_.append(static_cast<const char*>(from), size);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

class ByteReader {
 public:
  static constexpr bool kReads = true;
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}
  /// Throws arm::InputError where less is left.
  void transfer(void* to, std::size_t size);

 private:
  std::string_view rest_;
};

namespace archive {

/// What is no aggregate: arms and effects are their TOML, entries of the library their definition.
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

/// Converts to any member of an aggregate; only its type is asked for.
struct Anything {
  template <class T>
  operator T() const;  // NOLINT: an implicit conversion is what it is for
};

/// The number of members of an aggregate.
template <class T, class... Found>
consteval std::size_t member_count() {
  if constexpr (requires { T{Found()..., Anything()}; }) {
    return member_count<T, Found..., Anything>();
  } else {
    return sizeof...(Found);
  }
}

/// Calls `each` with every member of an aggregate. Structured bindings of another number than that
/// of its members do not compile.
template <class T, class Each>
void for_each_member(T& object, const Each& each) {
  static_assert(std::is_aggregate_v<T>, "a type that no archive knows");
  constexpr std::size_t kCount = member_count<std::remove_const_t<T>>();
  static_assert(kCount <= 48, "an aggregate with more members than are counted");
  if constexpr (kCount == 0) {
    return;
  }
#define FLEXARM_MEMBERS(z, n, unused)                                   \
  else if constexpr (kCount == (n)) {                                   \
    auto& [BOOST_PP_ENUM_PARAMS(n, member)] = object;                   \
    const auto members = std::tie(BOOST_PP_ENUM_PARAMS(n, member));     \
    std::apply([&](auto&... member) { (each(member), ...); }, members); \
  }
  BOOST_PP_REPEAT_FROM_TO(1, 49, FLEXARM_MEMBERS, ~)
#undef FLEXARM_MEMBERS
}

template <class T>
inline constexpr bool kIsPlain = std::is_arithmetic_v<T> || std::is_enum_v<T>;
template <class T>
inline constexpr bool kIsPlain<std::complex<T>> = true;

template <class T>
inline constexpr bool kIsFunction = false;
template <class Signature>
inline constexpr bool kIsFunction<std::function<Signature>> = true;

/// What a fitted transfer function, which is no aggregate, is made of.
using PartsOfTransfer = std::tuple<measured::BlockSet, measured::SensorModel, Eigen::VectorXd>;

/// Writes an object, which is then const, or reads it.
template <class Archive, class Object>
void transfer(Archive& archive, Object& object) {
  using T = std::remove_const_t<Object>;
  constexpr bool kReads = Archive::kReads;
  const auto each = [&](auto& part) { transfer(archive, part); };
  /// The number of elements, written or read.
  const auto transfer_size = [&] {
    std::size_t size = 0;
    if constexpr (requires { object.size(); }) size = static_cast<std::size_t>(object.size());
    archive.transfer(&size, sizeof size);
    return size;
  };
  if constexpr (kIsPlain<T>) {
    archive.transfer(&object, sizeof object);
  } else if constexpr (kIsFunction<T>) {
    return;  // part of how something was asked for; what was read has none
  } else if constexpr (std::is_same_v<T, std::vector<bool>>) {
    std::vector<char> bits(object.begin(), object.end());
    transfer(archive, bits);
    if constexpr (kReads) object.assign(bits.begin(), bits.end());
  } else if constexpr (requires { text_of(object); }) {
    std::vector<char> characters;
    if constexpr (!kReads) {
      const std::string text = text_of(object);
      characters.assign(text.begin(), text.end());
    }
    transfer(archive, characters);
    if constexpr (kReads) set_from_text(object, {characters.begin(), characters.end()});
  } else if constexpr (requires { object.has_value(); }) {
    bool has_value = object.has_value();
    transfer(archive, has_value);
    if constexpr (kReads) {
      if (has_value) object.emplace();
    }
    if (has_value) transfer(archive, *object);
  } else if constexpr (requires { std::variant_size<T>::value; }) {
    std::size_t index = object.index();
    transfer(archive, index);
    if constexpr (kReads) {
      [&]<std::size_t... kPlaces>(std::index_sequence<kPlaces...>) {
        ((kPlaces == index ? void(object.template emplace<kPlaces>()) : void()), ...);
      }
      (std::make_index_sequence<std::variant_size_v<T>>());
    }
    std::visit(each, object);
  } else if constexpr (requires { std::tuple_size<T>::value; }) {
    std::apply([&](auto&... parts) { (each(parts), ...); }, object);
  } else if constexpr (requires { object.rows(); }) {
    std::ptrdiff_t rows = object.rows();
    std::ptrdiff_t columns = object.cols();
    transfer(archive, rows);
    transfer(archive, columns);
    if constexpr (kReads) object.resize(rows, columns);
    const auto size = static_cast<std::size_t>(rows * columns);
    archive.transfer(object.data(), size * sizeof(typename T::Scalar));
  } else if constexpr (requires { typename T::mapped_type; }) {
    std::size_t size = transfer_size();
    if constexpr (kReads) {
      for (; size > 0; --size) {
        std::pair<typename T::key_type, typename T::mapped_type> entry;
        transfer(archive, entry);
        object.insert(std::move(entry));
      }
    } else {
      for (const auto& [key, value] : object) {
        transfer(archive, key);
        transfer(archive, value);
      }
    }
  } else if constexpr (std::is_same_v<T, std::vector<measured::FittedTransfer>>) {
    std::vector<PartsOfTransfer> parts;
    if constexpr (!kReads) {
      for (const auto& one : object) parts.emplace_back(one.blocks(), one.model(), one.beta());
    }
    transfer(archive, parts);
    if constexpr (kReads) {
      for (auto& [blocks, model, beta] : parts) object.emplace_back(blocks, model, beta);
    }
  } else if constexpr (requires { typename T::value_type; }) {
    const std::size_t size = transfer_size();
    if constexpr (kReads) object.resize(size);
    if constexpr (kIsPlain<typename T::value_type>) {
      archive.transfer(object.data(), size * sizeof(typename T::value_type));
    } else {
      for (auto& element : object) transfer(archive, element);
    }
  } else {
    for_each_member(object, each);
  }
}

/// "flexarm VERSION CLASS", a line in front of the bytes.
std::string head_of(const std::type_info& type);

/// What is behind that line. Throws arm::InputError where another is there.
std::string_view without_head(std::string_view state, const std::string& head);

}  // namespace archive

template <class T>
void add_pickle_to(pybind11::class_<T> type) {
  namespace py = pybind11;
  const auto bytes_of = [](const T& self) {
    ByteWriter writer;
    archive::transfer(writer, self);
    return py::bytes(archive::head_of(typeid(T)) + writer.bytes());
  };
  type.def(py::pickle(bytes_of,
                      [](const py::bytes& state) {
                        ByteReader reader(archive::without_head(std::string_view(state),
                                                                archive::head_of(typeid(T))));
                        T made{};
                        archive::transfer(reader, made);
                        return made;
                      }))
      .def("__eq__",
           [bytes_of](const T& self, const py::object& other) {
             return py::isinstance<T>(other) &&
                    bytes_of(self).equal(bytes_of(other.cast<const T&>()));
           })
      .def("__hash__", [bytes_of](const T& self) { return py::hash(bytes_of(self)); });
}

/// Makes bound classes picklable, with `==` and a hash by what is pickled. The version that wrote a
/// pickle reads it; any other raises InputError.
template <class... Ts>
void add_pickle() {
  (add_pickle_to(pybind11::reinterpret_borrow<pybind11::class_<Ts>>(pybind11::type::of<Ts>())),
   ...);
}

}  // namespace flexarm::python
