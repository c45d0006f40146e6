#include "sim/cli/usage.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <regex>
#include <string>
#include <vector>

#include "base/text.hpp"

namespace drycut::sim::cli {

namespace {

/// What an option is for: the beginning of its help.
std::string purpose_of(const CLI::Option& option) {
  const auto& text = option.get_description();
  return text.substr(0, std::min(text.find_first_of(";\n"), text.find(". ")));
}

class Usage {
 public:
  Usage(const CLI::App& app, const CLI::ParseError& error)
      : command_(app.get_subcommands().empty() ? app : *app.get_subcommands().front()),
        is_command_(&command_ != &app),
        left_(app.remaining(true)),
        error_(error) {}

  void tell() {
    if (!is_command_ && left_.empty()) {
      problem("option.missing"_code, "no command is given", "known: " + listed(commands()));
      return;
    }
    const bool unknown = unknown_options();
    if (dynamic_cast<const CLI::RequiredError*>(&error_) != nullptr)
      missing_options();
    else if (!unknown && dynamic_cast<const CLI::ExtrasError*>(&error_) != nullptr)
      stray_words();
    else if (!unknown)
      wrong_value();
  }

 private:
  void problem(Code code, const std::string& what, const std::string& remedy) const {
    fmt::print(stderr, "drycut{}: {}; {} [{}]\n", is_command_ ? ' ' + command_.get_name() : "", what, remedy,
               code.text());
  }
  [[nodiscard]] std::string help() const {
    return fmt::format("drycut{} --help says what it takes",
                       is_command_ ? ' ' + command_.get_name() : std::string());
  }

  [[nodiscard]] std::vector<std::string> commands() const {
    std::vector<std::string> names;
    for (const auto* command : command_.get_subcommands({}))
      if (!command->get_group().empty()) names.push_back(command->get_name());
    return names;
  }

  bool unknown_options() const {
    std::vector<std::string> known;
    for (const auto* option : command_.get_options())
      for (const auto& name : option->get_lnames()) known.push_back("--" + name);
    bool any = false;
    for (const auto& word : left_) {
      if (word.size() < 2 || word[0] != '-' || is_digit(word[1])) continue;
      const auto option = word.substr(0, word.find('='));
      problem("option.unknown"_code, fmt::format("there is no option {}", option),
              did_you_mean(option, known));
      any = true;
    }
    return any;
  }

  void stray_words() const {
    for (const auto& word : left_)
      problem("option.unknown"_code, fmt::format("nothing takes {}", in_quotes(word)), help());
  }

  void missing_options() const {
    for (const auto* option : command_.get_options()) {
      const bool named = error_.what() == option->get_name() + " is required";
      if ((!option->get_required() && !named) || option->count() > 0) continue;
      problem("option.missing"_code,
              fmt::format("{} {} missing", option->get_name(),
                          option->get_expected_max() > 1 && option->get_positional() ? "are" : "is"),
              "give it: " + purpose_of(*option));
    }
  }

  /// Of an option that is known.
  void wrong_value() const {
    const std::string text = error_.what();
    std::smatch part;
    using std::regex;
    if (std::regex_match(text, part, regex("(--[^:]*): .* required .* missing"))) {
      const auto* option = command_.get_option_no_throw(part[1]);
      problem("option.missing"_code, fmt::format("{} has no value", part[1].str()),
              option == nullptr ? help() : "give one: " + purpose_of(*option));
    } else if (std::regex_match(text, part, regex("([^:]*): Value (.*) not in range (\\S+) to (\\S+)"))) {
      problem("option.value"_code,
              fmt::format("{}: {} is no number in its range", part[1].str(), in_quotes(part[2].str())),
              fmt::format("give {} to {}", part[3].str(), part[4].str()));
    } else if (std::regex_match(text, part, regex("([^:]*): (.*) not in \\{(.*)\\}"))) {
      std::vector<std::string> known;
      for (const auto& word : split_words(part[3].str(), {}, ",")) known.push_back(word.text);
      problem("option.unknown-choice"_code,
              fmt::format("{}: there is no {}", part[1].str(), in_quotes(part[2].str())),
              did_you_mean(part[2].str(), known));
    } else if (std::regex_match(text, part, regex("Could not convert: (\\S+) = (.*)"))) {
      problem("option.value"_code,
              fmt::format("{}: {} is no number", part[1].str(), in_quotes(part[2].str())), "give one");
    } else if (std::regex_match(text, part, regex("(.*) excludes (.*)"))) {
      problem("option.together"_code,
              fmt::format("{} and {} do not go together", part[1].str(), part[2].str()),
              "leave one of them out");
    } else if (text.find("; ") != std::string::npos) {  // one of our own
      const auto end = text.find("; ");
      problem("option.value"_code, text.substr(0, end), text.substr(end + 2));
    } else {
      problem("option.value"_code, text, help());
    }
  }

  const CLI::App& command_;
  bool is_command_;
  std::vector<std::string> left_;
  const CLI::ParseError& error_;
};

}  // namespace

void tell_usage(const CLI::App& app, const CLI::ParseError& error) { Usage(app, error).tell(); }

}  // namespace drycut::sim::cli
