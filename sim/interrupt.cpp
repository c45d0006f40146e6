#include "sim/interrupt.hpp"

#include <array>
#include <csignal>

namespace drycut::sim {

namespace {

volatile std::sig_atomic_t came = 0;
constexpr std::array<int, 3> watched = {SIGINT, SIGTERM, SIGHUP};
std::array<struct sigaction, watched.size()> before{};  // any watch
int watches = 0;
bool at_progress = false;

}  // namespace

InterruptWatch::InterruptWatch(Ends ends) {
  if (ends == Ends::at_progress) at_progress = true;
  if (watches++ > 0) return;
  came = 0;
  struct sigaction action {};
  // A second one, whichever it is, is not kept.
  action.sa_handler = [](int signal) {
    if (came != 0) raise(signal);
    came = signal;
  };
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_NODEFER);
  for (std::size_t i = 0; i < watched.size(); ++i) sigaction(watched[i], &action, &before[i]);
}

InterruptWatch::~InterruptWatch() {
  if (--watches > 0) return;
  at_progress = false;
  for (std::size_t i = 0; i < watched.size(); ++i) sigaction(watched[i], &before[i], nullptr);
}

void InterruptWatch::check() {
  if (came != 0) throw Interrupted{came};
}

void InterruptWatch::check_progress() {
  if (at_progress) check();
}

int InterruptWatch::come() { return came; }

}  // namespace drycut::sim
