#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "devices/qmove/catalogue.hpp"
#include "devices/qmove/qmove_controller.hpp"

// The manuals' programs, in the folder that the environment variable DRYCUT_EXAMPLES names, else beside the
// checkout. They are not part of the product: where they are absent these tests skip.
namespace drycut::devices::qmove {
namespace {

std::filesystem::path examples() {
  if (const char* folder = std::getenv("DRYCUT_EXAMPLES")) return folder;
  return std::filesystem::path(DRYCUT_SOURCE_DIR).parent_path() / "shared" / "examples";
}

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

struct Example {
  std::string configuration;
  std::string module;
};

void PrintTo(const Example& example, std::ostream* out) { *out << example.module; }

class QmoveExamples : public ::testing::TestWithParam<Example> {};

TEST_P(QmoveExamples, CompileWithoutAProblem) {
  const std::filesystem::path cnf = examples() / GetParam().configuration;
  const std::filesystem::path mod = examples() / GetParam().module;
  if (!std::filesystem::exists(cnf) || !std::filesystem::exists(mod)) GTEST_SKIP() << "no " << cnf;
  Problems problems;
  const Configuration configuration =
      parse_configuration(contents(cnf), cnf.filename(), catalogue(), problems);
  for (const Problem& problem : problems)
    if (problem.what.starts_with("unknown device type")) GTEST_SKIP() << to_string(problem);
  const QclProgram program =
      compile_module(contents(mod), mod.filename(), configuration, catalogue(), problems);
  for (const Problem& problem : problems) ADD_FAILURE() << to_string(problem);
  EXPECT_FALSE(program.code.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Manuals, QmoveExamples,
    ::testing::Values(Example{"camming4_startup.cnf", "camming4_startup.mod"},
                      Example{"camming4_jog.cnf", "camming4_jog.mod"},
                      Example{"camming4_datagroup.cnf", "camming4_datagroup.mod"},
                      Example{"camming4_simulated_master.cnf", "camming4_simulated_master.mod"},
                      Example{"oopos2.cnf", "oopos2.mod"}, Example{"oopos2.cnf", "delcnt.mod"},
                      Example{"epicpos.cnf", "epicpos.mod"}),
    [](const auto& example) { return example.param.module.substr(0, example.param.module.find('.')); });

}  // namespace
}  // namespace drycut::devices::qmove
