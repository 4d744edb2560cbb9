#include "app/interruption.hpp"

#include <cstddef>
#include <cstdlib>

namespace flexarm::app {

namespace {

std::atomic<bool> is_requested = false;
std::atomic<int> signal_that_came = 0;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "a signal handler may not take a lock");

}  // namespace

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
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &previous_[i]);
    if (previous_[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &record, nullptr);
  }
}

Interruption::~Interruption() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], &previous_[i], nullptr);
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
