#pragma once

#include <array>
#include <csignal>
#include <filesystem>
#include <string>
#include <string_view>
#include <sys/stat.h>

namespace flexarm::measured {

/// Holds off the signals that end a program, SIGINT, SIGTERM and SIGHUP, until it is destroyed. A
/// mask would hold them off in this thread only, and libraries start threads of their own; so a
/// handler records the signal, and the destructor raises it again under the handler that was there
/// before. Handlers belong to the whole program: one at a time, and not one within another.
class SignalsHeldOff {
 public:
  SignalsHeldOff();
  ~SignalsHeldOff();
  SignalsHeldOff(const SignalsHeldOff&) = delete;
  SignalsHeldOff& operator=(const SignalsHeldOff&) = delete;

 private:
  std::array<struct sigaction, 3> previous_ = {};
};

/// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  ~Descriptor();
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int get() const { return descriptor_; }
  bool is_open() const { return descriptor_ >= 0; }
  /// 0, or the error that closing reports (a network file system's last word).
  int close();

 private:
  int descriptor_;
};

/// 0, or the errno of the write that failed.
int write_all(int descriptor, std::string_view content);

/// Creates `path`, which must not exist, with `content`, synchronised to disk; the mode is that of
/// `like` where it is given. 0, or the errno of the step that failed.
int create_file(const std::filesystem::path& path, std::string_view content,
                const struct stat* like = nullptr);

/// Makes what was renamed in the folder durable. Some file systems cannot; the content is safe
/// without.
void synchronise_folder(const std::filesystem::path& folder);

/// A random name in `folder`, that `ls` does not show. Other processes, of other machines too, may
/// write there: what is made under it must be new (O_EXCL, mkdir), or another name be taken.
std::filesystem::path temporary_name(const std::filesystem::path& folder);

/// How often a new name is tried where one is taken.
inline constexpr int kMostNames = 100;

/// Removes temporary files and folders that a killed process left in `folder` more than a day ago.
/// Of each folder once a process; what cannot be removed stays.
void sweep_temporaries(const std::filesystem::path& folder);

/// The folder that a file or folder of that name lies in.
std::filesystem::path folder_of(const std::filesystem::path& path);

/// What an errno means.
std::string reason_of(int error);

}  // namespace flexarm::measured
