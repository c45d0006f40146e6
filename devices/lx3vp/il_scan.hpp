#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devices/lx3vp/il_operands.hpp"
#include "devices/lx3vp/il_program.hpp"
#include "devices/lx3vp/il_values.hpp"
#include "devices/lx3vp/instructions.hpp"
#include "devices/lx3vp/registers.hpp"

namespace drycut::devices {
struct Counts;
struct Coverage;
}  // namespace drycut::devices

namespace drycut::devices::lx3vp::il {

/// Hands DECAM or a pulse instruction to the controller, with the power into it. Throws
/// RuntimeError.
void drive_outputs(const Registers& registers, const Step& step, bool powered, Instructions& instructions);

/// Runs a program scan by scan, as the PLC does: from the first instruction to END, each on what those before
/// it left in the registers. What instructions remember from scan to scan (edges, the fraction of a timer's
/// unit) is here; the program must outlive it.
class ProgramScan {
 public:
  /// `step_ns`: what an instruction takes, or a word that one moves; the watchdog (D8000) goes by it. 0: none
  /// of them takes time; the watchdog counts 0.2 us for each, which is the order of the real unit's.
  explicit ProgramScan(const IlProgram& program, std::int64_t step_ns = 0);
  ~ProgramScan();
  ProgramScan(const ProgramScan&) = delete;
  ProgramScan& operator=(const ProgramScan&) = delete;

  /// One scan at `registers.time_ns`. Timers advance by the time since the scan before.
  void scan(Registers& registers, Instructions& instructions);
  /// The same in pieces: begin() at `registers.time_ns`, then go_on() as the time comes.
  void begin(Registers& registers, Instructions& instructions);
  /// Executes what acts until `computed_ns` after the beginning, each instruction at its end. How long the
  /// whole scan took once that has passed [ns]; nothing before, and after a watchdog.
  std::optional<std::int64_t> go_on(std::int64_t computed_ns);
  /// A tick of 100 us: takes what comes of the edges of X0..X5 and the time since power-up. Interrupt
  /// routines that may run are run at once, between two instructions of the scan.
  void take_interrupts(const std::array<bool, terminals>& inputs, std::int64_t time_ns, Registers& registers,
                       Instructions& instructions);
  /// A DHSCS asks for I010, I020 to I060; it is taken in the next of those.
  void request(int interrupt, const Registers& registers);
  [[nodiscard]] bool has_interrupts() const { return !program_.interrupts.empty(); }
  /// After power-up: nothing is remembered, a contact that is ON counts as an edge.
  void restart();

  /// Whether somebody looks at what scans do; costs time.
  void watch(bool on);
  /// What the last scan did, a letter a line of the text, as devices::ProgramPositions has it; "" before the
  /// first one that was watched.
  [[nodiscard]] const std::string& scanned() const { return scanned_; }
  /// Counts from now on what runs, which costs time.
  void count();
  /// Adds what was counted. A line runs as often as a scan comes by its instruction, one that needs power as
  /// often as it has some. A contact is a decision, closed or open, but for M8000 and M8001, which never
  /// change.
  void add_coverage(Coverage& to) const;
  /// Line of the instruction that a scan in pieces comes to next; 0: it has come to its end.
  [[nodiscard]] int line() const;

  /// The scan goes on on these, which it does not own. What somebody sees who looks at it is no state.
  void visit(StateArchive& archive, Registers& registers, Instructions& instructions);

