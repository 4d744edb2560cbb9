#include "export/fmu/zip_archive.hpp"

#include <fmt/format.h>

#include <memory>
#include <stdexcept>
#include <zip.h>

namespace flexarm::fmu {

namespace {

/// 1 January 1980 in the form of DOS.
constexpr zip_uint16_t kFirstDate = (1U << 5U) | 1U;
constexpr zip_uint16_t kMidnight = 0;
/// A regular file that everybody may read, as st_mode, in the upper half.
constexpr zip_uint32_t kReadableFile = 0100644U << 16U;
/// zlib's own choice between time and size.
constexpr zip_uint32_t kCompression = 6;

[[noreturn]] void fail(const char* reason) {
  throw std::runtime_error(fmt::format("ZIP archive: {}", reason));
}

struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
  void operator()(zip_source_t* source) const { zip_source_free(source); }
};

void add(zip_t* archive, const measured::NamedContent& file) {
  zip_source_t* content = zip_source_buffer(archive, file.content.data(), file.content.size(), 0);
  if (content == nullptr) fail(zip_strerror(archive));
  const zip_int64_t index = zip_file_add(archive, file.name.c_str(), content, ZIP_FL_ENC_UTF_8);
  if (index < 0) {
    zip_source_free(content);
    fail(zip_strerror(archive));
  }
  const auto at = static_cast<zip_uint64_t>(index);
  if (zip_set_file_compression(archive, at, ZIP_CM_DEFLATE, kCompression) != 0 ||
      zip_file_set_dostime(archive, at, kMidnight, kFirstDate, 0) != 0 ||
      zip_file_set_external_attributes(archive, at, 0, ZIP_OPSYS_UNIX, kReadableFile) != 0) {
    fail(zip_strerror(archive));
  }
}

/// All that the source has.
std::string read_all(zip_source_t* source) {
  zip_stat_t size;
  if (zip_source_stat(source, &size) != 0 || zip_source_open(source) != 0) {
    fail(zip_error_strerror(zip_source_error(source)));
  }
  std::string made(size.size, '\0');
  const zip_int64_t read = zip_source_read(source, made.data(), made.size());
  zip_source_close(source);
  if (read != static_cast<zip_int64_t>(made.size())) fail("cannot be read back");
  return made;
}

}  // namespace

std::string zip_archive(std::span<const measured::NamedContent> files) {
  zip_error_t error;
  zip_error_init(&error);
  const std::unique_ptr<zip_source_t, Discard> memory(
      zip_source_buffer_create(nullptr, 0, 0, &error));
  if (memory == nullptr) fail(zip_error_strerror(&error));
  std::unique_ptr<zip_t, Discard> archive(
      zip_open_from_source(memory.get(), ZIP_CREATE | ZIP_TRUNCATE, &error));
  if (archive == nullptr) fail(zip_error_strerror(&error));
  zip_source_keep(memory.get());  // the archive frees its own reference
  for (const measured::NamedContent& file : files) add(archive.get(), file);
  if (zip_close(archive.get()) != 0) fail(zip_strerror(archive.get()));
  archive.release();  // closing has freed it
  return read_all(memory.get());
}

}  // namespace flexarm::fmu
