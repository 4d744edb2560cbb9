#include "tests/app/process.hpp"

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace flexarm::testing_app {

namespace {

/// Time to start and be at work.
constexpr std::chrono::milliseconds kAtWork(kIsSanitized ? 3000 : 300);

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File temporary_file() {
  File file(std::tmpfile(), &std::fclose);
  if (!file) throw std::runtime_error("no temporary file");
  return file;
}

std::string content_of(std::FILE* file) {
  std::rewind(file);
  std::string content;
  std::array<char, 4096> part;
  while (const std::size_t count = std::fread(part.data(), 1, part.size(), file)) {
    content.append(part.data(), count);
  }
  return content;
}

/// The write end of a pipe that nobody reads.
int closed_pipe() {
  std::array<int, 2> ends = {};
  if (::pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
  ::close(ends[0]);
  return ends[1];
}

int output_descriptor(Output output, std::FILE* captured) {
  switch (output) {
    case Output::closed_pipe:
      return closed_pipe();
    case Output::full_disk:
      return ::open("/dev/full", O_WRONLY | O_CLOEXEC);
    case Output::captured:
      break;
  }
  return ::dup(::fileno(captured));
}

pid_t start(const std::vector<std::string>& arguments, const std::string& folder, int output,
            int errors) {
  std::vector<std::string> words = {FLEXARM_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) {
    // What the output looks like is not to depend on who runs the tests.
    for (const char* variable : {"COLUMNS", "NO_COLOR"}) ::unsetenv(variable);
    ::dup2(output, STDOUT_FILENO);
    ::dup2(errors, STDERR_FILENO);
    if (::chdir(folder.c_str()) == 0) ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  return child;
}

Ended finish(pid_t child, std::FILE* output, std::FILE* errors) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return {WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status), content_of(output),
          content_of(errors)};
}

}  // namespace

Ended run_flexarm(const std::vector<std::string>& arguments, const std::string& folder,
                  Output output) {
  const File captured = temporary_file();
  const File errors = temporary_file();
  const int descriptor = output_descriptor(output, captured.get());
  const pid_t child = start(arguments, folder, descriptor, ::fileno(errors.get()));
  ::close(descriptor);
  return finish(child, captured.get(), errors.get());
}

Ended interrupt_flexarm(const std::vector<std::string>& arguments, int signal) {
  const File captured = temporary_file();
  const File errors = temporary_file();
  const pid_t child = start(arguments, ".", ::fileno(captured.get()), ::fileno(errors.get()));
  std::this_thread::sleep_for(kAtWork);
  ::kill(child, signal);
  return finish(child, captured.get(), errors.get());
}

std::string shell_output(const std::string& command, const std::string& folder) {
  std::string text;
  FILE* pipe = ::popen(("cd '" + folder + "' && " + command).c_str(), "r");
  if (pipe == nullptr) return text;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
  ::pclose(pipe);
  return text;
}

double processor_s() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace flexarm::testing_app
