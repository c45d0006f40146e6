#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/problem.hpp"
#include "devices/controller.hpp"
#include "devices/due.hpp"
#include "devices/lx3vp/ecam_table.hpp"
#include "devices/lx3vp/high_speed_counters.hpp"
#include "devices/lx3vp/il_program.hpp"
#include "devices/lx3vp/il_scan.hpp"
#include "devices/lx3vp/instructions.hpp"
#include "devices/lx3vp/modbus_map.hpp"
#include "devices/lx3vp/pulse_unit.hpp"
#include "devices/lx3vp/register_file.hpp"
#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp {

/// A WECON LX3VP: one program, scanned in cycles, on registers that it shares with the electronic cams, the
/// pulse outputs and the high-speed counters, which work every 100 us.
///
/// Terminals: X and Y of the base unit, C235..C255 and, where wired, C200..C234 as the high-speed counters,
/// Y0..Y3 for pulses too. Inputs are taken into the registers at the start of a scan, outputs given at its
/// end, which with `step_ns` comes as late as its instructions take, and the next scan after it; DECAM's
/// start signal, its direction and its synchronous output go by the tick. An instruction that fails is told
/// once and skipped. A scan that works too long (6105) stops program and outputs until the next power-up;
/// M8037 stops them until M8036. Interrupt routines run in the tick that brings their interrupt.
class Lx3vpController : public Controller, private Instructions {
 public:
  /// `program` is free of problems; `scan_ns` > 0; `step_ns` >= 0: what an instruction takes, or a word that
  /// one moves. Begins powered on, at time 0, registers at their reset values.
  Lx3vpController(il::IlProgram program, std::int64_t scan_ns, std::int64_t step_ns = 0);

  Cards& cards() override { return cards_; }
  /// A terminal of the base unit that nothing in the program uses: true if there is one, in cards() then.
  bool offer(const Address& address);
  std::variant<Address, TerminalFault> terminal(const std::string& text) override;
  [[nodiscard]] std::string_view pulse_terminals() const override { return "Y0, Y1, Y2 or Y3"; }
  [[nodiscard]] std::vector<Period> periods() const override;
  void run_devices(std::int64_t time_ns) override;
  void run_tasks(std::int64_t time_ns) override;
  void interrupt(int line, bool rising) override;
  void power(bool on) override;
  void visit(StateArchive& archive) override;

  /// Registers by name, see RegisterName. X and Y are the levels of the terminals; X is read-only, Y is
  /// written into the image, which the end of a scan gives out unless the program drives it.
  std::optional<ControllerValue> find(const std::string& name) override;
  /// The registers that the program names, those of its cams' blocks, and the pulse positions.
  [[nodiscard]] std::vector<std::string> names() const override { return names_; }

  /// One a DECAM.
  [[nodiscard]] std::vector<CamAxis> cam_axes() override;

  [[nodiscard]] std::variant<const ModbusFace*, std::string> modbus() const override { return &modbus_; }
  /// Operands by the names of find(): D10, DD10 and FD10 as the instruction takes it, TS0 where T0 is a
  /// contact.
  [[nodiscard]] std::vector<ProgramText> programs() override;
  void watch_programs(bool on) override { scanner_.watch(on); }
  void count_programs() override { scanner_.count(); }
  void add_coverage(Coverage& to) const override { scanner_.add_coverage(to); }
  [[nodiscard]] ProgramPositions positions(std::int64_t time_ns) const override;
  [[nodiscard]] std::vector<ProgramDoubt> doubts() const override;
  /// Of a DECAM that has power and has never started.
  [[nodiscard]] std::vector<ProgramWait> waits() override;

  [[nodiscard]] bool has_events() const override { return !events_.empty(); }
  std::vector<ControllerEvent> take_events() override { return std::exchange(events_, {}); }

  /// One `name = value` a line; zeros are left out.
  [[nodiscard]] std::string retentive_state() const override;
  /// Puts such a text back: retentive registers that it does not name become 0. False, and nothing changed,
  /// if `problems` had to be added.
  bool restore(const std::string& text, Problems& problems,
               const std::string& file_name = "retentive state") override;

  [[nodiscard]] Registers& registers() { return registers_; }

 private:
  /// What an ECAMTBX made a table of.
  struct Recipe {
    EcamType type = EcamType::s_curve_0;
    SawParameters saw = {};
    SCurveParameters s_curve = {};
    void visit(StateArchive& archive);
  };

