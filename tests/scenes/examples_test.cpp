// The manuals' own programs, run unmodified. They are not part of the product: where they are absent these
// tests skip. And programs as a user would write them, of some hundred lines.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "devices/qmove/catalogue.hpp"
#include "devices/qmove/tests.hpp"
#include "sim/loop/simulation.hpp"

namespace drycut::sim {
namespace {

namespace fs = std::filesystem;

fs::path examples() {
  if (const char* folder = std::getenv("DRYCUT_EXAMPLES")) return folder;
  return fs::path(DRYCUT_SOURCE_DIR).parent_path() / "shared" / "examples";
}

/// Runs a scenario with EXAMPLES replaced by where the manuals' programs are; each check has to pass.
void run_scene(const fs::path& file) {
  std::ifstream stream(file);
  ASSERT_TRUE(stream) << file;
  std::stringstream buffer;
  buffer << stream.rdbuf();
  auto text = buffer.str();
  const std::string placeholder = "EXAMPLES";
  for (auto at = text.find(placeholder); at != std::string::npos; at = text.find(placeholder, at)) {
    text.replace(at, placeholder.size(), examples().string());
  }
  Problems problems;
  const auto scenario = scenario::read_scenario_text(text, file, {}, problems);
  ASSERT_TRUE(problems.empty()) << to_string(problems.front());
  loop::Simulation simulation(scenario, problems);
  ASSERT_TRUE(problems.empty()) << to_string(problems.front());
  const auto outcome = simulation.run();
  EXPECT_EQ(outcome.failure, "");
  EXPECT_FALSE(outcome.checks.empty());
  for (const auto& check : outcome.checks) {
    EXPECT_TRUE(check.passed) << check.name << ": " << check.detail
                              << (check.at ? " at " + std::to_string(*check.at) : "");
  }
}

/// tests/scenes/examples/<name>.yaml.
void run(const std::string& name) {
  if (!fs::exists(examples())) GTEST_SKIP() << "the manuals' programs are not here";
  run_scene(fs::path(DRYCUT_SOURCE_DIR) / "tests/scenes/examples" / (name + ".yaml"));
}

/// tests/scenes/programs/<name>.yaml.
void run_program(const std::string& name) {
  run_scene(fs::path(DRYCUT_SOURCE_DIR) / "tests/scenes/programs" / (name + ".yaml"));
}

TEST(WholePrograms, StopOrdersInQcl) { run_program("stop_orders"); }
TEST(WholePrograms, StopOrdersInQclPassTheirOwnTests) {
  namespace qmove = devices::qmove;
  const auto folder = fs::path(DRYCUT_SOURCE_DIR) / "tests/scenes/programs";
  const auto text = [&](const char* name) {
    std::stringstream buffer;
    buffer << std::ifstream(folder / name).rdbuf();
    return buffer.str();
  };
  Problems problems;
  const auto configuration =
      qmove::parse_configuration(text("stop_orders.cnf"), "stop_orders.cnf", devices::catalogue(), problems);
  const std::vector modules{qmove::compile_module(text("stop_shift.mod"), "stop_shift.mod", configuration,
                                                  devices::catalogue(), problems, true)};
  ASSERT_TRUE(problems.empty()) << to_string(problems.front());
  const auto results = qmove::run_tests(configuration, modules, devices::catalogue(), {}, nullptr);
  EXPECT_EQ(results.size(), 4U);
  for (const auto& result : results) {
    EXPECT_TRUE(result.passed()) << result.name << ": " << to_string(result.log.failures.front());
    EXPECT_GT(result.log.assertions, 0) << result.name;
  }
}
TEST(WholePrograms, SawOrdersInAnInstructionList) { run_program("saw_orders"); }

TEST(Examples, Camming4Startup) { run("camming4_startup"); }
TEST(Examples, Camming4Jog) { run("camming4_jog"); }
TEST(Examples, Camming4Datagroup) { run("camming4_datagroup"); }
TEST(Examples, Camming4SimulatedMaster) { run("camming4_simulated_master"); }
TEST(Examples, Epicpos) { run("epicpos"); }
TEST(Examples, Oopos2) { run("oopos2"); }
TEST(Examples, Delcnt) { run("delcnt"); }

}  // namespace
}  // namespace drycut::sim
