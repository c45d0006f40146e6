#include "devices/qmove/cnf.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "devices/qmove/cnf_parser.hpp"

namespace drycut::devices::qmove {

namespace {

constexpr int max_count = 65535;
constexpr std::int64_t max_cells = 4'000'000;
constexpr int max_slot = 99;
constexpr std::string_view sizes = "F, B, W, L or S";

// The unsigned decimal number in `text` (0004 is 4), capped where it is beyond every range we have.
std::optional<std::int64_t> digits(std::string_view text) {
  constexpr std::int64_t cap = 1'000'000'000'000;
  if (text.empty() || !std::all_of(text.begin(), text.end(), is_digit)) return std::nullopt;
  std::int64_t value = 0;
  for (const char c : text) value = std::min(value * 10 + (c - '0'), cap);
  return value;
}

}  // namespace

Configuration parse_configuration(std::string_view text, const std::string& file_name,
                                  std::span<const CatalogueEntry> catalogue, Problems& problems) {
  auto configuration = CnfParser(file_name, catalogue, problems).parse(text);
  configuration.text = text;
  return configuration;
}

CnfParser::CnfParser(const std::string& file, std::span<const CatalogueEntry> catalogue, Problems& problems)
    : Complaints(file, problems), catalogue_(catalogue) {
  configuration_.file = file_;
}

const std::vector<CnfParser::Keyword>& CnfParser::keywords() {
  static const std::vector<Keyword> table = {
      {"CONST", Section::constants},      {"SYSTEM", Section::system},
      {"GLOBAL", Section::global},        {"ARRSYS", Section::system_arrays},
      {"ARRGBL", Section::global_arrays}, {"TIMER", Section::timers},
      {"DATAGROUP", Section::groups},     {"BUS", Section::bus},
      {"INPUT", Section::inputs},         {"OUTPUT", Section::outputs},
      {"INTDEVICE", Section::devices},    {"END", Section::end}};
  return table;
}

std::vector<std::string> CnfParser::section_names() {
  std::vector<std::string> names;
  for (const Keyword& keyword : keywords()) names.emplace_back(keyword.word);
  return names;
}

Configuration CnfParser::parse(std::string_view text) {
  const std::vector<std::string_view> lines = split_lines(text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string_view line = lines[i].substr(0, lines[i].find(';'));
    const Words words = split_words(line, {static_cast<int>(i) + 1, 1}, " \t\r\f\v");
    if (words.empty()) continue;
    last_ = {words.back().place.line, words.back().place.column + static_cast<int>(words.back().text.size())};
    if (!keyword(words)) entry(words);
  }
  close_groups();
  if (section_ != Section::end)
    complain("cnf.syntax"_code, last_, "the configuration has no END",
             "write END on a line of its own after the last entry");
  check_bus();
  sort();
  return std::move(configuration_);
}

// Takes a line that begins with a section keyword.
bool CnfParser::keyword(const Words& words) {
  if (section_ == Section::end) return false;
  const auto found = std::find_if(keywords().begin(), keywords().end(), [&](const Keyword& candidate) {
    return same_word(candidate.word, words[0].text);
  });
  if (found == keywords().end()) return false;
  if (words.size() > 1)
    complain("cnf.syntax"_code, words[1].place,
             fmt::format("unexpected {} after {}", in_quotes(words[1].text), found->word),
             fmt::format("{} stands alone on its line, entries below it", found->word));
  close_groups();
  section_ = found->section;
  if (section_ == Section::bus && !bus_seen_) bus_place_ = words[0].place;
  bus_seen_ = bus_seen_ || section_ == Section::bus;
  return true;
}

void CnfParser::entry(const Words& words) {
  // A lone word where entries have several fields was meant as a section keyword.
  const bool lone_name_is_entry = section_ == Section::timers || section_ == Section::groups;
  if (section_ != Section::end && words.size() == 1 && !lone_name_is_entry && is_identifier(words[0].text) &&
      (section_ == Section::none || section_ == Section::unknown ||
       !nearest(words[0].text.substr(0, 40), section_names()).empty())) {
    complain("cnf.unknown-name"_code, words[0].place, "unknown section " + in_quotes(words[0].text),
             suggestion(words[0].text, section_names(), "sections are " + listed(section_names())));
    section_ = Section::unknown;
    return;
  }
  switch (section_) {
    case Section::none:
      complain("cnf.syntax"_code, words[0].place, in_quotes(words[0].text) + " stands before any section",
               "begin with one of " + listed(section_names()) + ", or put ';' before a comment");
      section_ = Section::unknown;
      return;
    case Section::unknown:
      return;
    case Section::constants:
      return constant(words);
    case Section::system:
      return scalar(words, true);
    case Section::global:
      return scalar(words, false);
    case Section::system_arrays:
      return array(words, true);
    case Section::global_arrays:
      return array(words, false);
    case Section::timers:
      return timer(words);
    case Section::groups:
      return group_line(words);
    case Section::bus:
      return slot(words);
    case Section::inputs:
      return terminal(words, Kind::input);
    case Section::outputs:
      return terminal(words, Kind::output);
    case Section::devices:
      return device(words);
    case Section::end:
      if (!said_after_end_)
        complain("cnf.syntax"_code, words[0].place, in_quotes(words[0].text) + " stands after END",
                 "only comments may follow END; move END to the end of the file");
      said_after_end_ = true;
      return;
  }
}

void CnfParser::constant(const Words& words) {
  if (words.size() < 2) {
    complain("cnf.syntax"_code, words[0].place, in_quotes(words[0].text) + " has no value",
             "write: <name> <number>");
    return;
  }
  const bool extra = !no_more_than(words, 2, "<name> <number>");
  const bool named = declare(words[0]);
  const std::string_view text = words[1].text;
  const bool negative = text.front() == '-';
  const std::string_view number = text.substr(negative || text.front() == '+' ? 1 : 0);
  const std::size_t point = number.find('.');
  const std::string_view whole = number.substr(0, point);
  const std::string_view part = point == std::string_view::npos ? "0" : number.substr(point + 1);
  if (!digits(whole) || !digits(part)) {
    complain("cnf.syntax"_code, words[1].place, in_quotes(text) + " is not a number",
             "write a decimal number, such as 100 or -2.5");
    return;
  }
  CnfConstant constant{words[0].text, 0, point != std::string_view::npos, words[0].place};
  if (std::from_chars(number.data(), number.data() + number.size(), constant.value).ec != std::errc{})
    constant.value = std::numeric_limits<double>::infinity();
  if (negative) constant.value = -constant.value;
  const double lowest = constant.real ? -std::numeric_limits<float>::max() : -2147483648.0;
  const double highest = constant.real ? std::numeric_limits<float>::max() : 2147483647.0;
  if (constant.value < lowest || constant.value > highest) {
    complain("cnf.value"_code, words[1].place, in_quotes(text) + " is out of range",
             constant.real ? "a single goes to 3.4e38" : "a long goes from -2147483648 to 2147483647");
    return;
  }
  if (named && !extra) configuration_.constants.push_back(std::move(constant));
}

void CnfParser::scalar(const Words& words, bool retentive) {
  if (words.size() < 2) {
    complain("cnf.syntax"_code, words[0].place, in_quotes(words[0].text) + " has no type",
             fmt::format("write: <name> <type>, the type is {}", sizes));
    return;
  }
  no_more_than(words, 2, "<name> <type>");
  const bool named = declare(words[0]);
  const std::optional<Size> type = size(words[1]);
  if (named && type && reserve(1, words[0]))
    configuration_.scalars.push_back({words[0].text, *type, retentive, words[0].place});
}

void CnfParser::array(const Words& words, bool retentive) {
  if (words.size() < 3) {
    complain("cnf.syntax"_code, words[0].place,
             fmt::format("{} has no {}", in_quotes(words[0].text), words.size() < 2 ? "type" : "length"),
             fmt::format("write: <name> <type> <length>, the type is {}", sizes));
    return;
  }
  no_more_than(words, 3, "<name> <type> <length>");
  const bool named = declare(words[0]);
  const std::optional<Size> type = size(words[1]);
  const std::optional<int> length = count(words[2], "the length of an array");
  if (named && type && length && reserve(*length, words[0]))
    configuration_.arrays.push_back({words[0].text, *type, *length, retentive, words[0].place});
}

void CnfParser::timer(const Words& words) {
  no_more_than(words, 1, "<name>, a timer has no type");
  if (declare(words[0])) configuration_.timers.push_back({words[0].text, words[0].place});
}

void CnfParser::slot(const Words& words) {
  const std::optional<std::int64_t> number = digits(words[0].text);
  if (!number || *number < 1 || *number > max_slot) {
    bus_faulty_ = true;
    complain("cnf.value"_code, words[0].place, in_quotes(words[0].text) + " is not a slot number",
             fmt::format("write: <slot> <card> <firmware>, the slot from 1 to {}", max_slot));
    return;
  }
  const auto same = std::find_if(configuration_.slots.begin(), configuration_.slots.end(),
                                 [&](const Slot& other) { return other.number == *number; });
  if (same != configuration_.slots.end()) {
    complain("cnf.declared-twice"_code, words[0].place, fmt::format("slot {} is declared twice", *number),
             fmt::format("the first stands in line {}", same->place.line));
    return;
  }
  Slot slot{static_cast<int>(*number), {}, {}, words[0].place};
  const bool empty = words.size() < 2 || words[1].text == "." || words[1].text == ":";
  no_more_than(words, empty ? 2 : 3, "<slot> <card> <firmware>, or <slot> . for an empty slot");
  if (!empty) {
    slot.card = words[1].text;
    if (words.size() < 3)
      complain("cnf.syntax"_code, words[1].place,
               fmt::format("the card {} has no firmware number", in_quotes(words[1].text)),
               "write: <slot> <card> <firmware>, such as 1 1CPUB 02");
    else
      slot.firmware = words[2].text;
  }
  configuration_.slots.push_back(std::move(slot));
}

void CnfParser::terminal(const Words& words, Kind kind) {
  const std::string form = fmt::format("<name> F <slot>.{}nn", kind == Kind::input ? "INP" : "OUT");
  if (words.size() < 3) {
    complain("cnf.syntax"_code, words[0].place,
             fmt::format("{} has no {}", in_quotes(words[0].text), words.size() < 2 ? "type" : "address"),
             "write: " + form);
    return;
  }
  no_more_than(words, 3, form);
  const bool named = declare(words[0]);
  const std::optional<Size> type = size(words[1]);
  if (type && *type != Size::F)
    complain("cnf.value"_code, words[1].place,
             fmt::format("a {} is one bit, not {}", name_of(kind), in_quotes(words[1].text)),
             "its type is F");
  const std::optional<Address> address = parse_address(words[2].text);
  if (!address || address->kind != kind) {
    complain("cnf.value"_code, words[2].place,
             fmt::format("{} is not the address of a {}", in_quotes(words[2].text), name_of(kind)),
             "write: " + form);
    return;
  }
  slot_uses_.push_back({address->slot, words[2]});
  if (kind == Kind::output) sole_output(*address, words[2]);
  if (!named || type != Size::F) return;
  auto& terminals = kind == Kind::input ? configuration_.inputs : configuration_.outputs;
  terminals.push_back({words[0].text, *address, words[0].place});
}

bool CnfParser::no_more_than(const Words& words, std::size_t count, const std::string& form) {
  if (words.size() <= count) return true;
  complain("cnf.syntax"_code, words[count].place, "unexpected " + in_quotes(words[count].text),
           "write: " + form + "; one entry a line, comments after ';'");
  return false;
}

// Enters a name; false if it cannot be one or is taken, which is then said.
bool CnfParser::declare(const Word& name) {
  if (!is_identifier(name.text)) {
    complain("cnf.syntax"_code, name.place, in_quotes(name.text) + " is not a name",
             "a name is letters, digits and _ and begins with a letter");
    return false;
  }
  if (is_reserved(name.text) || same_word(name.text, "QMOS")) {
    complain("cnf.syntax"_code, name.place, in_quotes(name.text) + " is a word of the language",
             "choose another name");
    return false;
  }
  const auto [entry, is_new] = declared_.emplace(lower(name.text), name.place);
  if (!is_new)
    complain("cnf.declared-twice"_code, name.place, in_quotes(name.text) + " is declared twice",
             fmt::format("the first stands in line {}; choose another name", entry->second.line));
  return is_new;
}

std::optional<Size> CnfParser::size(const Word& word) {
  constexpr std::string_view letters = "FBWLS";
  if (word.text.size() == 1 && letters.find(upper(word.text)[0]) != std::string_view::npos)
    return static_cast<Size>(upper(word.text)[0]);
  complain("cnf.unknown-name"_code, word.place, "unknown type " + in_quotes(word.text),
           fmt::format("the type is {}", sizes));
  return std::nullopt;
}

std::optional<int> CnfParser::count(const Word& word, std::string_view of_what) {
  const std::optional<std::int64_t> value = digits(word.text);
  if (!value || *value < 1 || *value > max_count) {
    complain("cnf.value"_code, word.place, fmt::format("{} cannot be {}", in_quotes(word.text), of_what),
             fmt::format("write a whole number from 1 to {}", max_count));
    return std::nullopt;
  }
  return static_cast<int>(*value);
}

// Memory is finite, and a slip of the finger must not ask for gigabytes.
bool CnfParser::reserve(std::int64_t cells, const Word& word) {
  if (cells_ + cells > max_cells) {
    complain(
        "cnf.value"_code, word.place,
        fmt::format("{} does not fit: {} values are declared with it", in_quotes(word.text), cells_ + cells),
        fmt::format("a configuration holds at most {} values", max_cells));
    return false;
  }
  cells_ += cells;
  return true;
}

}  // namespace drycut::devices::qmove
