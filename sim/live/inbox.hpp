#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "sim/live/request.hpp"

namespace drycut::sim::live {

/// What a line has been asked and has not done yet: a queue a client, served by turns, one request each. So
/// whoever asks much waits for it himself, and one press of the emergency stop waits for one request of each
/// other client at most. The order to stop goes before all of them. From any thread.
class Inbox {
 public:
  static constexpr std::size_t most_of_one = 64;
  static constexpr std::size_t most_bytes_of_one = std::size_t{1} << 20U;
  static constexpr std::size_t most_of_all = 256;

  /// False if there is no room, and then it is not taken: of a client there wait at most `most_of_one`
  /// requests of `most_bytes_of_one` together, of all `most_of_all`; but one of each is always taken, and so
  /// are a Leave and a Visit, which no client sends.
  bool put(Request request);
  /// The next one in turn; nullopt if there is none, or the line is to stop.
  std::optional<Request> take();
  /// Whose next requests are restarts: they are taken out, one restart does for all.
  std::vector<Asker> take_restarts();

  void stop();
  [[nodiscard]] bool stopped() const { return stopped_; }
  /// Something waits, or the line is to stop.
  [[nodiscard]] bool has_mail() const { return stopped_ || waiting_ > 0; }
  /// Returns then, and as soon as it has mail.
  void wait_until(std::chrono::steady_clock::time_point then);

 private:
  struct Queue {
    std::deque<Request> requests;
    std::size_t bytes = 0;
  };
  [[nodiscard]] bool has_room(const Request& request) const;
  Request take_first(std::map<Asker, Queue>::iterator of);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<Asker, Queue> queues_;  ///< none of them is empty
  std::deque<Asker> turns_;        ///< each of them once
  std::atomic<std::size_t> waiting_ = 0;
  std::atomic<bool> stopped_ = false;
};

}  // namespace drycut::sim::live
