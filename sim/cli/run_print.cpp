#include <fmt/format.h>

#include <algorithm>

#include "base/plain_text.hpp"
#include "base/sheet.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/paint.hpp"
#include "sim/cli/run_work.hpp"
#include "sim/studies/half_step.hpp"

namespace drycut::sim::cli {

namespace {

std::string verdict(bool passed, std::string_view word) {
  return painted(word, passed ? Paint::good : Paint::bad);
}

/// Of a run that stopped nothing is ok that has only held so far.
void print_checks(const std::vector<record::CheckResult>& checks, Say say) {
  for (const auto& check : checks) {
    if (say == Say::failures && check.passed) continue;
    const auto margin = report::margin_text(check);
    fmt::print("  {} {}: {}{}{}\n",
               check.so_far ? "held so far" : verdict(check.passed, check.passed ? "ok  " : "FAIL"),
               printable(check.name), printable(check.detail), margin.empty() ? "" : "; ", margin);
  }
}

void print_place(const report::RunResult& result) {
  fmt::print("  {}: {}\n", result.has_report ? "report" : "results",
             (result.has_report ? result.directory / "report.html" : result.directory).string());
}

}  // namespace

void print_group(const Group& group, Say say) {
  const auto& outcome = group.result.outcome;
  if (say == Say::failures && group.trouble.empty() && outcome.passed()) return;
  fmt::print("{}: {}\n", printable(group.result.name),
             !group.trouble.empty() ? group.trouble
             : outcome.checks.empty()
                 ? fmt::format("compared {} runs", group.members.size())
                 : fmt::format("{}, {}", verdict(outcome.passed(), outcome.passed() ? "passed" : "FAILED"),
                               report::verdict_text(outcome)));
  print_checks(outcome.checks, say);
  if (group.trouble.empty()) print_place(group.result);
}

void print_refused(const Refused& refused) {
  const auto count = refused.problems.size();
  fmt::print("{}: {}, its input is wrong: {} {}, told above\n", printable(refused.result.name),
             verdict(false, "NOT RUN"), count, count == 1 ? "problem" : "problems");
}

void print_result(const Job& job, Say say) {
  const auto& result = job.result;
  const bool passed = job.trouble.empty() && result.outcome.passed();
  if (say == Say::failures && passed) return;
  const auto word = !job.trouble.empty() || !result.outcome.failure.empty() ? "STOPPED"
                    : result.outcome.passed()                               ? "passed"
                                                                            : "FAILED";
  const auto cause = result.outcome.cause_code();
  fmt::print("{}: {}, {} ({} s simulated{}){}\n", printable(result.name), verdict(passed, word),
             job.trouble.empty() ? report::verdict_text(result.outcome) : job.trouble,
             record::seconds_text(result.outcome.end), job.kept_notes ? " earlier; unchanged" : "",
             cause.empty() ? "" : fmt::format(" [{}]", cause));
  print_checks(result.outcome.checks, say);
  if (say == Say::failures) return print_place(result);
  if (say == Say::more && !job.kept_notes)
    fmt::print("  simulated in {:.2f} s, {:.0f} times as fast as the machine; all of it took {:.2f} s\n",
               job.left.simulating, seconds(result.outcome.end) / std::max(job.left.simulating, 1e-6),
               job.took);
  if (result.outcome.half_step) {
    const auto margins = studies::margin_table(result.outcome, job.scenario.scene.step);
    if (!margins.rows.empty())
      fmt::print("\n  margins at half the step\n{}", renders::rows_text(margins, output_width()));
  }
  for (const auto& warning : result.outcome.warnings())
    fmt::print("  warning {}\n", printable(to_string(warning)));
  for (const auto& note : job.notes) fmt::print("  note {}\n", printable(to_string(note)));
  for (const auto& note : job.kept_notes ? *job.kept_notes : job.simulation->notes())
    fmt::print("  note {}\n", printable(to_string(note)));
  if (!job.left.left_out.empty()) print_left_out({"left out: " + job.left.left_out});
  if (!job.left.scene.empty()) fmt::print("  3D scene: {}\n", job.left.scene.string());
  print_place(result);
}

}  // namespace drycut::sim::cli
