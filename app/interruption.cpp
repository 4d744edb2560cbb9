#include "app/interruption.hpp"

#include "report/terminal.hpp"

#include <cstddef>
#include <cstdlib>
#include <pthread.h>
#include <string_view>
#include <unistd.h>

namespace flexarm::app {

namespace {

std::atomic<bool> is_requested = false;
std::atomic<int> signal_that_came = 0;
/// The thread whose writing holds signals off; others hand them on to it.
pthread_t main_thread;
bool errors_can_be_wiped = false;

void say(std::string_view text) {
  // Best effort: nobody is left to tell.
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

void end_at_once(int signal) {
  if (pthread_equal(pthread_self(), main_thread) == 0) {
    pthread_kill(main_thread, signal);
    return;
  }
  if (errors_can_be_wiped) say(report::kWipeLine);
  say(signal == SIGINT ? "flexarm: interrupted\n" : "flexarm: terminated\n");
  struct sigaction usual = {};
  usual.sa_handler = SIG_DFL;
  sigaction(signal, &usual, nullptr);
  raise(signal);  // takes effect as this returns
}

static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "a signal handler may not take a lock");

}  // namespace

void end_at_once_when_interrupted() {
  main_thread = pthread_self();
  errors_can_be_wiped = report::takes_escape_sequences(STDERR_FILENO);
  struct sigaction end = {};
  end.sa_handler = end_at_once;
  sigemptyset(&end.sa_mask);
  end.sa_flags = SA_RESTART;
  for (const int signal : kEndingSignals) {
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &end, nullptr);
  }
}

Interruption::Interruption() {
  is_requested = false;
  signal_that_came = 0;
  struct sigaction record = {};
  record.sa_handler = [](int signal) {
    signal_that_came = signal;
    is_requested = true;
  };
  sigemptyset(&record.sa_mask);
  record.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  for (std::size_t i = 0; i < kEndingSignals.size(); ++i) {
    sigaction(kEndingSignals[i], nullptr, &previous_[i]);
    if (previous_[i].sa_handler != SIG_IGN) sigaction(kEndingSignals[i], &record, nullptr);
  }
}

Interruption::~Interruption() {
  for (std::size_t i = 0; i < kEndingSignals.size(); ++i) {
    sigaction(kEndingSignals[i], &previous_[i], nullptr);
  }
}

const std::atomic<bool>& Interruption::requested() const {
  return is_requested;
}

void Interruption::end_program() const {
  const int signal = signal_that_came;
  struct sigaction usual = {};
  usual.sa_handler = SIG_DFL;
  sigaction(signal, &usual, nullptr);
  raise(signal);
  std::abort();  // the signal is blocked
}

}  // namespace flexarm::app
