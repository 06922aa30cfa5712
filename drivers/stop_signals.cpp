// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/stop_signals.hpp"

#include <csignal>
#include <initializer_list>

namespace cdca {
namespace {

/// The one variable of the program that is not owned by anyone: a handler can reach no other.
volatile std::sig_atomic_t is_asked = 0;

extern "C" void ask_to_stop(int signal) {
  is_asked = 1;
  if (signal == SIGINT) std::signal(SIGINT, SIG_DFL);
}

}  // namespace

void catch_stop_signals() {
  struct sigaction action {};
  action.sa_handler = ask_to_stop;
  action.sa_flags = SA_RESTART;  // a write in progress goes on
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGTERM, SIGINT, SIGUSR1}) sigaction(signal, &action, nullptr);
}

bool stop_was_asked() { return is_asked != 0; }

}  // namespace cdca
