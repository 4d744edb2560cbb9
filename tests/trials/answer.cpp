#include "tests/trials/answer.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace flexarm::trials {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

AnsweredGain gain_of(const nlohmann::json& gain) {
  if (gain.is_null()) return {};
  return {gain.at("before"), gain.at("after"), gain.at("noise_floor")};
}

NamedCause cause_of(const nlohmann::json& json) {
  NamedCause cause;
  cause.effect = json.at("effect");
  cause.sensor = json.value("sensor", "");
  cause.confusable_with = json.at("confusable_with").get<std::vector<std::string>>();
  cause.probability = json.at("confidence");
  for (const auto& [name, parameter] : json.at("parameters").items()) {
    // A standard error that is not finite is written as null.
    const auto& error = parameter.at("std_error");
    cause.parameters[name] = {parameter.at("value"), error.is_null() ? 0.0 : error.get<double>()};
  }
  return cause;
}

/// Those that are stated.
std::vector<std::string> ports_of(const nlohmann::json& missing_force) {
  std::vector<std::string> ports;
  if (missing_force.is_null()) return ports;
  for (const auto& port : missing_force.at("ports")) {
    if (!port.at("stated").get<bool>()) continue;
    ports.push_back(port.at("port"));
    char separator = ' ';
    for (const auto& sensor : port.at("sensors")) {
      ports.back() += separator + sensor.get<std::string>();
      separator = '+';
    }
  }
  return ports;
}

/// Starts `arguments`, what it prints to `log`.
pid_t start(std::vector<std::string> arguments, const fs::path& log) {
  std::vector<char*> words;
  for (auto& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  const int output = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (output < 0) throw std::runtime_error(log.string() + ": cannot be written");
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(output, STDOUT_FILENO);
    ::dup2(output, STDERR_FILENO);
    ::execv(words[0], words.data());
    ::_exit(127);
  }
  ::close(output);
  if (child < 0) throw std::runtime_error("no process");
  return child;
}

/// A process is killed after so many times the limit that it was given.
constexpr double kPatience = 2.0;

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Whether the process ended by itself, with success; what it used to `usage`.
bool ends_well(pid_t child, double time_limit_s, rusage& usage) {
  constexpr std::chrono::milliseconds kLook(5);
  const auto limit = Clock::now() + std::chrono::duration<double>(time_limit_s);
  int status = 0;
  while (::wait4(child, &status, WNOHANG, &usage) == 0) {
    if (Clock::now() > limit) {
      ::kill(child, SIGKILL);
      ::wait4(child, &status, 0, &usage);
      return false;
    }
    std::this_thread::sleep_for(kLook);
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

Answer read_answer(const fs::path& json_file) {
  std::ifstream file(json_file);
  const auto json = nlohmann::json::parse(file);
  Answer answer;
  answer.verdict = json.at("verdict");
  for (const auto& cause : json.at("causes")) answer.causes.push_back(cause_of(cause));
  answer.ports = ports_of(json.at("missing_force"));
  answer.estimation = gain_of(json.at("gain").at("estimation"));
  answer.validation = gain_of(json.at("gain").at("validation"));
  return answer;
}

Answer ask(const fs::path& program, const fs::path& case_folder, const fs::path& work_folder,
           double time_limit_s) {
  fs::create_directories(work_folder);
  const fs::path json_file = work_folder / "diagnosis.json";
  const auto started = Clock::now();
  const pid_t child =
      start({program.string(), "diagnose", (case_folder / "measurement.toml").string(), "--json",
             json_file.string(), "--time-limit", fmt::format("{}", time_limit_s)},
            work_folder / "diagnosis.log");
  rusage usage = {};
  const bool well = ends_well(child, kPatience * time_limit_s, usage);
  const double time_s = std::chrono::duration<double>(Clock::now() - started).count();
  Answer answer = well ? read_answer(json_file) : Answer{};
  answer.time_s = time_s;
  answer.processor_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  return answer;
}

}  // namespace flexarm::trials
