#include "sim/loop/program_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "base/text.hpp"

namespace drycut::sim::loop {

std::string program_words(const devices::ProgramText& program) {
  std::string words;
  const auto text = lower(program.text);
  const bool is_st = program.language == "st";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto rest = std::string_view(text).substr(i);
    if (is_st ? rest.starts_with("//") : text[i] == ';') {
      while (i < text.size() && text[i] != '\n') ++i;
      words += '\n';
    } else if (is_st && rest.starts_with("(*")) {
      const auto end = std::min(text.find("*)", i), text.size() - 1) + 1;
      words.append(
          static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(i),
                                              text.begin() + static_cast<std::ptrdiff_t>(end), '\n')),
          '\n');
      i = end;
    } else {
      words += text[i];
    }
  }
  return words;
}

std::string code_of(const devices::ProgramText& program, int number) {
  const auto lines = split_lines(program.text);
  if (number < 1 || static_cast<std::size_t>(number) > lines.size()) return "";
  const auto line = lines[static_cast<std::size_t>(number) - 1];
  return std::string(trimmed(line.substr(0, line.find(program.language == "st" ? "//" : ";"))));
}

namespace {

bool is_word_at(const std::string& text, std::size_t at, std::size_t length) {
  const auto joins = [&](std::size_t i) { return i < text.size() && in_name(text[i]); };
  return (at == 0 || !joins(at - 1)) && !joins(at + length);
}

int times_named(const std::string& text, const std::string& word) {
  int times = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    if (is_word_at(text, at, word.size())) ++times;
  return times;
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// The names that a declaration has before `at`, where its AT or its ':' stands: "lamp" of "VAR lamp AT",
/// "first", "second" of "first, second :".
std::vector<std::string> names_before(std::string_view text, std::size_t at) {
  std::vector<std::string> names;
  const auto skip = [&] {
    while (at > 0 && is_blank(text[at - 1])) --at;
  };
  for (;;) {
    skip();
    const auto end = at;
    while (at > 0 && in_name(text[at - 1])) --at;
    if (at == end) return names;
    names.emplace_back(text.substr(at, end - at));
    skip();
    if (at == 0 || text[at - 1] != ',') return names;
    --at;
  }
}

/// "IX0.0", "QX0.0", which a program declares, and not "Knife.ready", which an axis has.
bool is_declared(const std::string& terminal) {
  return terminal.size() > 2 && (terminal[0] == 'i' || terminal[0] == 'q') && terminal[1] == 'x' &&
         is_digit(terminal[2]);
}

/// The name that a variable of Structured Text has by AT for a terminal, "" where only the terminal itself is
/// named; nothing where neither is.
std::optional<std::string> name_by_at(const std::string& words, const std::string& terminal) {
  std::optional<std::string> name;
  for (auto place = words.find("%" + terminal); place != std::string::npos;
       place = words.find("%" + terminal, place + 1)) {
    if (!is_word_at(words, place + 1, terminal.size())) continue;
    std::size_t at = place;  // behind the last letter before it
    while (at > 0 && is_blank(words[at - 1])) --at;
    const bool named = at >= 2 && words.compare(at - 2, 2, "at") == 0 && is_word_at(words, at - 2, 2);
    if (const auto names = named ? names_before(words, at - 2) : std::vector<std::string>(); !names.empty())
      return names.front();
    name = "";
  }
  return name;
}

/// The name, "" = without one or a device's, that Structured Text by AT or a configuration has for a
/// terminal; nothing where it does not have the terminal. All in small letters.
std::optional<std::string> declared_name(const std::string& language, const std::string& words,
                                         const std::string& terminal) {
  if (language == "st") return name_by_at(words, terminal);
  const auto at = language == "cnf" ? words.find(terminal) : std::string::npos;
  if (at == std::string::npos) return {};
  const auto line = words.rfind('\n', at) + 1;
  constexpr std::size_t of_terminal = 3;  // name, type, address; a device has more
  const auto fields =
      split_words(std::string_view(words).substr(line, words.find('\n', at) - line), {1, 1}, " \t");
  return fields.size() > of_terminal ? "" : fields.front().text;
}

/// As the program spells it.
std::string spelt(const std::string& name, const devices::ProgramText& program) {
  const auto at = lower(program.text).find(name);
  return at == std::string::npos ? name : program.text.substr(at, name.size());
}

/// Whether a line of a program, without comment and in small letters, may switch `name` on.
bool switches_on(const std::string& language, std::string_view line, const std::string& name) {
  const auto words = split_words(line, {1, 1}, " \t");
  if (words.empty()) return false;
  const auto is = [&](std::size_t i, std::string_view word) {
    return i < words.size() && words[i].text == word;
  };
  if (language == "il") return (is(0, "out") || is(0, "set")) && is(1, name);
  if (language == "qcl") return is(0, "setout") ? is(1, name) : is(0, name) && is(1, "=") && !is(2, "0");
  const auto assigned = line.find(":=");
  return assigned != std::string_view::npos && trimmed(line.substr(0, assigned)) == name &&
         !trimmed(line.substr(assigned + 2)).starts_with("false");
}

}  // namespace

std::vector<ReadProgram> read_programs(devices::Controller& controller) {
  std::vector<ReadProgram> read;
  for (auto& program : controller.programs()) {
    auto words = program_words(program);
    read.push_back({std::move(program), std::move(words)});
  }
  return read;
}

bool is_named(const std::string& terminal, const std::vector<ReadProgram>& programs, Named how) {
  const auto wanted = lower(terminal);
  if (wanted.find('.') != std::string::npos && is_letter(wanted.front()) && !is_declared(wanted))
    return true;  // an axis'
  for (const auto& [program, words] : programs) {
    if (program.language == "il") {
      if (how == Named::surely) return times_named(words, wanted) > 0;
      // A group of four bits and more, K2Y0, holds others; so do blocks of outputs. A cam's block has the
      // number of its synchronous output.
      for (auto k = words.find('k'); k != std::string::npos; k = words.find('k', k + 1))
        if (k + 2 < words.size() && is_digit(words[k + 1]) && words[k + 2] == 'y') return true;
      if (words.find("zrst") != std::string::npos || times_named(words, wanted) > 0) return true;
      const auto number = parsed<int>(std::string_view(wanted).substr(1), 8);
      if (number && times_named(words, fmt::format("k{}", *number)) > 0) return true;
      continue;
    }
    if (program.language == "st")
      for (const auto* whole : {"%qb", "%qw", "%qd", "%ql"})
        if (how == Named::perhaps && words.find(whole) != std::string::npos) return true;
    const auto name = declared_name(program.language, words, wanted);
    if (!name) continue;
    if (name->empty()) return true;
    // All texts of one language are one program; AT names both once.
    const bool is_st = program.language == "st";
    int times = is_st ? -2 : 0;
    for (const auto& [other, other_words] : programs)
      if (other.language == (is_st ? "st" : "qcl"))
        times += times_named(other_words, *name) + (is_st ? times_named(other_words, wanted) : 0);
    return times > 0;
  }
  return false;
}

bool is_unread(const std::string& terminal, const std::vector<ReadProgram>& programs) {
  return !programs.empty() && std::all_of(programs.begin(), programs.end(), [&](const ReadProgram& read) {
    return read.program.language == "il" && times_named(read.words, lower(terminal)) == 0;
  });
}

std::string name_in_program(const std::string& terminal, const std::vector<ReadProgram>& programs) {
  for (const auto& [program, words] : programs)
    if (const auto name = declared_name(program.language, words, lower(terminal)); name && !name->empty())
      return spelt(*name, program);
  return "";
}

namespace {

/// Whether one of the calls of an instance has this argument, without blanks.
bool calls_with(const std::string& words, const std::string& name, const std::string& argument) {
  for (auto call = words.find(name + "("); call != std::string::npos;
       call = words.find(name + "(", call + 1)) {
    auto arguments = words.substr(call, words.find(')', call) - call);
    std::erase_if(arguments, is_blank);
    if (is_word_at(words, call, name.size()) && arguments.find(argument) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

bool calls_block(const std::vector<ReadProgram>& programs, const std::string& type, const std::string& axis) {
  for (const auto& [program, words] : programs) {
    if (program.language != "st") continue;
    for (auto at = words.find(type); at != std::string::npos; at = words.find(type, at + 1)) {
      const auto colon = words.find_last_not_of(" \t\n\r", at - 1);
      if (at == 0 || colon == std::string::npos || words[colon] != ':') continue;
      for (const auto& name : names_before(words, colon))
        if (calls_with(words, name, "axis:=" + lower(axis))) return true;
    }
  }
  return false;
}

bool presets(devices::Controller& controller, const std::string& axis) {
  const auto programs = controller.programs();
  return std::any_of(programs.begin(), programs.end(), [&](const devices::ProgramText& program) {
    return program.language == "qcl" &&
           program_words(program).find("preset " + lower(axis)) != std::string::npos;
  });
}

std::string switched_on_by(devices::Controller& controller, const std::string& terminal) {
  const auto programs = read_programs(controller);
  const auto given = name_in_program(terminal, programs);
  std::vector<std::string> places;
  for (const auto& [program, words] : programs) {
    const auto name = lower(program.language == "il" ? terminal : given);
    if (name.empty() || program.language == "cnf") continue;
    int number = 0;
    for (const auto line : split_lines(words)) {
      ++number;
      if (!switches_on(program.language, line, name)) continue;
      // What it depends on stands before it, or on the line itself.
      constexpr int near = 3;
      auto code = code_of(program, number);
      for (int above = number - 1; program.language == "qcl" && above >= number - near; --above)
        if (const auto asked = code_of(program, above); lower(asked).starts_with("if ")) {
          code = asked + ": " + code;
          break;
        } else if (lower(asked) == "endif") {
          break;
        }
      places.push_back(fmt::format("{}:{}, {}", program.name, number, code));
    }
  }
  constexpr std::size_t few = 3;
  return places.empty() || places.size() > few ? "" : fmt::format(", by {}", fmt::join(places, " or "));
}

}  // namespace drycut::sim::loop
