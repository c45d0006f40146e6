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
  /// `at_progress`: whoever shows how far he is throws Interrupted then, too.
  enum class Ends { as_asked, at_progress };
  explicit InterruptWatch(Ends ends = Ends::as_asked);
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;
  /// Throws Interrupted if one has come.
  static void check();
  /// The same, if one lives that ends work at its progress.
  static void check_progress();
  /// The one that has come, 0 = none.
  [[nodiscard]] static int come();
};

}  // namespace drycut::sim
