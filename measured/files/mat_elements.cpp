#include "measured/files/mat_elements.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <zlib.h>

namespace flexarm::measured {

namespace {

using arm::InputError;
using std::string_view;

constexpr std::size_t kHeaderSize = 128;
constexpr std::size_t kTagSize = 8;
constexpr std::size_t kLargest_bytes = std::size_t{1} << 30U;
/// What a file may expand to in all: eight times its size, from this to `kLargest_bytes`. A
/// constant signal shrinks a thousandfold, so that a small file could fill the memory.
constexpr std::size_t kLeastBound_bytes = std::size_t{1} << 28U;
constexpr std::size_t kMostExpansion = 8;
/// Arrays in all, cells and fields of structures included, each of which the library keeps apart.
constexpr std::size_t kMostArrays = std::size_t{1} << 18U;
/// Structures within structures and cells, which a reader follows.
constexpr int kDeepest = 16;

/// Types of data elements.
enum Type : std::uint32_t {
  kInt8 = 1,
  kInt32 = 5,
  kUint32 = 6,
  kMatrix = 14,
  kCompressed = 15,
  kUtf8 = 16,
};

/// Bytes a number; 0 for what is none.
std::size_t size_of(std::uint32_t type) {
  switch (type) {
    case 1:  // int8
    case 2:  // uint8
    case kUtf8:
      return 1;
    case 3:   // int16
    case 4:   // uint16
    case 17:  // UTF-16
      return 2;
    case kInt32:
    case kUint32:
    case 7:   // single
    case 18:  // UTF-32
      return 4;
    case 9:   // double
    case 12:  // int64
    case 13:  // uint64
      return 8;
    default:
      return 0;
  }
}

/// Classes of arrays.
enum Class : std::uint32_t {
  kCell = 1,
  kStruct = 2,
  kObject = 3,
  kChar = 4,
  kSparse = 5,
  kDouble = 6,
  kUint64 = 15
};

struct Element {
  std::uint32_t type = 0;
  string_view data;
};

[[noreturn]] void damaged(string_view what) {
  throw InputError(fmt::format("is damaged: {}", what));
}

/// An array of a class that is left out, by what it is; of an object the name of its class.
struct LeftOut {
  std::string what;
  std::string object_class = {};
};

/// Passes over data elements one after the other.
class Walker {
 public:
  Walker(string_view bytes, bool little_endian) : bytes_(bytes), little_endian_(little_endian) {}

  bool at_end() const { return at_ >= bytes_.size(); }

  /// Elements are filled up to 8 bytes, but for compressed ones; one of 4 bytes or less may stand
  /// within its tag.
  Element next() {
    if (bytes_.size() - at_ < kTagSize) throw InputError("is cut off");
    const std::uint32_t first = number(at_);
    if (first >> 16U != 0) {
      const std::size_t size = first >> 16U;
      if (size > 4) damaged("a small element of more than 4 bytes");
      const Element element{first & 0xffffU, bytes_.substr(at_ + 4, size)};
      at_ += kTagSize;
      return element;
    }
    const std::size_t size = number(at_ + 4);
    if (size > bytes_.size() - at_ - kTagSize) throw InputError("is cut off");
    const Element element{first, bytes_.substr(at_ + kTagSize, size)};
    const std::size_t padded = first == kCompressed ? size : (size + 7) / 8 * 8;
    at_ = std::min(at_ + kTagSize + padded, bytes_.size());
    return element;
  }

  std::uint32_t number(std::size_t at) const { return number(bytes_, at); }
  std::uint32_t number(string_view bytes, std::size_t at) const {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t place = little_endian_ ? 3 - i : i;
      value = value << 8U | static_cast<unsigned char>(bytes[at + place]);
    }
    return value;
  }

  std::size_t place() const { return at_; }

