#pragma once
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <map>

#include "sim/cli/size_command.hpp"
#include "sim/studies/recorded_csv.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::cli {

using SizeRow = std::map<std::string, std::string>;

inline double number(const SizeRow& row, const std::string& column) {
  const auto found = row.find(column);
  EXPECT_NE(found, row.end()) << column;
  return found == row.end() ? NAN : studies::number_of(found->second).value_or(NAN);
}

struct SizeCommand : CommandTest {
  SizeCommand() {
    // 8 s of the knife under an LX3VP: pulses drive the servo, its encoder is not counted.
    folder.file("pulses.yaml",
                "extends: " + shipped("rotary_knife_lx3vp.yaml") + "\nscene: {duration: 8 s}\n");
    // The same under a CAMMING4, which counts the motor's encoder: 2048 lines behind gear 5.
    folder.file("counted.yaml", "extends: " + shipped("rotary_knife.yaml") + "\nscene: {duration: 6 s}\n");
    options.scenario = folder / "pulses.yaml";
    options.out = folder / "out";
    options.motors = "HG-SR202";
    options.jobs = 2;
  }
  static std::string shipped(const std::string& name) { return (source_root / "scenes" / name).string(); }
  static std::string text_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  int run() {
    return captured([&] { return size_drive(options); });
  }
  /// size.csv, a map from the heading a row.
  std::vector<SizeRow> rows() const {
    Problems problems;
    cams::TableProblems broken("size.csv", problems);
    const auto text = text_of(options.out / "size.csv");
    studies::CsvRows lines(text, broken);
    studies::CsvRow heading;
    studies::CsvRow line;
    std::vector<SizeRow> found;
    EXPECT_TRUE(lines.next(heading));
    while (lines.next(line)) {
      EXPECT_EQ(line.cells.size(), heading.cells.size());
      auto& row = found.emplace_back();
      for (std::size_t i = 0; i < std::min(line.cells.size(), heading.cells.size()); ++i)
        row[heading.cells[i].text] = line.cells[i].text;
    }
    EXPECT_EQ(lines_of(problems), "");
    return found;
  }
  /// The row of a motor and a gear.
  SizeRow row(const std::string& motor, const std::string& gear) const {
    for (auto& found : rows())
      if (found["motor"] == motor && found["gear ratio"] == gear) return found;
    ADD_FAILURE() << motor << ", gear " << gear;
    return {};
  }

  TestFolder folder;
  SizeOptions options;
};

}  // namespace drycut::sim::cli
