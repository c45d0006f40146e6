#pragma once
#include <drycut/problem.hpp>

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drycut {

/// What a check of the scenario has come to.
struct Check {
  /// Limits that a check sets for a value of an event.
  struct Tolerance {
    std::string event;  ///< as the check names it: "cut", "knife.cut"
    std::string value;
    double low = -std::numeric_limits<double>::infinity();   ///< -infinity: no limit there
    double high = std::numeric_limits<double>::infinity();   ///< infinity: the same
    double from = 0;                                         ///< [s] events from here on count ...
    double until = std::numeric_limits<double>::infinity();  ///< ... up to there

#if __cplusplus >= 202002L
    bool operator==(const Tolerance&) const = default;
#endif
    template <typename Archive, typename Self>
    static void visit(Archive& archive, Self& self) {
      archive("event", self.event);
      archive("value", self.value);
      archive("low", self.low);
      archive("high", self.high);
      archive("from", self.from);
      archive("until", self.until);
    }
  };

  std::string name;
  Prose expectation;  ///< "each cut: abs(length - 800) <= 0.1, from 4.0 s"
  bool passed = false;
  std::optional<double> margin;          ///< how far the worst moment was from the limit; negative: beyond it
  std::string unit;                      ///< of the margin, "" if it is none or mixed
  std::optional<double> at;              ///< [s] the worst moment
  Prose detail;                          ///< in words: "15 cuts, worst length = 800.047 mm at 7.204 s"
  std::optional<double> failed_at = {};  ///< [s] first, where that can be said before the end
  std::optional<double> used = {};       ///< share of the limit at the worst moment, above 1: beyond it
  std::vector<Tolerance> tolerances = {};
  std::vector<std::string> names = {};  ///< of what it looks at: "length", "AxisX.follerr"
  bool idle = false;                    ///< it failed for it found nothing to judge
  /// Though it passed: "(gbStep == 2) was 0 at all 2601 instants: it judged nothing".
  Prose doubt = {};
  std::optional<double> too_few = {};  ///< [s] of events that it counts there were too few, from then on
  bool deadline = false;               ///< its limit is a time by which something has come
  /// It passed, but there was nothing that it could have failed by.
  [[nodiscard]] bool judged_nothing() const { return passed && !doubt.empty() && !used; }
  /// Where it held at none of its instants: what there was, "AxisX.st_error 0", "Axis.follerr -12 to 80".
  Prose throughout = {};
  bool so_far =
      false;  ///< it has held, but the run stopped before all of it could be judged: `passed` is no verdict

#if __cplusplus >= 202002L
  bool operator==(const Check&) const = default;
#endif
  /// Names every member to `archive`, as archive(key, member). Files, Python and live pages are made of this:
  /// a new member is in all of them by its line here.
  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("name", self.name);
    archive("expectation", self.expectation);
    archive("passed", self.passed);
    archive("margin", self.margin);
    archive("unit", self.unit);
    archive("at", self.at);
    archive("detail", self.detail);
    archive("failed_at", self.failed_at);
    archive("used", self.used);
    archive("tolerances", self.tolerances);
    archive("names", self.names);
    archive("idle", self.idle);
    archive("doubt", self.doubt);
    archive("too_few", self.too_few);
    archive("deadline", self.deadline);
    archive("throughout", self.throughout);
    archive("so_far", self.so_far);
  }
  /// Members that terminal, junit.xml, annotations, summary and report tell as they stand behind the margin,
  /// "late by 0.25". The others are in sentences, or for programs.
  static std::vector<std::string_view> told() { return {}; }
};

}  // namespace drycut
