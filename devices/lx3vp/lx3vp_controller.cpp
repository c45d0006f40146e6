#include "devices/lx3vp/lx3vp_controller.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "base/state_archive.hpp"

namespace drycut::devices::lx3vp {

namespace {

constexpr std::int64_t ns_per_ms = 1'000'000;

// What an instruction error leaves (FX: M8004, M8067, D8067, D8069).
constexpr int error_relay = 8004;
constexpr int instruction_error_relay = 8067;
constexpr int instruction_error_register = 8067;
constexpr int error_step_register = 8069;
constexpr int stop_relay = 8061;  // M8061, D8061
// What the program, a panel or a scenario asks for (FX).
constexpr int clear_relay = 8031;
constexpr int clear_retentive_relay = 8032;
constexpr int hold_relay = 8033;
constexpr int outputs_off_relay = 8034;
constexpr int run_relay = 8036;
constexpr int halt_relay = 8037;
constexpr int constant_scan_relay = 8039;
constexpr int constant_scan_register = 8039;
constexpr int state_relay = 8046;
constexpr int watch_states_relay = 8047;
constexpr int state_registers = 8040;
constexpr std::size_t most_states_told = 8;
constexpr int annunciator_relay = 8048;
constexpr int watch_annunciators_relay = 8049;
constexpr int annunciator_register = 8049;
constexpr int first_annunciator = 900;
constexpr int second_register = 8013;
constexpr int shortest_scan_register = 8011;
constexpr int longest_scan_register = 8012;
constexpr int stop_register = 8061;

constexpr std::uint16_t default_ramp_ms = 100;       // D8148
constexpr std::int32_t default_top_speed = 100'000;  // D8146 [Hz]

bool is_pulse_output(const Address& address) {
  return address.kind == Kind::output && address.slot == 0 && address.number < pulse_outputs;
}

}  // namespace

Lx3vpController::Lx3vpController(il::IlProgram program, std::int64_t scan_ns, std::int64_t step_ns)
    : program_(std::move(program)),
      scanner_(program_, step_ns),
      scan_{scan_ns},
      step_ns_(step_ns),
      scan_took_ns_(scan_ns) {
  assert(scan_ns > 0);
  add_used_terminals();
  add_names();
  reset_registers();
  ticks_inputs_ = looks_at_inputs();
}

bool Lx3vpController::offer(const Address& address) {
  if (address.slot != 0) return false;
  give_all_ = true;
  switch (address.kind) {
    case Kind::input:
      cards_.inputs.try_emplace(address);
      return true;
    case Kind::output:
      cards_.outputs.try_emplace(address);
      if (is_pulse_output(address)) cards_.pulse_outputs.try_emplace(address);
      return true;
    case Kind::counter:
      if (address.number < first_wide_counter) return false;
      cards_.counters.try_emplace(address);
      registers_.counts_pulses.set(static_cast<std::size_t>(address.number));
      return true;
    case Kind::analogue:
    case Kind::interrupt:
      return false;
  }
  return false;
}

std::variant<Address, TerminalFault> Lx3vpController::terminal(const std::string& text) {
  const auto address = parse_base_terminal(text);
  if (address && offer(*address)) return *address;
  return TerminalFault{"wiring.no-terminal"_code,
                       fmt::format("'{}' is not a terminal of the controller", text),
                       "write X0 to X377, Y0 to Y377 (octal), or C200 to C255 for a high-speed counter"};
}

std::vector<Controller::Period> Lx3vpController::periods() const {
  return {{"E-CAM tick", tick_ns}, {"scan", scan_.period_ns}};
}

// Called every step of the simulation: most calls end at the first line.
void Lx3vpController::run_devices(std::int64_t time_ns) {
  if (!tick_.take(time_ns)) return;
  if (!powered_) return;
  if (std::exchange(power_up_due_, false)) power_up_ns_ = time_ns;
  if (stopped_ || halted_) {
    registers_.now_ns = time_ns;
    run_clocks(time_ns - power_up_ns_);
  }
  if (ticks_inputs_) take_inputs();
  for (const auto& [number, counter] : counters_row_.of(cards_.counters))
    counters_.count(static_cast<int>(number), counter->count, registers_);
  CamPort cams = port();
  pulses_.tick(cams);
  give_all_ = give_all_ || cams.changed;
  if (pulses_.has_notes()) tell_notes();
  if (speeds_.measures()) speeds_.tick(inputs_, registers_);
  if (counters_.has_news()) {
    const auto news = counters_.take_news();
    for (const auto& [y, on] : news.outputs) outputs_[static_cast<std::size_t>(y)] = on;
    give_all_ = give_all_ || !news.outputs.empty();
    for (const int interrupt : news.interrupts) scanner_.request(interrupt, registers_);
  }
  if (scanner_.has_interrupts() && !stopped_ && !halted_)
    scanner_.take_interrupts(inputs_, time_ns - power_up_ns_, registers_, *this);
  if (give_all_)
    give_outputs();
  else
    give_pulses();
}

void Lx3vpController::run_tasks(std::int64_t time_ns) {
  if (step_ns_ > 0) return run_timed(time_ns);
  if (!scan_.take(time_ns)) return;
  if (!powered_ || !runs()) return;
  if (constant_ns_ > 0 && time_ns - scan_begun_ns_ < constant_ns_) return;
  scan_took_ns_ = first_scan_ ? scan_.period_ns : time_ns - scan_begun_ns_;
  scan_begun_ns_ = time_ns;
  begin_scan(time_ns);
  scanner_.scan(registers_, *this);
  if (!stopped_) end_scan();
}

// A scan goes on until its instructions have had their time; the next begins `scan` after it, or at its end.
void Lx3vpController::run_timed(std::int64_t time_ns) {
  while (powered_ && runs()) {
    if (!scanning_) {
      if (scan_due_ns_ > time_ns) return;
      scanning_ = true;
      scan_begun_ns_ = scan_due_ns_;
      begin_scan(time_ns);
      scanner_.begin(registers_, *this);
    }
    const auto took_ns = scanner_.go_on(time_ns - scan_begun_ns_);
    if (!took_ns) return;
    scanning_ = false;
    end_scan();
    scan_took_ns_ = std::max({*took_ns, scan_.period_ns, constant_ns_});
    scan_due_ns_ = scan_begun_ns_ + scan_took_ns_;
  }
  scanning_ = false;
  scan_due_ns_ = (time_ns / scan_.period_ns + 1) * scan_.period_ns;
}

void Lx3vpController::begin_scan(std::int64_t time_ns) {
  registers_.time_ns = time_ns - power_up_ns_;
  registers_.now_ns = time_ns;
  take_inputs();
  registers_.x = inputs_;
  set_system_relays(registers_.time_ns);
}

void Lx3vpController::end_scan() {
  first_scan_ = false;
  obey_relays();
  // What works tick by tick has its own level; the image shows it.
  for (const int y : pulses_.held())
    registers_.y[static_cast<std::size_t>(y)] = outputs_[static_cast<std::size_t>(y)];
  outputs_ = registers_.y;
  if (pulses_.has_notes()) tell_notes();
  if (registers_.m[halt_relay]) stop_program();
  give_outputs();
}

/// What relays ask for at the end of a scan.
void Lx3vpController::obey_relays() {
  auto& m = registers_.m;
  auto& d = registers_.d;
  if (m[clear_relay]) clear_registers(false);
  if (m[clear_retentive_relay]) clear_registers(true);
  m[clear_relay] = m[clear_retentive_relay] = false;
  outputs_off_ = m[outputs_off_relay];
  constant_ns_ = m[constant_scan_relay] ? d[constant_scan_register] * ns_per_ms : 0;
  const auto first = registers_.s.begin();
  if (m[watch_states_relay]) {
    std::array<std::uint16_t, most_states_told> told{};
    std::size_t count = 0;
    for (int i = 0; i < first_annunciator && count < told.size(); ++i)
      if (registers_.s[static_cast<std::size_t>(i)]) told[count++] = static_cast<std::uint16_t>(i);
    std::copy(told.begin(), told.end(), d.begin() + state_registers);
    m[state_relay] = count > 0;
  } else {
    m[state_relay] = false;
  }
  if (m[watch_annunciators_relay]) {
    const auto found = std::find(first + first_annunciator, registers_.s.end(), true);
    m[annunciator_relay] = found != registers_.s.end();
    d[annunciator_register] = m[annunciator_relay] ? static_cast<std::uint16_t>(found - first) : 0;
  } else {
    m[annunciator_relay] = false;
  }
}

/// M8037. Registers and outputs are cleared unless M8033 holds them.
void Lx3vpController::stop_program() {
  registers_.m[halt_relay] = registers_.m[run_relay] = false;
  halted_ = true;
  tell_run(false);
  counters_.halt();
  speeds_ = {};
  const auto held = outputs_;
  const auto image = registers_.y;
  stop_pulses();
  if (registers_.m[hold_relay]) {
    outputs_ = held;
    registers_.y = image;
    return;
  }
  outputs_.fill(false);
  clear_registers(false);
}

/// Whether there are scans; M8036 lets a program that M8037 has stopped begin anew.
bool Lx3vpController::runs() {
  if (stopped_) return false;
  if (!halted_) return true;
  if (!registers_.m[run_relay]) return false;
  registers_.m[run_relay] = registers_.m[halt_relay] = false;
  halted_ = false;
  first_scan_ = true;
  scanner_.restart();
  return true;
}

void Lx3vpController::interrupt(int line, bool rising) {
  (void)line;  // no terminal of it is an interrupt line: none can be wired
  (void)rising;
}

void Lx3vpController::power(bool on) {
  if (on == powered_) return;
  powered_ = on;
  if (!on) {
    stop_outputs();
    std::fill(registers_.m.begin() + first_special, registers_.m.end(), false);
    tell_run(false);
    return;
  }
  reset_registers();
  counters_ = {};
  speeds_ = {};
  for (const auto& [address, counter] : cards_.counters) counters_.restart(address.number, counter.count);
  scanner_.restart();
  first_scan_ = true;
  stopped_ = false;
  halted_ = false;
  outputs_off_ = false;
  constant_ns_ = 0;
  power_up_due_ = true;
  said_.clear();
  cam_tables_.clear();
}

// Not what the program, the wiring and who watches the programs have set up.
void Lx3vpController::visit(StateArchive& archive) {
  STATE(archive, tick_, scan_, scan_due_ns_, scan_begun_ns_, scan_took_ns_, constant_ns_, scanning_, cards_,
        registers_, counters_, speeds_, pulses_, inputs_, outputs_, pulses_before_, powered_, first_scan_,
        stopped_, stopped_at_, halted_, outputs_off_, power_up_ns_, power_up_due_, events_, cam_tables_,
        recipes_);
  struct Scanner {
    Lx3vpController& plc;
    void visit(StateArchive& to) { plc.scanner_.visit(to, plc.registers_, plc); }
  } scanner{*this};
  STATE(archive, scanner);
  std::vector<std::pair<int, std::string>> said(said_.begin(), said_.end());
  STATE(archive, said);
  if (!archive.restores()) return;
  said_ = {said.begin(), said.end()};
  give_all_ = true;
}

void Lx3vpController::Recipe::visit(StateArchive& archive) { STATE(archive, type, saw, s_curve); }

void Lx3vpController::stop_pulses() {
  for (int i = 0; i < pulse_outputs; ++i) pulses_before_[static_cast<std::size_t>(i)] += pulses_.pulses(i);
  pulses_ = {};
}

void Lx3vpController::stop_outputs() {
  stop_pulses();
  outputs_.fill(false);
  registers_.y.fill(false);
  give_outputs();
}

void Lx3vpController::watchdog(int step, const std::string& text) {
  if (stopped_) return;
  registers_.m[error_relay] = true;
  registers_.m[stop_relay] = true;
  registers_.d[stop_register] = watchdog_error;
  registers_.d[error_step_register] = static_cast<std::uint16_t>(step);
  stopped_ = true;
  stopped_at_ = step;
  tell_run(false);
  stop_outputs();
  tell(step, "error", text + "; the PLC stops until it is switched on again");
}

/// All that is retentive, or all that is not, but for inputs and special registers.
void Lx3vpController::clear_registers(bool retentive) {
  const auto clear = [&](char letter, auto& values) {
    const auto end = std::min<std::size_t>(values.size(), first_special);
    for (std::size_t i = 0; i < end; ++i) {
      if (is_retentive(letter, static_cast<int>(i)) != retentive) continue;
      values[i] = {};
      if (letter == 'D') registers_.written.reset(i);
    }
  };
  clear('D', registers_.d);
  clear('M', registers_.m);
  clear('S', registers_.s);
  clear('T', registers_.t);
  clear('C', registers_.c);
  if (retentive) return;
  registers_.v.fill(0);
  registers_.z.fill(0);
  registers_.y.fill(false);
}

// What power-up leaves of the registers.
void Lx3vpController::reset_registers() {
  clear_registers(false);
  std::fill(registers_.d.begin() + first_special, registers_.d.end(), std::uint16_t{0});
  std::fill(registers_.m.begin() + first_special, registers_.m.end(), false);
  for (std::size_t i = first_special; i < data_words; ++i) registers_.written.reset(i);
  tell_run(false);
  registers_.x.fill(false);
  registers_.d[watchdog_register] = default_watchdog_ms;
  registers_.set_i32(8146, default_top_speed);
  registers_.d[8148] = default_ramp_ms;
}

bool Lx3vpController::looks_at_inputs() const {
  if (scanner_.has_interrupts()) return true;
  return std::any_of(program_.steps.begin(), program_.steps.end(), [](const il::Step& step) {
    if (step.op() == il::Op::spd || step.op() == il::Op::ref) return true;
    const bool may_wait = step.op() == il::Op::decam || step.op() == il::Op::zrn;
    return may_wait &&
           std::any_of(step.operands.begin(), step.operands.end(),
                       [](const il::Operand& operand) { return operand.kind == il::OperandType::X; });
  });
}

void Lx3vpController::take_inputs() {
  for (const auto& [number, input] : inputs_row_.of(cards_.inputs)) inputs_[number] = input->level;
}

void Lx3vpController::give_outputs() {
  const bool on = !outputs_off_;
  for (const auto& [number, output] : outputs_row_.of(cards_.outputs)) output->level = outputs_[number] && on;
  give_all_ = false;
  give_pulses();
}

void Lx3vpController::give_pulses() {
  const bool on = !outputs_off_;
  for (const auto& [number, train] : trains_row_.of(cards_.pulse_outputs)) {
    const std::int64_t given = pulses_.pulses(static_cast<int>(number));
    // Pulses that stay inside are none of the terminal's.
    if (!on) pulses_before_[number] = train->count - given;
    train->count = pulses_before_[number] + given;
  }
}

void Lx3vpController::set_system_relays(std::int64_t time_ns) {
  tell_run(true);
  constexpr std::int64_t unit_ns = ns_per_ms / 10;
  const auto took = static_cast<std::uint16_t>(std::min<std::int64_t>(scan_took_ns_ / unit_ns, 0xFFFF));
  auto& d = registers_.d;
  d[8010] = took;
  d[shortest_scan_register] = first_scan_ ? took : std::min(d[shortest_scan_register], took);
  d[longest_scan_register] = first_scan_ ? took : std::max(d[longest_scan_register], took);
  if (first_scan_) show_clock(registers_);
  run_clocks(time_ns);
}

void Lx3vpController::tell_run(bool runs) {
  auto& m = registers_.m;
  m[8000] = runs;
  m[8001] = !runs;
  m[8002] = runs && first_scan_;
  m[8003] = !m[8002];
}

// Off in the first half of their period.
void Lx3vpController::run_clocks(std::int64_t time_ns) {
  auto& m = registers_.m;
  const auto clock = [&](std::int64_t period_ms) { return time_ns / (period_ms * ns_per_ms / 2) % 2 == 1; };
  m[8011] = clock(10);
  m[8012] = clock(100);
  m[8013] = clock(1000);
  m[8014] = clock(60'000);
  if (clock_second(registers_) != registers_.d[second_register]) show_clock(registers_);
}

void Lx3vpController::decam(int step, const DecamOperands& operands, bool powered) {
  CamPort cams = port();
  pulses_.decam(step, operands, powered, cams);
  give_all_ = give_all_ || cams.changed;
}

void Lx3vpController::pulses(int step, const PulseOrder& order, bool powered) {
  pulses_.pulses(step, order, powered, registers_);
}

void Lx3vpController::high_speed_counter(int number, std::int32_t preset, bool powered) {
  counters_.enable(number, preset, powered);
}

void Lx3vpController::compare_counter(int step, const CounterCompare& compare, bool powered) {
  counters_.compare(step, compare, powered);
}

void Lx3vpController::measure_speed(int step, const SpeedMeasure& measure, bool powered) {
  speeds_.measure(step, measure, powered, registers_);
}

void Lx3vpController::refresh(char letter, int first, int count) {
  const auto from = static_cast<std::ptrdiff_t>(first);
  if (letter == 'X') {
    std::copy_n(inputs_.begin() + from, count, registers_.x.begin() + from);
    return;
  }
  std::copy_n(registers_.y.begin() + from, count, outputs_.begin() + from);
  give_all_ = true;
}

void Lx3vpController::error(int step, int code, const std::string& text) {
  registers_.m[error_relay] = true;
  registers_.m[instruction_error_relay] = true;
  registers_.d[instruction_error_register] = static_cast<std::uint16_t>(code);
  registers_.d[error_step_register] = static_cast<std::uint16_t>(step);
  tell(step, "error", text);
}

// Once per change of the result: an ECAMTBX that fails in every scan does not flood, one that fails anew is
// told.
void Lx3vpController::cam_table(int step, std::int32_t result, const std::string& text) {
  const auto [last, first] = cam_tables_.try_emplace(step, result);
  const bool changed = std::exchange(last->second, result) != result;
  if (result > 0) keep_recipe(step);
  if (result < 0 && (first || changed)) events_.push_back({"LX3VP", "warning", text});
}

const il::Step* Lx3vpController::step_at(int number) const {
  const auto step = std::find_if(program_.steps.begin(), program_.steps.end(),
                                 [&](const il::Step& candidate) { return candidate.number == number; });
  return step == program_.steps.end() ? nullptr : &*step;
}

std::vector<ProgramWait> Lx3vpController::waits() {
  std::vector<ProgramWait> waits;
  for (const il::Step& step : program_.steps) {
    const Decam* cam = pulses_.cam(step.number);
    if (cam == nullptr || !cam->enabled() || cam->refused() || cam->starts() > 0) continue;
    const ProgramText named(program_.file, "il", "");
    waits.push_back({named.name, step.line, 0});
    waits.back().lacks = fmt::format("its word {}, D{}, was never 1 or 2", static_cast<int>(word::start),
                                     cam->operands().block + word::start);
  }
  return waits;
}

void Lx3vpController::tell_notes() {
  for (const PulseNote& note : pulses_.take_notes()) {
    const il::Step* step = step_at(note.step);
    const std::string place = step == nullptr ? "" : fmt::format("{}:{}: ", program_.file, step->line);
    const il::Step* owner = step_at(note.owner);
    const auto text = owner == nullptr ? note.text : fmt::format("{} (line {})", note.text, owner->line);
    if (note.code <= 0)
      tell(note.step, note.code == 0 ? "warning" : "note", place + text);
    else
      error(note.step, note.code, fmt::format("{}{}: {}", place, note.code, text));
  }
}

// Once each since power-up: an instruction that fails in every scan does not flood.
void Lx3vpController::tell(int step, std::string event, std::string text) {
  if (said_.emplace(step, text).second) events_.push_back({"LX3VP", std::move(event), std::move(text)});
}

}  // namespace drycut::devices::lx3vp
