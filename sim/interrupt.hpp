#pragma once
namespace drycut::sim {

/// The user, or the system, has had enough. No std::exception: nobody takes it for a fault, all clean up, and
/// the program ends by the signal it was given.
struct Interrupted {
  int signal = 0;
};

/// While one lives, of one thread, the first SIGINT, SIGTERM and SIGHUP are kept for who asks; a second one
/// ends the program.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;
  /// Throws Interrupted if one has come.
  static void check();
  /// The one that has come, 0 = none.
  [[nodiscard]] static int come();
};

}  // namespace drycut::sim
