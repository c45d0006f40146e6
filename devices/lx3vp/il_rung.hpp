#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "devices/lx3vp/il_scan.hpp"

namespace drycut::devices::lx3vp::il {

/// What a scan carries from instruction to instruction.
struct Scanner::Rung {
  /// A FOR that runs.
  struct Loop {
    int place = 0;
    int left = 0;  ///< times still to run
  };
  /// A subroutine that was called.
  struct Frame {
    std::size_t back = 0;   ///< place behind the CALL
    std::size_t loops = 0;  ///< that ran there
  };
  static constexpr std::size_t masters = 8;  ///< N0..N7

  Rung(Registers& of, Instructions& to) : registers(of), instructions(to) {}

  Registers& registers;
  Instructions& instructions;
  std::int64_t passed_ns = 0;       ///< since the scan before
  std::vector<bool> blocks = {};    ///< begun before the present one
  std::vector<bool> branches = {};  ///< kept by MPS
  std::vector<Loop> loops = {};
  std::vector<Frame> frames = {};
  std::array<bool, masters> open_masters = {};  ///< N0..N7: MC without power, until MCR
  const Step* state = nullptr;                  ///< STL whose instructions run; nullptr: outside a sequence
  bool state_on = true;
  bool supply = true;  ///< all master contacts and the state are ON
  bool flow = false;
  std::int64_t work = 0;
  std::size_t next = 0;
  bool over = false;

  /// What reaches a coil.
  [[nodiscard]] bool power() const { return flow && supply; }
  void renew_supply() {
    supply = state_on;
    for (const bool open : open_masters) supply = supply && !open;
  }
};

}  // namespace drycut::devices::lx3vp::il
