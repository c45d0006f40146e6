#include <fmt/format.h>

#include <utility>

#include "devices/camming4/camming4.hpp"

namespace drycut::devices::camming4 {
namespace {

constexpr int falling = 1;
constexpr int rising_edge = 2;
constexpr int stop_inhibited_ms = 25;

/// What the count was `ago` bits before, as a variable shows it.
std::int32_t shown_before(axis::Quota quota, std::int64_t ago, axis::Resolution resolution) {
  quota.count(-ago, resolution);
  return wrap(Size::L, quota.bits(resolution));
}

std::int32_t incremented(std::int32_t value) { return wrap(Size::L, std::int64_t{value} + 1); }

}  // namespace

void Camming4::interrupt(int line, bool rising) {
  AnaloguePositioner::interrupt(line, rising);
  if (!state("st_init")) return;
  const auto master_total = [&] {
    const Counter* master = terminals_.master[value("mtype") == 1 ? 1 : 0];
    return master ? master_.total_at(master->latched, state("st_cntlockm"), state("st_cntrevm"))
                  : master_.total();
  };
  if (rising && line == terminals_.zero_line_master && !zero_master_) zero_master_ = master_total();
  if (line == terminals_.function_line && state("st_intenbl") && !capture_ &&
      value("intcapt") == (rising ? rising_edge : falling))
    capture_ = Capture{latched_total(), master_total(), master_total()};
}

void Camming4::sample_inputs() {
  const Capture now{axis_.transducer().total(), master_.total(), master_.total()};
  const bool level = is_on(terminals_.input);
  const bool edge = level != input_was_ && value("inpcapt") == (level ? rising_edge : falling);
  input_was_ = level;
  if (edge && state("st_enbl") && value("funInp") != 0) {
    set_state("st_enbl", false);
    set_state("st_capt", true);
    run_function(value("funInp"), now, "funInp");
  }

  if (!capture_) return;
  // It waits for what was written before the edge, not for what a program goes on to write.
  if (!capture_->delay) capture_->delay = recalculation_.left();
  if (*capture_->delay > 0) {
    --*capture_->delay;
    if (!std::exchange(capture_->late, true)) warn(8, value("rowex"));
    return;
  }
  Capture capture = *capture_;
  capture_.reset();
  // The counts were latched at the edge; a cam cannot begin before the calculations are done (000 1.4).
  if (capture.late) capture.start = now.start;
  if (!state("st_intenbl") || value("funInt") == 0) return;
  set_state("st_intenbl", false);
  set_state("st_intcapt", true);
  run_function(value("funInt"), capture, "funInt");
}

void Camming4::run_function(int function, const Capture& capture, std::string_view subject) {
  const std::int64_t slave_ago = axis_.transducer().total() - capture.slave;
  const std::int64_t master_ago = master_.total() - capture.master;
  const bool counts_writable = holds(type().variables[VariableRow("encoder")].write);
  switch (function) {
    case 1:
      if (constexpr CommandRow stop("STOPCAM"); holds(type().commands[stop].condition) && may_execute(stop))
        stop_cam();
      else
        report_refusal("STOPCAM", subject);
      break;
    case 2:
      function_start(capture, subject);
      break;
    case 3:
    case 9:
    case 11:
      value("delta1") = shown_before(axis_.quota, slave_ago, axis_.settings.resolution);
      if (function != 3) function_start(capture, subject);
      break;
    case 4:
    case 10:
    case 12:
      value("delta2") = shown_before(master_quota_, master_ago, master_resolution_);
      if (function != 4) function_start(capture, subject);
      break;
    case 5:
      value("delta1") = incremented(value("delta1"));
      break;
    case 6:
      value("delta2") = incremented(value("delta2"));
      break;
    case 7:
      if (!counts_writable) {
        report_refusal("encoder", subject);
        break;
      }
      axis_.quota.set_bits(value("delta1"), axis_.settings.resolution);
      axis_.quota.count(slave_ago, axis_.settings.resolution);
      requota(subject);
      break;
    case 8:
      if (!counts_writable) {
        report_refusal("encoderm", subject);
        break;
      }
      master_quota_.set_bits(value("delta2"), master_resolution_);
      master_quota_.count(master_ago, master_resolution_);
      break;
    default:
      report({Diagnostic::Kind::warning, std::string(subject),
              fmt::format("function {} does nothing", function)});
  }
  if (state("st_camex") && (function == 11 || function == 12)) inhibit_stop_ms_ = stop_inhibited_ms;
}

void Camming4::function_start(const Capture& capture, std::string_view subject) {
  if (holds(type().commands[CommandRow("STARTCAM")].condition)) {
    start_cam(capture.start);
  } else {
    report_refusal("STARTCAM", subject);
  }
}

void Camming4::report_refusal(std::string_view what, std::string_view subject) {
  report({Diagnostic::Kind::command_refused, std::string(what),
          fmt::format("by {}: its conditions do not hold", subject)});
}

void Camming4::sample_master_preset() {
  const bool enable = is_on(terminals_.enable_master);
  const bool released = enable_master_was_ && !enable;
  const bool met = enable && !enable_master_was_;
  enable_master_was_ = enable;
  const auto zero = std::exchange(zero_master_, std::nullopt);

  std::optional<std::int64_t> loaded;  // master's total that gets the quota
  const std::int32_t mode = value("prsmodem");
  if (mode == 2) {
    if (met) loaded = master_.total();
  } else if (state("st_prsonm")) {
    if (mode == 0 && released) loaded = master_.total();
    if (mode == 1 && master_released_ && zero) loaded = *zero;
    if (released) master_released_ = true;
  }
  if (!loaded) return;
  master_quota_.set_um(value("prsposm"), master_resolution_);
  master_quota_.count(master_.total() - *loaded, master_resolution_);
  set_state("st_prsonm", false);
  set_state("st_prsokm", true);
}

}  // namespace drycut::devices::camming4
