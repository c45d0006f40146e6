#pragma once
#include <array>
#include <bitset>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "devices/lx3vp/decam.hpp"

namespace drycut::devices::lx3vp {

/// Something that an instruction of the pulse outputs has to tell.
struct PulseNote {
  int step = 0;  ///< of the program
  int code = 0;  ///< of an error (6781 to 6783), 0 = a warning, -1 = it only informs
  std::string text;
  int owner = -1;  ///< step of the instruction that has the output instead, -1 = there is none
  void visit(StateArchive& archive);
};

/// The pulse outputs Y0..Y3 with all that gives pulses on them: cams, DPLSV, DDRVI, DDRVA, PLSY, PLSR, PWM
/// and ZRN. One of them has an output at a time; who comes second is refused and told. Calls as in
/// `Instructions`.
class PulseUnit {
 public:
  void decam(int step, const DecamOperands& operands, bool powered, CamPort& port);
  void pulses(int step, const PulseOrder& order, bool powered, Registers& registers);

  /// A tick of 100 us: pulses, directions, D8140.. and M8147...
  void tick(CamPort& port);

  /// Pulses given on Y`output` since power-up, each one counted.
  [[nodiscard]] std::int64_t pulses(int output) const {
    return lines_[static_cast<std::size_t>(output)].given;
  }
  /// The cam of the DECAM at `step`; nullptr until the program has passed it.
  [[nodiscard]] const Decam* cam(int step) const {
    for (const auto& [of, cam] : cams_)
      if (of == step) return &cam;
    return nullptr;
  }
  [[nodiscard]] const PulseOutput& output(int output) const {
    return lines_[static_cast<std::size_t>(output)].output;
  }
  /// The outputs whose level is given tick by tick, not at the end of the scan.
  [[nodiscard]] std::vector<int> held() const;

  [[nodiscard]] bool has_notes() const { return !notes_.empty(); }
  std::vector<PulseNote> take_notes();

  void visit(StateArchive& archive);

 private:
  /// What an instruction does on an output.
  struct Motion {
    int step = -1;  ///< whose; -1 = none
    PulseOrder order = {};
    std::int64_t target = 0;  ///< of a distance, a position, a train
    double speed = 0;         ///< with ramps: present [Hz]
    bool at_dog = false;      ///< of a return to zero: the dog has come
    std::int64_t ticks = 0;   ///< of PWM: into its period

    /// A train may be without end.
    [[nodiscard]] bool ends() const { return order.kind != PulseOrder::Kind::train || order.pulses != 0; }
    void visit(StateArchive& archive);
  };
  struct Line {
    PulseOutput output;
    Motion motion;
    std::int64_t given = 0;
    void visit(StateArchive& archive);
  };
  enum class Progress : std::uint8_t { off, on, arrived };  ///< of an instruction that comes to an end

  [[nodiscard]] bool uses_output(const Decam& cam) const {
    return cam.enabled() && !cam.refused() && cam.uses(output(cam.operands().output));
  }
  /// The outputs on which cams give pulses, or owe some.
  [[nodiscard]] std::bitset<pulse_outputs> used_by_cams() const;
  /// True if the instruction has the output, taking it if it is free.
  bool take(Line& line, int step, int output);
  /// Without power the instruction gives its output back; true then.
  bool lets_go(Line& line, int step, bool powered);
  /// As `take` for an instruction that comes to an end: true in the scan in which it begins. Tells in M8029
  /// whether it is done.
  bool begins(int step, int output, bool powered, Registers& registers);
  void begin(Line& line, const PulseOrder& order, const Registers& registers);
  PulseTick move(Line& line, const Registers& registers);
  PulseTick train(Line& line);
  PulseTick seek(Line& line, const CamPort& port);
  void modulate(Line& line, int output, CamPort& port);
  void arrive(Line& line);
  void count(int output, const PulseTick& tick, Registers& registers);
  void tick_cam(int step, Decam& cam, CamPort& port);
  void tick_motion(int output, CamPort& port);

  std::array<Line, pulse_outputs> lines_;
  std::vector<std::pair<int, Decam>> cams_;  ///< in the order of their steps; each tick walks them
  std::map<int, Progress> drives_;           ///< by step
  std::map<int, bool> refused_;              ///< by step: told since it got power
  std::vector<PulseNote> notes_;
};

}  // namespace drycut::devices::lx3vp
