#pragma once
#include <gmock/gmock.h>

#include <string>
#include <string_view>
#include <vector>

#include "sim/recordings/guess.hpp"
#include "sim/recordings/recording.hpp"
#include "tests/findings.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim::recordings {

/// A test of an export and of the YAML beside it.
struct RecordingTest : testing::Test {
  /// The export with that text, as `yaml` says, which follows `file: x.csv`.
  Recording loaded(const std::string& text, const std::string& yaml) {
    folder.file("x.csv", text);
    const auto file = folder.file("x.yaml", "file: x.csv\n" + yaml);
    problems.clear();
    findings.clear();
    const auto recording = read_recording_file(file, problems);
    return problems.empty() ? load(recording, problems, findings) : Recording();
  }
  /// What `drycut import` says of a text.
  std::string guessed(const std::string& text) {
    problems.clear();
    const auto made = guess(folder.file("x.csv", text), folder / "x.yaml", problems);
    return problems.empty() ? write(made) : "";
  }
  /// "2:5 recording.no-time" of every problem; of one in the export with its file.
  [[nodiscard]] std::vector<std::string> places() const {
    std::vector<std::string> all;
    for (const auto& problem : problems)
      all.push_back((problem.file.ends_with(".csv") ? "x.csv:" : "") + std::to_string(problem.line) + ":" +
                    std::to_string(problem.column) + " " + std::string(problem.code.text()));
    return all;
  }
  /// "4 recording.gap" of every finding: the line of the export that it names.
  [[nodiscard]] std::vector<std::string> doubts() const {
    std::vector<std::string> all;
    for (const auto& finding : findings) {
      const auto at = finding.text.find("x.csv:") + 6;
      all.push_back(finding.text.substr(at, finding.text.find(':', at) - at) + " " + finding.code);
    }
    return all;
  }

  TestFolder folder;
  Problems problems;
  std::vector<Finding> findings;
};

/// With `between` in place of every tab.
inline std::string separated(std::string text, char between) {
  for (char& c : text)
    if (c == '\t') c = between;
  return text;
}

// After the shape of a TwinCAT Scope export: two channels at 1 ms share a column of time, a third at 5 ms
// begins at -3 ms and ends early.
inline const std::string twincat =
    "Name\tcut\n"
    "File\tC:\\cut.csv\n"
    "Starttime of export\t132959733843760000\tMontag, 2. Mai 2022\t15:56:24.376\n"
    "Endtime of export\t132959733853750000\tMontag, 2. Mai 2022\t15:56:25.375\n"
    "\n"
    "\n"
    "Name\tActTorque\tActVelo\tName\tWeb\xC3\xA4\n"
    "SymbolComment\t\t\tSymbolComment\t\n"
    "Data-Type\tINT16\tREAL64\tData-Type\tREAL32\n"
    "SampleTime[ms]\t1\t1\tSampleTime[ms]\t5\n"
    "VariableSize\t2\t8\tVariableSize\t4\n"
    "ScaleFactor\t1\t1\tScaleFactor\t1\n"
    "Unit\t%\tmm/s (Velocity)\tUnit\t(None)\n"
    "Unit ScaleFactor\t1\t1\tUnit ScaleFactor\t-10\n"
    "Unit Offset\t0\t0\tUnit Offset\t0\n"
    "\n"
    "0\t10\t1.5\t-3\t100\n"
    "1\t11\t2.5\t2\t101\n"
    "2\t-12\t3.5\t7\t102\n"
    "3\t13\t4.5\t \t \n";

// After MR Configurator2.
inline const std::string mr_configurator2 =
    "Axis1\r\nNumber of sampling data,4\r\nSampling time interval(ms),0.667\r\n"
    "Time,Analog 1,Analog 2,Analog 3,Digital 1\r\n"
    "ms,Servo motor speed,Torque,Droop pulses (by 1 pls.),Not selected\r\n"
    "0.000000,60,25,100,0\r\n0.666666,60,50,-32768,0\r\n1.333333,120,-25,120,0\r\n2.000000,120,0,130,0\r\n";

}  // namespace drycut::sim::recordings
