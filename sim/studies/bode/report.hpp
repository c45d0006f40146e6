#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "renders/plots.hpp"
#include "sim/output_folder.hpp"
#include "sim/record/outcome.hpp"
#include "sim/record/verdict.hpp"
#include "sim/studies/bode/limit_cycle.hpp"
#include "sim/studies/bode/loop.hpp"

namespace drycut::sim::studies {

/// Table and margins as text.
std::string bode_report(const LoopResult& result);
/// The gain margin over the amplitude, and where a limit cycle begins.
std::string limit_cycle_text(const LimitCycle& cycle);
/// What may be written into the folder of a measurement.
inline const std::vector<std::string> bode_files = {"bode.csv", "report.html", "plots/",
                                                    record::verdict_file};
/// What came of it: `faults` are what fails it, `checks` the limits that it was judged by.
record::Verdict verdict_of(const LoopResult& result, const std::vector<std::string>& faults,
                           const std::vector<record::CheckResult>& checks);
/// Writes report.html and plots/ into `folder`; `cycle` may be null; `fmi_step`: fmi_step_text(), or "".
/// Throws std::runtime_error if something cannot be written.
void write_bode_report(const LoopResult& result, const LimitCycle* cycle, const record::Verdict& verdict,
                       const std::vector<record::CheckResult>& checks, const std::string& fmi_step,
                       const scenario::Scenario& scenario, OutputFolder& folder);
inline constexpr std::string_view bode_csv_header =
    "frequency [Hz],open_loop.gain [dB],open_loop.phase [deg],closed_loop.gain [dB],closed_loop.phase "
    "[deg],sensitivity.gain [dB],error";
/// A table that begins with these columns, one row a frequency: gains and phases of open loop, closed loop,
/// sensitivity and speed.
std::string bode_csv(const LoopResult& result);
/// A panel of the gain and one of the phase over the logarithm of the frequency, without curves.
renders::Plot empty_bode_plot(const std::string& name, const std::string& title);
/// The loops of `result` in it.
renders::Plot bode_plot(const LoopResult& result, const std::string& name);

}  // namespace drycut::sim::studies