 private:
  struct Rung;
  void start(Rung& rung);
  [[nodiscard]] int watchdog_ms(const Registers& registers) const;
  /// Gives the watchdog's time anew.
  void refresh_watchdog(Rung& rung) const;
  bool run(Rung& rung, std::int64_t work);
  template <bool watched>
  bool run_steps(Rung& rung, std::int64_t work);
  void mark(const Step& step, const Rung& rung);
  template <bool watched>
  void execute(const Step& step, Rung& rung);
  /// The step with its index registers applied; nullptr, and told, if it then names what there is not.
  const Step* indexed(const Step& step, Rung& rung) { return step.indexed ? with_index(step, rung) : &step; }
  const Step* with_index(const Step& step, Rung& rung);
  // il_interrupts.cpp
  void ask(std::size_t interrupt, const Registers& registers);
  std::int64_t run_interrupts(Registers& registers, Instructions& instructions);
  void tell_error(const Step& step, const IlError& error, Rung& rung) const;
  // il_flow.cpp: what says where a program goes on and which power it has.
  void flow(const Step& step, Rung& rung);
  void begin_state(const Step& step, Rung& rung);
  void jump(const Step& step, Rung& rung);
  void call_subroutine(const Step& step, Rung& rung);
  bool transfers(const Operand& device, const Rung& rung) const;
  void transfer(const Operand& device, Rung& rung);
  [[nodiscard]] bool contact(const Step& step, Rung& rung);
  void join(Op op, Rung& rung);
  void coil(const Step& step, Rung& rung);
  void timer(const Step& step, bool on, Rung& rung);
  void counter(const Step& step, bool on, Rung& rung);
  /// With power, of the pulse form as power comes.
  bool executes(const Step& step, const Rung& rung);
  void call(const Step& step, Rung& rung);
  void make_cam_table(const Step& step, Rung& rung);
  void refresh_terminals(const Step& step, Rung& rung) const;
  /// Whether `now` is ON and was not at this step in the scan before; keeps it.
  bool rises(const Step& step, bool now) { return turns(step, now, true); }
  bool falls(const Step& step, bool now) { return turns(step, now, false); }
  bool turns(const Step& step, bool now, bool on);

  const IlProgram& program_;
  std::vector<bool> memories_;
  std::vector<std::int64_t> fractions_;  ///< of each timer's unit [ns]
  std::vector<std::int64_t> timed_ns_;   ///< when each timer was last passed: a loop passes it more than once
  Step scratch_;                         ///< the step that `indexed` has made
  std::int64_t last_scan_ns_ = 0;
  bool has_scanned_ = false;
  const std::int64_t step_ns_;
  bool interrupts_on_ = false;        ///< EI
  bool interrupted_ = false;          ///< an interrupt routine runs
  std::vector<std::size_t> waiting_;  ///< interrupts, as they came, by their places in the program's table
  std::array<bool, interrupt_inputs> levels_{};
  std::int64_t taken_ns_ = -1;  ///< when interrupts were taken last; -1: not since the start
  std::unique_ptr<Rung> rung_;  ///< of the scan that go_on() goes on with
  bool watched_ = false;
  std::string scanning_;  ///< what the present scan has done so far
  std::string scanned_;
  std::unique_ptr<Counts> counts_;  ///< of the steps
};

/// What a scan carries from instruction to instruction.
struct ProgramScan::Rung {
  /// A FOR that runs.
  struct Loop {
    int place = 0;
    int left = 0;  ///< times still to run
    void visit(StateArchive& archive);
  };
  /// A subroutine that was called.
  struct Frame {
    std::size_t back = 0;   ///< place behind the CALL
    std::size_t loops = 0;  ///< that ran there
    void visit(StateArchive& archive);
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
  int state = -1;  ///< place of the STL whose instructions run; -1: outside a sequence
  bool state_on = true;
  bool supply = true;  ///< all master contacts and the state are ON
  bool flow = false;
  std::int64_t work = 0;
  std::int64_t limit = 0;  ///< at which the watchdog comes
  std::size_t next = 0;
  bool over = false;

  void visit(StateArchive& archive);

  /// A contact that is ON or OFF joins what is before it.
  void join(const Step& step, bool on) {
    if (step.join == Join::series) {
      flow = flow && on;
    } else if (step.join == Join::parallel) {
      flow = flow || on;
    } else {
      if (step.opens_block)
        blocks.push_back(flow);
      else
        blocks.clear();
      flow = on;
    }
  }
  /// What reaches a coil.
  [[nodiscard]] bool power() const { return flow && supply; }
  void renew_supply() {
    supply = state_on;
    for (const bool open : open_masters) supply = supply && !open;
  }
};

}  // namespace drycut::devices::lx3vp::il