 private:
  string_view bytes_;
  bool little_endian_;
  std::size_t at_ = 0;
};

/// What a file of that size may hold when it is expanded.
std::size_t most_bytes(std::size_t file_bytes) {
  return std::clamp(kMostExpansion * file_bytes, kLeastBound_bytes, kLargest_bytes);
}

/// Checks arrays and what they hold, and counts that of all of them.
class ArrayCheck {
 public:
  ArrayCheck(bool little_endian, std::size_t file_bytes)
      : little_endian_(little_endian),
        most_numbers_(std::max(most_bytes(file_bytes) / sizeof(double), file_bytes)) {}

  /// Throws InputError for one that is damaged, LeftOut for one of a class that is left out.
  /// `name` is told as soon as it is known.
  void check(string_view array, std::string& name, int depth = 0) {
    if (++arrays_ > kMostArrays) {
      throw InputError(fmt::format("holds more than {} arrays, cells and fields", kMostArrays));
    }
    if (array.empty()) return;  // an empty cell
    if (depth > kDeepest) damaged("structures within structures without end");
    Walker walker(array, little_endian_);
    const Element flags = walker.next();
    if (flags.type != kUint32 || flags.data.size() != 8) damaged("array flags");
    const std::uint32_t word = walker.number(flags.data, 0);
    const std::uint32_t kind = word & 0xffU;
    // An opaque array has names where others have dimensions: its own, "MCOS", that of its class.
    constexpr std::uint32_t kOpaque = 17;
    if (kind == kOpaque) {
      std::array<std::string, 3> names;
      for (auto& text : names) text = std::string(walker.next().data.substr(0, 255));
      if (depth == 0) name = names[0];
      throw LeftOut{"an object", names[2]};
    }
    const std::size_t count = product_of(walker.next(), walker);
    const Element label = walker.next();
    if (label.type != kInt8 || label.data.size() > 255) damaged("a name");
    name = std::string(label.data);
    if (kind == kCell) {
      for (std::size_t i = 0; i < count; ++i) check_nested(walker, depth);
    } else if (kind == kStruct) {
      check_struct(walker, count, depth);
    } else if (kind == kChar || (kind >= kDouble && kind <= kUint64)) {
      constexpr std::uint32_t kComplexFlag = 0x800;
      const bool is_complex = kind != kChar && (word & kComplexFlag) != 0;
      for (int part = 0; part < (is_complex ? 2 : 1); ++part) check_numbers(walker, count);
    } else if (kind == kObject) {
      throw LeftOut{"an object", std::string(walker.next().data.substr(0, 255))};
    } else {
      throw LeftOut{kind == kSparse ? "a sparse matrix" : "neither numbers nor text"};
    }
  }

 private:
  /// Elements of an array are so many that they fit in memory.
  static std::size_t product_of(const Element& dimensions, const Walker& walker) {
    const string_view data = dimensions.data;
    if (dimensions.type != kInt32 || data.size() < 8 || data.size() % 4 != 0 || data.size() > 128) {
      damaged("dimensions");
    }
    std::size_t product = 1;
    for (std::size_t at = 0; at < data.size(); at += 4) {
      const std::size_t size = walker.number(data, at);
      if (size > kLargest_bytes || (size > 0 && product > kLargest_bytes / size)) {
        damaged("dimensions that are too large");
      }
      product *= size;
    }
    return product;
  }

  void check_nested(Walker& walker, int depth) {
    const Element element = walker.next();
    if (element.type != kMatrix) damaged("a cell that holds no array");
    std::string ignored;
    check(element.data, ignored, depth + 1);
  }

  void check_struct(Walker& walker, std::size_t count, int depth) {
    const Element length = walker.next();
    if (length.type != kInt32 || length.data.size() != 4) damaged("names of fields");
    const std::size_t size = walker.number(length.data, 0);
    const Element names = walker.next();
    if (names.type != kInt8 || size == 0 || size > 255 || names.data.size() % size != 0) {
      damaged("names of fields");
    }
    // Names are as long, and ended by 0.
    for (std::size_t at = size; at <= names.data.size(); at += size) {
      if (names.data.substr(at - size, size).find('\0') == string_view::npos) {
        damaged("names of fields");
      }
    }
    const std::size_t fields = names.data.size() / size;
    for (std::size_t i = 0; i < count * fields; ++i) check_nested(walker, depth);
  }

