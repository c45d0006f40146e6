#include "sim/interrupt.hpp"

#include <array>

namespace drycut::sim {

namespace {

volatile std::sig_atomic_t came = 0;
constexpr std::array<int, 3> watched = {SIGINT, SIGTERM, SIGHUP};

}  // namespace

InterruptWatch::InterruptWatch() {
  struct sigaction action {};
  action.sa_handler = [](int signal) { came = signal; };
  action.sa_flags = SA_RESETHAND;
  for (std::size_t i = 0; i < watched.size(); ++i) sigaction(watched[i], &action, &before_[i]);
}

InterruptWatch::~InterruptWatch() {
  for (std::size_t i = 0; i < watched.size(); ++i) sigaction(watched[i], &before_[i], nullptr);
}

void InterruptWatch::check() {
  if (came != 0) throw Interrupted{came};
}

int InterruptWatch::come() { return came; }

}  // namespace drycut::sim
