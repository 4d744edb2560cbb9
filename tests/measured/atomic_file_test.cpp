#include "measured/files/atomic_file.hpp"

#include "arm/input_error.hpp"
#include "measured/files/file_writing.hpp"
#include "measured/files/text_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace flexarm::measured {
namespace {

using namespace arm;

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr std::size_t kAnySize = 1 << 26;

std::string text_of(const fs::path& path) {
  return read_text_file(path, kAnySize);
}

class AtomicFile : public testing::Test {
 protected:
  AtomicFile() {
    std::string name = (fs::temp_directory_path() / "flexarm-test-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~AtomicFile() override { fs::remove_all(folder_); }

  int files_in_folder() const {
    return static_cast<int>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  static std::string error_of(const std::function<void()>& action) {
    try {
      action();
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  fs::path folder_;
};

TEST_F(AtomicFile, TheContentArrivesWholeAndAlone) {
  const fs::path path = folder_ / "a.bin";
  const std::string content("line\r\n\0\xff", 8);
  write_atomically(path, content);
  EXPECT_EQ(read_text_file(path, kAnySize), content);
  write_atomically(path, "shorter");
  EXPECT_EQ(read_text_file(path, kAnySize), "shorter");
  EXPECT_EQ(files_in_folder(), 1);
}

TEST_F(AtomicFile, TheModeOfAnExistingFileIsKept) {
  const fs::path path = folder_ / "a.txt";
  write_atomically(path, "1");
  ::chmod(path.c_str(), 0640);
  write_atomically(path, "2");
  EXPECT_EQ(fs::status(path).permissions(), static_cast<fs::perms>(0640));
}

TEST_F(AtomicFile, ASymbolicLinkIsFollowed) {
  write_atomically(folder_ / "real.txt", "old");
  fs::create_symlink("real.txt", folder_ / "link.txt");
  write_atomically(folder_ / "link.txt", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.txt"));
  EXPECT_EQ(read_text_file(folder_ / "real.txt", kAnySize), "new");
}

TEST_F(AtomicFile, ADeviceIsWrittenToAndNotReplaced) {
  write_atomically("/dev/null", "gone");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_EQ(error_of([] { write_atomically("/dev/full", "x"); }),
            "/dev/full: cannot be written: No space left on device");
}

TEST_F(AtomicFile, EachReasonIsNamedWithThePath) {
  const std::string folder = folder_.string();
  EXPECT_EQ(error_of([&] { write_atomically(folder_, "x"); }),
            folder + ": cannot be written: is a folder");
  EXPECT_EQ(error_of([&] { write_atomically(folder_ / "none" / "a", "x"); }),
            folder + "/none/a: cannot be written: there is no folder " + folder + "/none");
  write_atomically(folder_ / "file", "x");
  EXPECT_EQ(error_of([&] { write_atomically(folder_ / "file" / "a", "x"); }),
            folder + "/file/a: cannot be written: Not a directory");
  EXPECT_EQ(error_of([&] { make_folder(folder_ / "file"); }),
            folder + "/file: cannot be made: Not a directory");
  EXPECT_EQ(error_of([] { write_atomically("", "x"); }), "the name of a file is empty");
  EXPECT_EQ(error_of([&] { write_atomically(folder_ / "none" / "", "x"); }),
            folder + "/none/: cannot be written: names no file");
}

TEST_F(AtomicFile, AReadOnlyFileIsLeftAlone) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write to every file";
  const fs::path path = folder_ / "kept";
  write_atomically(path, "old");
  ::chmod(path.c_str(), 0444);
  EXPECT_THAT(error_of([&] { write_atomically(path, "new"); }), HasSubstr("Permission denied"));
  EXPECT_EQ(read_text_file(path, kAnySize), "old");
}

TEST_F(AtomicFile, AWriteThatFailsLeavesTheOldFileAndNothingElse) {
  const fs::path path = folder_ / "a.txt";
  write_atomically(path, "old");
  // The file-size limit stands for a disk that fills up half way.
  rlimit before = {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto previous = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small = {1000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string error = error_of([&] { write_atomically(path, std::string(5000, 'x')); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, previous);
  EXPECT_EQ(error, path.string() + ": cannot be written: File too large");
  EXPECT_EQ(read_text_file(path, kAnySize), "old");
  EXPECT_EQ(files_in_folder(), 1);
}

TEST_F(AtomicFile, ASignalDuringTheWriteLeavesAWholeFileAndEndsTheProgram) {
  const fs::path path = folder_ / "a.txt";
  constexpr std::size_t kBytes = 1 << 20;
  for (int trial = 0; trial < 10; ++trial) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      for (char letter = 'a';; letter = letter == 'z' ? 'a' : static_cast<char>(letter + 1)) {
        write_atomically(path, std::string(kBytes, letter));
      }
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20 + 3 * trial));
    ::kill(child, trial % 2 == 0 ? SIGINT : SIGTERM);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(WTERMSIG(status), trial % 2 == 0 ? SIGINT : SIGTERM);
    if (files_in_folder() == 0) continue;  // the first write had not begun
    EXPECT_EQ(files_in_folder(), 1);
    const std::string content = read_text_file(path, kAnySize);
    ASSERT_EQ(content.size(), kBytes);
    EXPECT_EQ(content, std::string(kBytes, content.front()));
  }
}

/// Names of the numbers of processes were taken by the next process of that number.
TEST_F(AtomicFile, WhatAKilledProcessLeftIsNotInTheWayAndIsRemovedAfterADay) {
  const fs::path recent = folder_ / ".flexarm-1-0";
  const fs::path stale = folder_ / ".flexarm-0123456789abcdef";
  // Not by write_atomically: a folder is swept once a process, and a child has its parent's list.
  std::ofstream(recent) << "of a process that may still write";
  fs::create_directories(stale / "sub");
  const std::chrono::hours kOld(25);
  fs::last_write_time(stale, fs::file_time_type::clock::now() - kOld);
  const fs::path user = folder_ / "flexarm-old.txt";
  std::ofstream(user) << "not ours";
  fs::last_write_time(user, fs::file_time_type::clock::now() - kOld);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    write_atomically(folder_ / "a.txt", "new");
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_TRUE(fs::exists(folder_ / "a.txt"));
  EXPECT_TRUE(fs::exists(recent));
  EXPECT_TRUE(fs::exists(user));
  EXPECT_FALSE(fs::exists(stale));
}

TEST_F(AtomicFile, TemporaryNamesOfTwoProcessesDiffer) {
  EXPECT_NE(temporary_name(folder_), temporary_name(folder_));
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    std::ofstream(folder_ / "name") << temporary_name(folder_).string();
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_NE(text_of(folder_ / "name"), temporary_name(folder_).string());
}

TEST_F(AtomicFile, FoldersAreMadeWithTheirParents) {
  make_folder(folder_ / "a" / "b" / "c");
  EXPECT_TRUE(fs::is_directory(folder_ / "a" / "b" / "c"));
  EXPECT_NO_THROW(make_folder(folder_ / "a"));
}

TEST_F(AtomicFile, AFileThatCannotBeReadSaysWhy) {
  const std::string folder = folder_.string();
  write_atomically(folder_ / "rig.toml", "x");
  EXPECT_EQ(error_of([&] { read_text_file(folder_ / "rgi.toml", kAnySize); }),
            folder + "/rgi.toml: no such file (did you mean " + folder + "/rig.toml?)");
  EXPECT_EQ(error_of([&] { read_text_file(folder_, kAnySize); }),
            folder + ": is a folder; must be a file, such as " + folder + "/rig.toml");
  EXPECT_EQ(error_of([] { read_text_file("/dev/zero", 1000); }),
            "/dev/zero: is a pipe or a device; must be a regular file");
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(error_of([&] { read_text_file(folder_ / "pipe", 1000); }),
            folder + "/pipe: is a pipe or a device; must be a regular file");
  write_atomically(folder_ / "long", std::string(1001, 'x'));
  EXPECT_EQ(error_of([&] { read_text_file(folder_ / "long", 1000); }),
            folder + "/long: too large; at most 1000 bytes are read");
  EXPECT_EQ(error_of([] { read_text_file("", 1000); }), "the name of a file is empty");
  if (::geteuid() != 0) {
    ::chmod((folder_ / "rig.toml").c_str(), 0);
    EXPECT_THAT(error_of([&] { read_text_file(folder_ / "rig.toml", kAnySize); }),
                HasSubstr("Permission denied"));
  }
}

using AtomicFolder = AtomicFile;

const std::vector<NamedContent> kTwoFiles = {{"a.txt", "first"}, {"b.txt", "second"}};

TEST_F(AtomicFolder, ArrivesWithAllItsFilesAndAlone) {
  for (const fs::path name : {"made", "by/the/way", "slash/"}) {
    write_folder_atomically(folder_ / name, kTwoFiles, IfExists::refuse);
    EXPECT_EQ(text_of(folder_ / name / "a.txt"), "first");
    EXPECT_EQ(text_of(folder_ / name / "b.txt"), "second");
  }
  EXPECT_EQ(files_in_folder(), 3);
}

TEST_F(AtomicFolder, AnEmptyFolderIsFilledAndAFullOneRefused) {
  make_folder(folder_ / "empty");
  write_folder_atomically(folder_ / "empty", kTwoFiles, IfExists::refuse);
  EXPECT_EQ(text_of(folder_ / "empty" / "b.txt"), "second");
  const std::vector<NamedContent> other = {{"c.txt", "third"}};
  EXPECT_EQ(error_of([&] { write_folder_atomically(folder_ / "empty", other, IfExists::refuse); }),
            (folder_ / "empty").string() + ": cannot be written: is a folder with files in it");
  EXPECT_EQ(text_of(folder_ / "empty" / "a.txt"), "first");
}

TEST_F(AtomicFolder, IsReplacedAsAWholeWhenAsked) {
  write_folder_atomically(folder_ / "x", kTwoFiles, IfExists::refuse);
  const std::vector<NamedContent> other = {{"c.txt", "third"}};
  write_folder_atomically(folder_ / "x", other, IfExists::replace);
  EXPECT_EQ(text_of(folder_ / "x" / "c.txt"), "third");
  EXPECT_FALSE(fs::exists(folder_ / "x" / "a.txt"));
  EXPECT_EQ(files_in_folder(), 1);
}

TEST_F(AtomicFolder, OfTwoWritersTheSecondIsRefusedAndTheFirstStaysWhole) {
  const std::vector<NamedContent> others = {{"c.txt", "third"}};
  const fs::path folder = folder_ / "x";
  const std::string refusal =
      folder.string() + ": cannot be written: another process has written files there meanwhile";
  for (const IfExists if_exists : {IfExists::refuse, IfExists::replace}) {
    const FolderSeen seen = folder_seen(folder);  // nothing, then the folder of the first turn
    write_folder_atomically(folder, kTwoFiles, if_exists, seen);
    EXPECT_EQ(error_of([&] { write_folder_atomically(folder, others, if_exists, seen); }), refusal);
    EXPECT_EQ(text_of(folder / "a.txt"), "first");
    EXPECT_FALSE(fs::exists(folder / "c.txt"));
    EXPECT_EQ(files_in_folder(), 1);
  }
  write_folder_atomically(folder, others, IfExists::replace, folder_seen(folder));
  EXPECT_EQ(text_of(folder / "c.txt"), "third");
}

TEST_F(AtomicFolder, OfManyWritersAtATimeOneWins) {
  constexpr int kWriters = 8;
  const fs::path folder = folder_ / "x";
  for (const IfExists if_exists : {IfExists::refuse, IfExists::replace}) {
    const FolderSeen seen = folder_seen(folder);
    std::vector<pid_t> writers;
    for (int i = 0; i < kWriters; ++i) {
      writers.push_back(::fork());
      if (writers.back() != 0) continue;
      const std::vector<NamedContent> own = {{"a.txt", std::to_string(i)},
                                             {"b.txt", std::to_string(i)}};
      const std::string error =
          error_of([&] { write_folder_atomically(folder, own, if_exists, seen); });
      ::_exit(error == "no error" ? 0 : 1);
    }
    int winners = 0;
    int winner = -1;
    for (int i = 0; i < kWriters; ++i) {
      int status = 0;
      ::waitpid(writers[static_cast<std::size_t>(i)], &status, 0);
      if (status == 0) winner = i;
      winners += status == 0 ? 1 : 0;
    }
    EXPECT_EQ(winners, 1);
    EXPECT_EQ(text_of(folder / "a.txt"), std::to_string(winner));
    EXPECT_EQ(text_of(folder / "b.txt"), std::to_string(winner));
    EXPECT_EQ(files_in_folder(), 1);
  }
}

TEST_F(AtomicFolder, WhatCannotBeWrittenLeavesTheOldOneAndNothingElse) {
  write_folder_atomically(folder_ / "x", kTwoFiles, IfExists::refuse);
  const std::vector<NamedContent> bad = {{"c.txt", "third"}, {"no/such/folder", ""}};
  EXPECT_EQ(error_of([&] { write_folder_atomically(folder_ / "x", bad, IfExists::replace); }),
            (folder_ / "x").string() + ": cannot be written: No such file or directory");
  EXPECT_EQ(text_of(folder_ / "x" / "a.txt"), "first");
  EXPECT_EQ(files_in_folder(), 1);
  write_atomically(folder_ / "file", "x");
  for (const IfExists if_exists : {IfExists::refuse, IfExists::replace}) {
    EXPECT_EQ(error_of([&] { write_folder_atomically(folder_ / "file", kTwoFiles, if_exists); }),
              (folder_ / "file").string() + ": cannot be written: is no folder");
  }
  EXPECT_EQ(text_of(folder_ / "file"), "x");
}

}  // namespace
}  // namespace flexarm::measured