  void check_numbers(Walker& walker, std::size_t count) {
    if (count == 0 && walker.at_end()) return;
    numbers_ += count;
    if (numbers_ > most_numbers_) {
      throw InputError(fmt::format("holds more than {} numbers", most_numbers_));
    }
    const Element numbers = walker.next();
    const std::size_t size = size_of(numbers.type);
    // UTF-8 has a byte or more a letter.
    const bool fits =
        numbers.type == kUtf8 ? numbers.data.size() >= count : numbers.data.size() == count * size;
    if (size == 0 || !fits) damaged("an array that is not as large as its dimensions say");
  }

  bool little_endian_;
  std::size_t most_numbers_;
  std::size_t numbers_ = 0;
  std::size_t arrays_ = 0;
};

struct EndInflation {
  void operator()(z_stream* stream) const { inflateEnd(stream); }
};

/// A compressed element, which says its size at its beginning; `room` bytes are left for it.
std::string inflated(string_view bytes, bool little_endian, std::size_t room) {
  const auto require_room = [room](std::size_t size) {
    if (size <= room) return;
    throw InputError(
        fmt::format("expands to {} bytes or more where {} may be; save it without compression, "
                    "with -v6",
                    size, room));
  };
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw InputError("cannot be expanded: out of memory");
  const std::unique_ptr<z_stream, EndInflation> end(&stream);
  std::string out;
  std::string block(std::size_t{1} << 16U, '\0');
  std::string input(bytes);  // the library takes it without const
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  int state = Z_OK;
  while (state == Z_OK) {
    stream.next_out = reinterpret_cast<Bytef*>(block.data());
    stream.avail_out = static_cast<uInt>(block.size());
    state = inflate(&stream, Z_NO_FLUSH);
    out.append(block, 0, block.size() - stream.avail_out);
    if (out.size() >= kTagSize && out.size() <= block.size()) {
      const std::size_t size = Walker(out, little_endian).number(4) + kTagSize;
      require_room(size);
      out.reserve(size);
    }
    require_room(out.size());
  }
  if (state != Z_STREAM_END) damaged("a compressed variable that does not expand");
  return out;
}

}  // namespace

MatElements sound_elements(string_view bytes) {
  if (bytes.size() < kHeaderSize) throw InputError("is cut off");
  const string_view order = bytes.substr(kHeaderSize - 2, 2);
  if (order != "IM" && order != "MI") damaged("no byte order");
  const bool little_endian = order == "IM";
  ArrayCheck checker(little_endian, bytes.size());
  std::size_t room = most_bytes(bytes.size());
  MatElements sound{std::string(bytes.substr(0, kHeaderSize)), {}, {}};
  Walker walker(bytes.substr(kHeaderSize), little_endian);
  while (!walker.at_end()) {
    const std::size_t begin = walker.place();
    Element element = walker.next();
    std::string expanded;
    string_view whole = bytes.substr(kHeaderSize + begin, walker.place() - begin);
    if (element.type == kCompressed) {
      expanded = inflated(element.data, little_endian, room);
      Walker inner(expanded, little_endian);
      element = inner.next();
      expanded.resize(inner.place());
      room -= expanded.size();
      whole = expanded;
    }
    if (element.type != kMatrix) damaged("a variable that is no array");
    std::string name;
    try {
      checker.check(element.data, name);
      if (!element.data.empty()) sound.file += whole;
    } catch (const LeftOut& one) {
      if (one.object_class.empty()) {
        sound.left_out.push_back(fmt::format("{}: {}", name, one.what));
      } else {
        sound.objects.push_back({name, one.object_class});
      }
    }
  }
  return sound;
}

}  // namespace flexarm::measured
