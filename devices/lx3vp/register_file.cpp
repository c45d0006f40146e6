#include "devices/lx3vp/register_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "base/text.hpp"
#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp {

namespace {

using Kind = RegisterName::Kind;

std::optional<double> read_number(std::string_view text) {
  const char first = text.empty() ? ' ' : text.front();
  const bool hexadecimal = first == 'H' || first == 'h';
  if (hexadecimal || first == 'K' || first == 'k') {
    const auto whole = parsed<std::int64_t>(text.substr(1), hexadecimal ? 16 : 10);
    return whole ? std::optional(static_cast<double>(*whole)) : std::nullopt;
  }
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const auto number = parsed<double>(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

// What a line says, without comment and blanks. A # inside a word is none: 16#1000 is refused, not 16.
std::string_view content_of(std::string_view line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool in_word = i > 0 && line[i - 1] != ' ' && line[i - 1] != '\t' && line[i - 1] != '\r';
    if (line[i] == ';' || (line[i] == '#' && !in_word)) return trimmed(line.substr(0, i));
  }
  return trimmed(line);
}

bool holds_32_bit(const RegisterName& name) { return name.kind == Kind::wide || name.kind == Kind::real; }

class RowReader {
 public:
  RowReader(const std::string& file, char separator, Problems& problems)
      : file_(file), separator_(separator), problems_(problems) {}

  void read(std::string_view line, int number) {
    line_ = line;
    number_ = number;
    const auto content = content_of(line);
    if (content.empty()) return;
    const bool first = std::exchange(first_, false);
    const std::size_t at = content.find(separator_);
    if (at == std::string_view::npos)
      return complain("registers.value"_code, content,
                      fmt::format("no '{}' in '{}'", separator_, shown(content)), row_text());
    const auto name_text = trimmed(content.substr(0, at));
    const auto value_text = trimmed(content.substr(at + 1));
    const auto name = parse_register(name_text);
    if (!name && first && value_text == "value") return;
    if (!name)
      complain("registers.unknown-register"_code, name_text,
               fmt::format("'{}' is no register", shown(name_text)), register_text);
    if (name && !is_served(*name))
      complain("registers.unknown-register"_code, name_text,
               fmt::format("{} is not simulated", to_string(*name)),
               "there are " + served_specials(letter_of(*name)));
    const auto value = read_number(value_text);
    if (!value)
      complain("registers.value"_code, value_text, fmt::format("'{}' is no number", shown(value_text)),
               "write 5, -5, K5, H1F or 1.5");
    if (name && value) take(name_text, *name, value_text, *value);
  }
  std::vector<RegisterValue> take_values() { return std::move(values_); }

 private:
  static constexpr std::string_view register_text =
      "write D10, D10:L (32 bit), D10:F (float), D10.A (bit 10), M0, S0, T0 or C0";

  [[nodiscard]] std::string row_text() const {
    return fmt::format("write register{0}value: D10{0}5", separator_);
  }

  void complain(Code code, std::string_view at, std::string what, std::string_view remedy) {
    problems_.push_back({code, file_, number_, static_cast<int>(at.data() - line_.data()) + 1,
                         std::move(what), std::string(remedy)});
  }

  void take(std::string_view name_text, const RegisterName& name, std::string_view value_text, double value) {
    if (name.kind == Kind::x)
      return complain("registers.value"_code, name_text, fmt::format("{} is an input", to_string(name)),
                      "wire it to a plug of a plant");
    if (const auto fault = misfit(name, value))
      return complain(fault->code, value_text, fault->what, fault->remedy);
    if (const int line = given(name); line > 0)
      return complain("registers.twice"_code, name_text,
                      fmt::format("{} is given in line {} already", to_string(name), line),
                      "keep one of them");
    values_.push_back({name, value, number_});
  }

  // The line that has given it, or part of it, already; else notes it and is 0.
  int given(const RegisterName& name) {
    const bool word = name.kind == Kind::word || name.kind == Kind::bit || holds_32_bit(name);
    const Kind kind = word ? Kind::word : name.kind;
    // A bit is given by its own line or by a word's.
    for (int i = 0; i <= (holds_32_bit(name) ? 1 : 0); ++i) {
      for (int bit = 0; bit < 16; ++bit) {
        if (name.kind == Kind::bit && bit != name.bit) continue;
        const auto [at, fresh] = lines_.try_emplace({kind, name.number + i, bit}, number_);
        if (!fresh && at->second != number_) return at->second;
        if (!word) break;
      }
    }
    return 0;
  }

  const std::string& file_;
  char separator_;
  Problems& problems_;
  std::string_view line_;
  int number_ = 0;
  bool first_ = true;
  std::map<std::tuple<Kind, int, int>, int> lines_;
  std::vector<RegisterValue> values_;
};

}  // namespace

std::optional<ValueFault> misfit(const RegisterName& name, double value) {
  return devices::misfit(to_string(name), range_of(name), value);
}

std::vector<RegisterValue> read_register_values(std::string_view text, const std::string& file,
                                                char separator, Problems& problems) {
  RowReader reader(file, separator, problems);
  int number = 0;
  for (const auto line : split_lines(without_byte_order_mark(text))) reader.read(line, ++number);
  return reader.take_values();
}

bool is_register_file(std::string_view text, char separator) {
  for (const auto line : split_lines(without_byte_order_mark(text))) {
    const auto content = content_of(line);
    const auto at = content.find(separator);
    if (at == std::string_view::npos) continue;
    const auto name = trimmed(content.substr(0, at));
    if (name == "address" || parse_register(name)) return true;
  }
  return false;
}

}  // namespace drycut::devices::lx3vp