  void decam(int step, const DecamOperands& operands, bool powered) override;
  void pulses(int step, const PulseOrder& order, bool powered) override;
  void high_speed_counter(int number, std::int32_t preset, bool powered) override;
  void compare_counter(int step, const CounterCompare& compare, bool powered) override;
  void measure_speed(int step, const SpeedMeasure& measure, bool powered) override;
  void refresh(char letter, int first, int count) override;
  void watchdog(int step, const std::string& text) override;
  void error(int step, int code, const std::string& text) override;
  void cam_table(int step, std::int32_t result, const std::string& text) override;

  /// By its place in program memory; nullptr if there is none.
  [[nodiscard]] const il::Step* step_at(int number) const;
  void keep_recipe(int step);
  [[nodiscard]] std::shared_ptr<const devices::CamTable> cam_table_of(const il::Step& step) const;

  void add_used_terminals();
  void add_names();
  void reset_registers();
  void clear_registers(bool retentive);
  void obey_relays();
  void stop_program();
  [[nodiscard]] bool runs();
  void stop_pulses();
  void stop_outputs();
  void take_inputs();
  /// Whether something looks at inputs between scans: a start signal, a dog, SPD, an interrupt, REF.
  [[nodiscard]] bool looks_at_inputs() const;
  void give_outputs();
  void give_pulses();
  void begin_scan(std::int64_t time_ns);
  void end_scan();
  void run_timed(std::int64_t time_ns);
  void set_system_relays(std::int64_t time_ns);
  /// M8000 to M8003.
  void tell_run(bool runs);
  void run_clocks(std::int64_t time_ns);
  void tell_notes();
  void tell(int step, std::string event, std::string text);
  [[nodiscard]] CamPort port() { return {registers_, inputs_, counters_.pulses(), outputs_}; }

  const il::IlProgram program_;
  il::ProgramScan scanner_;
  Due tick_{tick_ns};
  Due scan_;
  const std::int64_t step_ns_;
  // Where instructions take time:
  std::int64_t scan_due_ns_ = 0;    ///< the next scan begins
  std::int64_t scan_begun_ns_ = 0;  ///< the present one began
  std::int64_t scan_took_ns_ = 0;   ///< the last one, with what it waited for the next
  std::int64_t constant_ns_ = 0;    ///< least time of a scan (M8039, D8039)
  bool scanning_ = false;
  Cards cards_;
  /// Terminals of a map by their numbers, in a row that each tick walks; they may become more, never fewer.
  template <typename Terminal>
  class Row {
   public:
    using Terminals = std::vector<std::pair<std::size_t, Terminal*>>;
    const Terminals& of(std::map<Address, Terminal>& all) {
      if (row_.size() != all.size()) walk(all);
      return row_;
    }

   private:
    void walk(std::map<Address, Terminal>& all) {
      row_.clear();
      for (auto& [address, terminal] : all)
        row_.emplace_back(static_cast<std::size_t>(address.number), &terminal);
    }
    Terminals row_;
  };
  Row<Counter> counters_row_;
  Row<DigitalInput> inputs_row_;
  Row<DigitalOutput> outputs_row_;
  Row<PulseTrain> trains_row_;
  Registers registers_;
  HighSpeedCounters counters_;
  SpeedMeters speeds_;
  PulseUnit pulses_;
  std::array<bool, terminals> inputs_{};  ///< levels of the terminals
  std::array<bool, terminals> outputs_{};
  bool give_all_ = true;       ///< the terminals may have something else: no state
  bool ticks_inputs_ = false;  ///< inputs are taken every tick
  std::array<std::int64_t, pulse_outputs> pulses_before_{};  ///< given in earlier times of power
  bool powered_ = true;
  RegisterFace modbus_{powered_};
  bool first_scan_ = true;
  bool stopped_ = false;      ///< by the watchdog, until power-up
  int stopped_at_ = 0;        ///< step of program memory
  bool halted_ = false;       ///< by M8037, until M8036 or power-up
  bool outputs_off_ = false;  ///< M8034
  std::int64_t power_up_ns_ = 0;
  bool power_up_due_ = false;  ///< the next period is the first with power
  std::vector<std::string> names_;
  std::vector<ControllerEvent> events_;
  std::set<std::pair<int, std::string>> said_;  ///< since power-up, by step
  std::map<int, std::int32_t> cam_tables_;      ///< last results of ECAMTBX since power-up, by step
  std::map<int, Recipe> recipes_;               ///< of the last tables, by their blocks
};

}  // namespace drycut::devices::lx3vp
