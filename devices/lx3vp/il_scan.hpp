#pragma once
#include <cstdint>
#include <vector>

#include "devices/lx3vp/il_program.hpp"
#include "devices/lx3vp/instructions.hpp"
#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp::il {

/// Runs a program scan by scan, as the PLC does: from the first instruction to END, each on what those before
/// it left in the registers. What instructions remember from scan to scan (edges, the fraction of a timer's
/// unit) is here; the program must outlive it.
class Scanner {
 public:
  explicit Scanner(const Program& program);

  /// One scan at `registers.time_ns`. Timers advance by the time since the scan before.
  void scan(Registers& registers, Instructions& instructions);
  /// After power-up: nothing is remembered, a contact that is ON counts as an edge.
  void restart();

 private:
  struct Rung;
  void execute(const Step& step, Rung& rung);
  [[nodiscard]] bool contact(const Step& step, const Rung& rung);
  void join(Op op, Rung& rung);
  void coil(const Step& step, Rung& rung);
  void timer(const Step& step, bool on, Rung& rung);
  void counter(const Step& step, bool on, Rung& rung);
  void call(const Step& step, Rung& rung);
  void make_cam_table(const Step& step, Rung& rung);
  /// Whether `now` is ON and was not at this step in the scan before; keeps it.
  bool rises(const Step& step, bool now);
  bool falls(const Step& step, bool now);

  const Program& program_;
  std::vector<bool> memories_;
  std::vector<std::int64_t> fractions_;  ///< of each timer's unit [ns]
  std::int64_t last_scan_ns_ = 0;
  bool scanned_ = false;
};

}  // namespace drycut::devices::lx3vp::il
