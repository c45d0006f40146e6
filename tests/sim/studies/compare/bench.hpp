#pragma once
// Folders of runs, written by hand, so that every number in them is known.
#include <string>
#include <vector>

#include "tests/sim/command_bench.hpp"

namespace drycut::sim::studies::comparing {

namespace fs = std::filesystem;

/// What stands in the folder of a run; each text can be changed before it is written.
struct RunTexts {
  std::string trace =
      "time [s],knife.speed [m/min],AxisX.follerr [bits x4]\n"
      "0.0,60,0\n0.1,60,3\n0.2,60,-4\n";
  std::string events =
      "time [s],source,event,values\n"
      "0.050000000,knife,cut,length=900 mm; mismatch=9 mm/s\n"
      "0.100000000,knife,cut,length=800.1 mm; mismatch=1 mm/s\n"
      "0.150000000,knife,cut,length=799.9 mm; mismatch=2 mm/s\n"
      "0.200000000,timeline,set,panel.start = 1\n";
  std::string checks = checks_json(0.053, true);
  std::string scenario =
      "scene: {title: line, seed: 1}\n"
      "plants:\n  web: {type: web, speed: 60 m/min}\n"
      "timeline:\n  - {at: 1 s, set: {panel.start: 1}}\n"
      "record: {every: 100 ms, channels: [knife.speed, AxisX.follerr]}\n"
      "checks:\n  - {name: cut length, each: cut, expect: \"abs(length - 800) <= 0.2\"}\n"
      "pictures:\n  plots:\n"
      "    - {name: cuts, from: 60 ms, against: number, panels: [{title: length, event: cut, values: "
      "[length],"
      " limits: [799.8, 800.2]}]}\n";

  static std::string checks_json(double margin, bool passed) {
    return R"({"drycut": "0.1.0", "passed": )" + std::string(passed ? "true" : "false") +
           R"(, "end": 0.2, "failure": "", "checks": [{"name": "cut length", "expectation": "each cut", "passed": )" +
           (passed ? "true" : "false") + R"(, "margin": )" + std::to_string(margin) +
           R"(, "unit": "mm", "at": 0.1, "detail": "3 cut events"}]})" + "\n";
  }
};

/// `text` with `from` replaced by `to`, which must be in it.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

struct Bench : CommandTest {
  fs::path write(const std::string& name, const RunTexts& texts) const {
    const auto run = folder / name;
    fs::create_directories(run);
    test_folder.file(name + "/trace.csv", texts.trace);
    test_folder.file(name + "/events.csv", texts.events);
    test_folder.file(name + "/checks.json", texts.checks);
    test_folder.file(name + "/scenario.yaml", texts.scenario);
    return run;
  }

  TestFolder test_folder;
  const fs::path& folder = test_folder.path;
};

}  // namespace drycut::sim::studies::comparing
