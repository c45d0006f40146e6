// A worker's row is the row of what the same run left in its folder.
#include <nlohmann/json.hpp>

#include "sim/cli/run_command.hpp"
#include "sim/file.hpp"
#include "sim/studies/compare/run_folder.hpp"
#include "sim/studies/sweep/point.hpp"
#include "sim/studies/sweep/store.hpp"
#include "tests/sim/command_bench.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim::studies {
namespace {

const auto knife = std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes/rotary_knife.yaml";

struct FolderRow : CommandTest, testing::WithParamInterface<const char*> {};

TEST_P(FolderRow, IsTheRowOfAWorker) {
  Problems problems;
  PointQuestion question;
  question.file = knife;
  question.text = read_file(knife, problems).value();
  // Its drive bears too much.
  question.set = {
      {"scene.duration", "6 s"}, {"plants.knife.servo.rated_torque", "2 N m"}, {"record.format", GetParam()}};
  auto asked = nlohmann::json{{"file", question.file},
                              {"text", question.text},
                              {"rated", question.rated},
                              {"figures", nlohmann::json::array()}};
  for (const auto& [path, value] : question.set) asked["set"].push_back({path, value});
  const auto of_worker = point_answerer(asked.dump())("[]");

  TestFolder folder;
  cli::RunOptions run;
  run.scenarios = {knife};
  run.out = folder / "out";
  run.pictures = false;
  for (const auto& [path, value] : question.set) run.set.emplace_back(path).append("=").append(value);
  ASSERT_EQ(captured([&] { return cli::run_scenarios(run); }), cli::check_failed) << err;
  const auto record = read_record(folder / "out/rotary_knife", problems);
  prepare(question, problems);
  ASSERT_EQ(lines_of(problems), "");
  const auto row =
      row_of(question, read_point(question, {}).lengths, record.outcome, record.recording.events(), {});
  EXPECT_EQ(row.verdict, PointRow::Verdict::failed);
  EXPECT_EQ(row.numbers.size(), question.columns.size());
  if (question.set.back().value == "hdf5") {
    EXPECT_EQ(row_text(row), of_worker);
    return;
  }
  // Events have nine digits in CSV: half a unit of the last one of 800 mm.
  constexpr double rounded = 5e-7;
  const auto worker = parse_row(of_worker).value();
  EXPECT_EQ(row.limit, worker.limit);
  EXPECT_EQ(row.rating, worker.rating);
  for (std::size_t i = 0; i < row.numbers.size(); ++i) {
    EXPECT_EQ(std::isnan(row.numbers[i]), std::isnan(worker.numbers[i])) << question.columns[i].heading();
    if (std::isnan(row.numbers[i])) continue;
    EXPECT_NEAR(row.numbers[i], worker.numbers[i], rounded + 1e-8 * std::abs(worker.numbers[i]))
        << question.columns[i].heading();
  }
}
INSTANTIATE_TEST_SUITE_P(OfBothFormats, FolderRow, testing::Values("csv", "hdf5"));

}  // namespace
}  // namespace drycut::sim::studies
