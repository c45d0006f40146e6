#pragma once
#include <algorithm>
#include <cstdint>

#include "tests/devices/bench.hpp"

namespace drycut::devices {

/// A bench whose axis passes an enable and zero pulses, for preset searches. The enable, 2.INP01, is active
/// from `from` to `to`; each multiple of `pulse_every` latches its exact count and is an edge of `zero_line`.
template <typename Bench, std::int64_t pulse_every, int zero_line>
class SearchBench : public Bench {
 public:
  SearchBench(std::int64_t first, std::int64_t end) : from(first), to(end) {}

  void tick(std::int64_t master_bits = 0) override {
    if (by_hand) return Bench::tick(master_bits);
    bool& enable = this->input("2.INP01");
    const bool was = enable;
    enable = this->count() >= from && this->count() < to;
    const std::int64_t before = this->count();
    Bench::tick(master_bits);
    if (was && !enable) released_at = this->count();
    const auto turn = [](std::int64_t count) {
      return count / pulse_every - (count % pulse_every < 0 ? 1 : 0);
    };
    if (turn(before) == turn(this->count())) return;
    this->counter().latched = std::max(turn(before), turn(this->count())) * pulse_every;
    this->device->interrupt(zero_line, rising);
  }

  std::int64_t from;             ///< [bits]
  std::int64_t to;               ///< [bits]
  bool rising = true;            ///< edges of the zero pulse that come
  bool by_hand = false;          ///< the test moves the enable and gives the pulses itself
  std::int64_t released_at = 0;  ///< count of the sample that saw the last release
};

}  // namespace drycut::devices
