#include "arm/input_error.hpp"
#include "measured/files/mat_levels.hpp"
#include "measured/files/mat_packing.hpp"
#include "measured/files/own_process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <hdf5.h>
#include <optional>
#include <utility>

namespace flexarm::measured {

namespace {

constexpr std::string_view kHdf5Signature("\x89HDF\r\n\x1a\n", 8);
/// What a file may hold when it is expanded, in doubles: as many as those of a compressed file of
/// level 5 (measured/files/mat_elements.cpp).
constexpr std::size_t kLeastNumbers = std::size_t{1} << 25U;
constexpr std::size_t kMostNumbers = std::size_t{1} << 27U;
/// Data sets and groups in all, and within each other; a reference may lead back to where it
/// stands.
constexpr std::size_t kMostObjects = std::size_t{1} << 18U;
constexpr int kDeepestObject = 16;
constexpr std::size_t kLongestClass = 255;

/// An identifier of the library, closed at the end.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  bool is_open() const { return id_ >= 0; }
  hid_t get() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

[[noreturn]] void damaged_hdf5(std::string_view what) {
  throw arm::InputError(fmt::format("is damaged: {}", what));
}

bool has_attribute(const Handle& object, const char* name) {
  return H5Aexists(object.get(), name) > 0;
}

/// The attribute MATLAB_class: "double", "struct", ...; empty where there is none.
std::string class_of(const Handle& object) {
  if (!has_attribute(object, "MATLAB_class")) return "";
  const Handle attribute(H5Aopen(object.get(), "MATLAB_class", H5P_DEFAULT), H5Aclose);
  const Handle stored(H5Aget_type(attribute.get()), H5Tclose);
  const std::size_t size = stored.is_open() ? H5Tget_size(stored.get()) : 0;
  const bool is_text = stored.is_open() && H5Tget_class(stored.get()) == H5T_STRING &&
                       H5Tis_variable_str(stored.get()) == 0;
  if (!is_text || size == 0 || size > kLongestClass) return "";
  std::array<char, kLongestClass + 1> text{};
  const Handle memory(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(memory.get(), size + 1);
  return H5Aread(attribute.get(), memory.get(), text.data()) < 0 ? "" : std::string(text.data());
}

/// Reads what groups and data sets hold; a variable of MATLAB is a data set of its transposed
/// array, or a group of fields; cells, and fields of several structures, are references
/// ("MAT-File Format", The MathWorks, "Version 7.3"; https://www.hdfgroup.org).
class Hdf5Reader {
 public:
  explicit Hdf5Reader(std::size_t file_bytes)
      : most_numbers_(std::clamp(file_bytes, kLeastNumbers, kMostNumbers)) {}

  MatContents read(const Handle& file) {
    const Handle root(H5Gopen2(file.get(), "/", H5P_DEFAULT), H5Gclose);
    if (!root.is_open()) damaged_hdf5("no root group");
    for (const auto& name : members_of(root)) {
      if (name.starts_with('#')) continue;  // what references lead to
      add(Handle(H5Oopen(root.get(), name.c_str(), H5P_DEFAULT), H5Oclose), name, 0);
    }
    return std::move(contents_);
  }

 private:
  void leave_out(const std::string& name, std::string_view what) {
    contents_.left_out.push_back(fmt::format("{}: {}", name, what));
  }

  /// Names of what stands in a group itself: a link to elsewhere is not followed.
  static std::vector<std::string> members_of(const Handle& group) {
    H5G_info_t info{};
    if (H5Gget_info(group.get(), &info) < 0) damaged_hdf5("a group");
    if (info.nlinks > kMostObjects) damaged_hdf5("a group of too many members");
    std::vector<std::string> names;
    for (hsize_t i = 0; i < info.nlinks; ++i) {
      std::array<char, 256> name{};
      const auto length = H5Lget_name_by_idx(group.get(), ".", H5_INDEX_NAME, H5_ITER_INC, i,
                                             name.data(), name.size(), H5P_DEFAULT);
      H5L_info_t link{};
      if (length < 0 || H5Lget_info(group.get(), name.data(), &link, H5P_DEFAULT) < 0) {
        damaged_hdf5("a name");
      }
      if (link.type == H5L_TYPE_HARD) names.emplace_back(name.data());
    }
    return names;
  }

  void count_object(int depth) {
    if (++objects_ > kMostObjects) {
      throw arm::InputError(
          fmt::format("holds more than {} arrays, cells and fields", kMostObjects));
    }
    if (depth > kDeepestObject) damaged_hdf5("structures within structures without end");
  }

  void add(const Handle& object, const std::string& name, int depth) {
    count_object(depth);
    if (!object.is_open()) damaged_hdf5("a variable that is not there");
    const std::string kind = class_of(object);
    const H5I_type_t type = H5Iget_type(object.get());
    if (has_attribute(object, "MATLAB_sparse")) {
      leave_out(name, "a sparse matrix");
    } else if (is_object(object, kind)) {
      add_object(name, kind, contents_);
    } else if (type == H5I_GROUP) {
      add_struct(object, name, depth);
    } else if (type == H5I_DATASET) {
      add_data_set(object, name, kind, depth);
    } else {
      leave_out(name, "neither numbers nor text");
    }
  }

  static bool is_object(const Handle& object, const std::string& kind) {
    constexpr std::array<std::string_view, 16> kKnown = {
        "",       "double", "single", "int8",    "uint8", "int16", "uint16", "int32",
        "uint32", "int64",  "uint64", "logical", "char",  "cell",  "struct", "canonical empty"};
    return std::ranges::count(kKnown, std::string_view(kind)) == 0 ||
           (has_attribute(object, "MATLAB_object_decode") && !kind.empty() && kind != "struct");
  }

  /// A structure; or several, of which each field is a list of references.
  void add_struct(const Handle& group, const std::string& name, int depth) {
    std::vector<std::pair<std::string, std::vector<hobj_ref_t>>> of_several;
    for (const auto& field : members_of(group)) {
      const Handle member(H5Oopen(group.get(), field.c_str(), H5P_DEFAULT), H5Oclose);
      if (member.is_open() && H5Iget_type(member.get()) == H5I_DATASET &&
          class_of(member).empty()) {
        if (auto references = references_in(member)) {
          of_several.emplace_back(field, std::move(*references));
          continue;
        }
      }
      add(member, fmt::format("{}.{}", name, field), depth + 1);
    }
    std::size_t elements = 0;
    for (const auto& [field, references] : of_several) {
      elements = std::max(elements, references.size());
    }
    for (std::size_t k = 0; k < elements; ++k) {
      for (const auto& [field, references] : of_several) {
        if (k >= references.size()) continue;
        add_referred(group, references[k],
                     fmt::format("{}.{}", struct_element_name(name, elements, k), field), depth);
      }
    }
  }

  void add_referred(const Handle& from, const hobj_ref_t& reference, const std::string& name,
                    int depth) {
    add(Handle(H5Rdereference2(from.get(), H5P_DEFAULT, H5R_OBJECT, &reference), H5Oclose), name,
        depth + 1);
  }

  /// Sizes in MATLAB's order, two or more.
  static std::vector<std::size_t> dimensions_of(const Handle& data_set) {
    const Handle space(H5Dget_space(data_set.get()), H5Sclose);
    std::array<hsize_t, H5S_MAX_RANK> sizes{};
    const int rank =
        space.is_open() ? H5Sget_simple_extent_dims(space.get(), sizes.data(), nullptr) : -1;
    if (rank < 0) damaged_hdf5("dimensions");
    if (H5Sget_simple_extent_type(space.get()) == H5S_NULL) return {0, 0};
    std::vector<std::size_t> dimensions(sizes.begin(), sizes.begin() + rank);
    std::ranges::reverse(dimensions);
    while (dimensions.size() < 2) dimensions.push_back(1);
    return dimensions;
  }

  /// The number of values, once it is known that there is room for them.
  std::size_t admitted(const std::vector<std::size_t>& dimensions) {
    std::size_t count = 1;
    for (const std::size_t size : dimensions) {
      if (size > 0 && count > most_numbers_ / size) count = most_numbers_ + 1;
      if (size == 0 || count <= most_numbers_) count *= size;
    }
    numbers_ += count;
    if (numbers_ > most_numbers_) {
      throw arm::InputError(
          fmt::format("holds more than {} numbers, which is the most that is read; "
                      "save fewer variables, or parts of them",
                      most_numbers_));
    }
    return count;
  }

  /// Whether the values are in this file, in pieces that fit.
  bool is_within_file(const Handle& data_set) const {
    const Handle creation(H5Dget_create_plist(data_set.get()), H5Pclose);
    if (!creation.is_open() || H5Pget_external_count(creation.get()) != 0) return false;
    const H5D_layout_t layout = H5Pget_layout(creation.get());
    if (layout != H5D_CHUNKED) return layout == H5D_CONTIGUOUS || layout == H5D_COMPACT;
    std::array<hsize_t, H5S_MAX_RANK> sizes{};
    const int rank = H5Pget_chunk(creation.get(), H5S_MAX_RANK, sizes.data());
    double values = rank < 0 ? -1.0 : 1.0;
    for (int i = 0; i < rank; ++i)
      values *= static_cast<double>(sizes[static_cast<std::size_t>(i)]);
    return values >= 0.0 && values <= static_cast<double>(most_numbers_);
  }

  template <class Value>
  std::vector<Value> values_of(const Handle& data_set, hid_t memory_type, std::size_t count) const {
    std::vector<Value> values(count);
    if (count == 0) return values;
    if (!is_within_file(data_set)) damaged_hdf5("an array that is not in the file");
    if (H5Dread(data_set.get(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
      damaged_hdf5("an array that cannot be read");
    }
    return values;
  }

  /// The references that a data set is made of; nothing where it is made of something else.
  std::optional<std::vector<hobj_ref_t>> references_in(const Handle& data_set) {
    const Handle type(H5Dget_type(data_set.get()), H5Tclose);
    if (!type.is_open() || H5Tequal(type.get(), H5T_STD_REF_OBJ) <= 0) return std::nullopt;
    return values_of<hobj_ref_t>(data_set, H5T_STD_REF_OBJ, admitted(dimensions_of(data_set)));
  }

  void add_data_set(const Handle& data_set, const std::string& name, const std::string& kind,
                    int depth) {
    auto dimensions = dimensions_of(data_set);
    // The sizes of an empty array stand in place of its values.
    if (has_attribute(data_set, "MATLAB_empty")) dimensions = {0, 0};
    if (const auto references = dimensions[0] == 0 ? std::nullopt : references_in(data_set)) {
      add_cells(data_set, *references, dimensions, name, depth);
      return;
    }
    const Handle type(H5Dget_type(data_set.get()), H5Tclose);
    const H5T_class_t stored = type.is_open() ? H5Tget_class(type.get()) : H5T_NO_CLASS;
    if (stored == H5T_COMPOUND && H5Tget_nmembers(type.get()) == 2) {
      add_complex(data_set, type, std::move(dimensions), name);
      return;
    }
    if (stored != H5T_INTEGER && stored != H5T_FLOAT && stored != H5T_ENUM) {
      if (dimensions[0] > 0) leave_out(name, "neither numbers nor text");
      return;
    }
    const std::size_t count = admitted(dimensions);
    MatNumbers numbers{std::move(dimensions), {}, {}};
    numbers.real = values_of<double>(data_set, H5T_NATIVE_DOUBLE, count);
    if (kind == "char") {
      const bool is_matrix = numbers.dimensions.size() == 2;
      add_text(name, numbers.real, is_matrix ? numbers.dimensions[0] : kMostTexts + 1, contents_);
    } else {
      add_numbers(name, std::move(numbers), contents_);
    }
  }

  /// A compound of the real and the imaginary part.
  void add_complex(const Handle& data_set, const Handle& type, std::vector<std::size_t> dimensions,
                   const std::string& name) {
    struct Parts {
      double real;
      double imaginary;
    };
    const Handle memory(H5Tcreate(H5T_COMPOUND, sizeof(Parts)), H5Tclose);
    for (unsigned i = 0; i < 2; ++i) {
      char* member = H5Tget_member_name(type.get(), i);
      const std::size_t offset = i == 0 ? offsetof(Parts, real) : offsetof(Parts, imaginary);
      if (member != nullptr) H5Tinsert(memory.get(), member, offset, H5T_NATIVE_DOUBLE);
      H5free_memory(member);
    }
    const std::size_t count = admitted(dimensions);
    MatNumbers numbers{std::move(dimensions), {}, {}};
    for (const auto& parts : values_of<Parts>(data_set, memory.get(), count)) {
      numbers.real.push_back(parts.real);
      numbers.imaginary.push_back(parts.imaginary);
    }
    add_numbers(name, std::move(numbers), contents_);
  }

  /// Cells; those of texts alone as one list.
  void add_cells(const Handle& data_set, const std::vector<hobj_ref_t>& references,
                 const std::vector<std::size_t>& dimensions, const std::string& name, int depth) {
    const std::size_t rows = dimensions[0];
    const std::size_t before = contents_.variables.size();
    const std::size_t left_out_before = contents_.left_out.size();
    for (std::size_t k = 0; k < references.size(); ++k) {
      add_referred(data_set, references[k], cell_name(name, rows, references.size() / rows, k),
                   depth);
    }
    const auto first = contents_.variables.begin() + static_cast<std::ptrdiff_t>(before);
    const bool are_texts =
        std::min(rows, references.size() / rows) == 1 &&
        contents_.left_out.size() == left_out_before &&
        contents_.variables.size() == before + references.size() &&
        std::all_of(first, contents_.variables.end(), [](const MatVariable& variable) {
          return std::holds_alternative<std::string>(variable.value);
        });
    if (!are_texts) return;
    MatStrings texts;
    for (auto each = first; each != contents_.variables.end(); ++each) {
      texts.push_back(std::move(std::get<std::string>(each->value)));
    }
    contents_.variables.erase(first, contents_.variables.end());
    contents_.variables.push_back({name, std::move(texts)});
  }

  std::size_t most_numbers_;
  std::size_t numbers_ = 0;
  std::size_t objects_ = 0;
  MatContents contents_{MatLevel::level73, {}, {}};
};

}  // namespace

bool is_hdf5(std::string_view bytes) {
  // Behind a block of the user's, of 512, 1024, 2048, ... bytes.
  if (bytes.starts_with(kHdf5Signature)) return true;
  for (std::size_t at = 512; at < bytes.size(); at *= 2) {
    if (bytes.substr(at).starts_with(kHdf5Signature)) return true;
  }
  return false;
}

bool is_level73(std::string_view bytes) {
  return bytes.starts_with("MATLAB 7.3 MAT-file") ||
         (is_hdf5(bytes) && bytes.find("MATLAB_class") != std::string_view::npos);
}

MatContents level73_contents(std::string_view bytes) {
  // The library trusts much of what a file says of itself.
  MatContents contents = unpacked_contents(in_own_process([&] {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    // A file in memory, by any name.
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    constexpr std::size_t kIncrement_bytes = std::size_t{1} << 16U;
    std::string image(bytes);  // the library takes it without const
    H5Pset_fapl_core(access.get(), kIncrement_bytes, 0);
    H5Pset_file_image(access.get(), image.data(), image.size());
    const Handle file(H5Fopen("log.mat", H5F_ACC_RDONLY, access.get()), H5Fclose);
    if (!file.is_open()) {
      throw arm::InputError("is cut off or damaged: no HDF5 file behind its head");
    }
    return packed_contents(Hdf5Reader(bytes.size()).read(file));
  }));
  contents.level = MatLevel::level73;
  return contents;
}

}  // namespace flexarm::measured
