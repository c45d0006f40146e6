// --help, drycut help and --version: what they say is so, and fits a terminal.
#include "sim/cli/help.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "sim/cli/commands.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::cli {
namespace {

using testing::HasSubstr;

std::string in_one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

struct Help : CommandTest {
  Help() { add_commands(program, status); }
  int parse(const std::vector<std::string>& words) {
    CLI::App fresh{"drycut"};
    int result = all_passed;
    add_commands(fresh, result);
    return captured([&] {
      try {
        fresh.parse(std::vector<std::string>(words.rbegin(), words.rend()));
      } catch (const CLI::Error& error) {
        ADD_FAILURE() << error.get_name() << ": " << error.what();
      }
      return result;
    });
  }
  std::vector<const CLI::App*> commands() {
    const auto all = program.get_subcommands([](const CLI::App*) { return true; });
    return {all.begin(), all.end()};
  }
  CLI::App program{"drycut"};
  int status = all_passed;
};

TEST_F(Help, FitsATerminal) {
  auto pages = commands();
  pages.push_back(&program);
  EXPECT_GT(pages.size(), 18U);
  for (const auto* page : pages) {
    const auto text = page->help();
    for (const auto& line : split_lines(text))
      EXPECT_LE(line.size(), 80U) << page->get_name() << ": " << line;
    EXPECT_THAT(text, HasSubstr("xit status")) << page->get_name();
  }
}

TEST_F(Help, TellsEveryOptionWithItsDefault) {
  for (const auto* command : commands()) {
    const auto text = command->help();
    for (const auto* option : command->get_options()) EXPECT_THAT(text, HasSubstr("  " + spelling(*option)));
    EXPECT_THAT(in_one_line(text), HasSubstr(in_one_line(command->get_description())));
  }
  EXPECT_THAT(program.get_subcommand("run")->help(), HasSubstr("Directory for the results (default: out)"));
  EXPECT_THAT(program.help(), HasSubstr("\n  run                     Run scenarios\n"));
}

TEST_F(Help, ExamplesHaveOptionsThatThereAre) {
  for (const auto* command : commands()) {
    for (const auto line : examples_of(command->get_name())) {
      for (const auto& word : split_words(line, {}, " ")) {
        if (word.text.starts_with("--")) {
          EXPECT_NE(command->get_option_no_throw(std::string(word.text)), nullptr) << line;
        }
      }
      if (!line.starts_with(' ')) {
        EXPECT_TRUE(line.starts_with("drycut " + command->get_name() + " ")) << line;
      }
    }
  }
}

TEST_F(Help, KnowsCommandsAndPages) {
  EXPECT_EQ(parse({"help"}), all_passed);
  EXPECT_THAT(out, HasSubstr("\n  envelopes               "));
  EXPECT_EQ(parse({"help", "envelopes"}), all_passed);
  EXPECT_THAT(out, testing::StartsWith("# "));
  EXPECT_EQ(parse({"help", "bode"}), all_passed);
  EXPECT_THAT(out, HasSubstr("drycut bode scenario [options]"));
  EXPECT_EQ(parse({"help", "live"}), all_passed);  // both
  EXPECT_THAT(out, HasSubstr("drycut live"));
  EXPECT_THAT(out, HasSubstr("# The live line"));
  EXPECT_EQ(parse({"help", "CAMMING4"}), all_passed);
  EXPECT_THAT(out, testing::StartsWith("# CAMMING4"));
  EXPECT_EQ(parse({"help", "rotary_knife"}), all_passed);
  EXPECT_THAT(out, HasSubstr("circumference"));
  EXPECT_EQ(parse({"help", "decam"}), all_passed);
  EXPECT_THAT(out, HasSubstr("DECAM"));
  EXPECT_EQ(parse({"help", "envelops"}), bad_input);
  EXPECT_THAT(err, HasSubstr("there is no page 'envelops'; did you mean envelopes?"));
}

TEST_F(Help, VersionSaysWhatItWasMadeFrom) {
  const auto text = version_text();
  EXPECT_THAT(text, testing::StartsWith("drycut 0."));
  for (const auto* part : {"\ncommit ", "\ncompiler ", "(float64)", "Eigen 3.", "HDF5 1.", "CLI11 "})
    EXPECT_THAT(text, HasSubstr(part));
}

}  // namespace
}  // namespace drycut::sim::cli
