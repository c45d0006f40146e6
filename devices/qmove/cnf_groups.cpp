#include <cstddef>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "devices/qmove/cnf_parser.hpp"

// The DATAGROUP section of the .CNF: several lines make one group, so that it needs a little memory.
namespace drycut::devices::qmove {

void CnfParser::group_line(const Words& words) {
  const bool is_recipes = same_word(words[0].text, "DATAPROGRAM");
  const bool is_steps = same_word(words[0].text, "STEP");
  if (group_part_ == GroupPart::name) {
    if (is_recipes || is_steps) {
      complain("cnf.syntax"_code, words[0].place, upper(words[0].text) + " before the name of a datagroup",
               "write the datagroup's name on the line before DATAPROGRAM");
      group_part_ = is_recipes ? GroupPart::recipes : GroupPart::steps;
      configuration_.groups.push_back({{}, 0, 0, {}, {}, words[0].place});
      return group_count(words, 1, is_recipes ? GroupPart::statics : GroupPart::stepped);
    }
    return group_name(words);
  }
  // The count may stand on the line after its keyword.
  if (group_part_ == GroupPart::recipes && !is_recipes && configuration_.groups.back().recipes == -1)
    return group_count(words, 0, GroupPart::statics);
  if (group_part_ == GroupPart::steps) return group_count(words, 0, GroupPart::stepped);
  if (is_recipes && group_part_ == GroupPart::recipes) return group_count(words, 1, GroupPart::statics);
  if (is_steps && group_part_ == GroupPart::statics) {
    group_part_ = GroupPart::steps;
    return group_count(words, 1, GroupPart::stepped);
  }
  if (is_recipes || is_steps) {
    complain("cnf.syntax"_code, words[0].place, upper(words[0].text) + " out of place",
             "a datagroup is: name, DATAPROGRAM <recipes>, variables, STEP <steps>, variables");
    return;
  }
  if (group_part_ == GroupPart::recipes) {
    complain("cnf.syntax"_code, words[0].place,
             fmt::format("{} instead of DATAPROGRAM", in_quotes(words[0].text)),
             "write DATAPROGRAM <recipes> after the datagroup's name");
    group_part_ = GroupPart::statics;
  }
  // A name alone begins the next group, once this one has variables.
  const DataGroup& group = configuration_.groups.back();
  if (words.size() == 1 && !(group.statics.empty() && group.stepped.empty())) {
    close_groups();
    return group_name(words);
  }
  group_variable(words);
}

void CnfParser::group_name(const Words& words) {
  no_more_than(words, 1, "the datagroup's name alone, then DATAPROGRAM <recipes>");
  declare(words[0]);
  configuration_.groups.push_back({words[0].text, 0, 0, {}, {}, words[0].place});
  group_part_ = GroupPart::recipes;
}

// Reads the count of recipes or steps from words[first], or leaves it to the next line.
void CnfParser::group_count(const Words& words, std::size_t first, GroupPart next) {
  const bool recipes = next == GroupPart::statics;
  DataGroup& group = configuration_.groups.back();
  int& target = recipes ? group.recipes : group.steps;
  if (words.size() <= first) {
    target = -1;
    return;
  }
  no_more_than(words, first + 1, recipes ? "DATAPROGRAM <recipes>" : "STEP <steps>");
  target = count(words[first], recipes ? "the number of recipes" : "the number of steps").value_or(0);
  group_part_ = next;
}

void CnfParser::group_variable(const Words& words) {
  if (words.size() < 2) {
    complain("cnf.syntax"_code, words[0].place, in_quotes(words[0].text) + " has no type",
             "write: <name> <type>, the type is F, B, W, L or S");
    return;
  }
  no_more_than(words, 2, "<name> <type>");
  const bool named = declare(words[0]);
  const std::optional<Size> type = size(words[1]);
  if (!named || !type) return;
  DataGroup& group = configuration_.groups.back();
  const bool stepped = group_part_ == GroupPart::stepped;
  // A faulty count has been named already; the variable is kept so that modules can be checked.
  const std::int64_t cells = std::int64_t{group.recipes} * (stepped ? group.steps : 1);
  if (cells > 0 && !reserve(cells, words[0])) return;
  (stepped ? group.stepped : group.statics).push_back({words[0].text, *type, words[0].place});
}

// Ends the open group: a group without its counts is not one.
void CnfParser::close_groups() {
  if (configuration_.groups.empty()) return;
  DataGroup& group = configuration_.groups.back();
  if (group_part_ == GroupPart::recipes)
    complain("cnf.syntax"_code, group.place,
             fmt::format("the datagroup {} has no DATAPROGRAM{}", in_quotes(group.name),
                         group.recipes == -1 ? " count" : ""),
             "write DATAPROGRAM <recipes> below its name");
  if (group_part_ == GroupPart::steps)
    complain("cnf.syntax"_code, group.place,
             fmt::format("the datagroup {} has no STEP count", in_quotes(group.name)), "write STEP <steps>");
  group.recipes = std::max(group.recipes, 0);
  group.steps = std::max(group.steps, 0);
  group_part_ = GroupPart::name;
}

}  // namespace drycut::devices::qmove
