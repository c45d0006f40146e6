#include "devices/lx3vp/il_operands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/text.hpp"
#include "devices/lx3vp/ecamtbx_registers.hpp"
#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp::il {

namespace {

/// The devices of a kind: the letter, whether numbers are octal, and the ranges that exist.
struct OperandRange {
  int first = 0;
  int last = 0;
};
struct OperandFamily {
  char letter;
  bool octal;
  OperandRange ranges[2];
};
constexpr OperandFamily families[] = {
    {'X', true, {{0, 0377}, {0, -1}}},       {'Y', true, {{0, 0377}, {0, -1}}},
    {'M', false, {{0, 3071}, {8000, 8255}}}, {'S', false, {{0, 999}, {0, -1}}},
    {'T', false, {{0, 255}, {0, -1}}},       {'C', false, {{0, 255}, {0, -1}}},
    {'D', false, {{0, 8255}, {0, -1}}},      {'P', false, {{0, 127}, {0, -1}}},
    {'V', false, {{0, 7}, {0, -1}}},         {'Z', false, {{0, 7}, {0, -1}}},
    {'N', false, {{0, 7}, {0, -1}}},         {'I', false, {{0, 899}, {0, -1}}},
};

/// A kind of operand, by its letter in Mnemonic::operands.
struct OperandKind {
  char letter;
  std::string_view text;   ///< what it may be, for messages
  std::string_view takes;  ///< the letters of what it may be
  int extent;              ///< words or bits from there on
  int wide_extent;         ///< of a 32-bit instruction
  /// Whether it may have an index register: all that instructions read and write, not what says where a
  /// program goes or which terminals pulses take.
  bool indexed = true;
};
constexpr std::string_view any_number = "K, H or D";
constexpr OperandKind operand_kinds[] = {
    {'b', "X, Y, M, S, T, C or a bit of D (D10.F)", "XYMSTC.", 1, 1},
    {'o', "Y, M, S, T, C or a bit of D (D10.F)", "YMSTC.", 1, 1},
    {'s', "Y, M, S or a bit of D (D10.F)", "YMS.", 1, 1},
    {'r', "Y, M, S, T, C, D, V, Z or a bit of D (D10.F)", "YMSTCDVZ.", 1, 1},
    {'e', "Y or M", "YM", 1, 1},
    {'l', "Y, M, S, T, C or D", "YMSTCD", 1, 1},
    {'g', "X, Y, M or S", "XYMS", 1, 1},
    {'h', "Y, M or S", "YMS", 1, 1},
    {'B', "Y, M or S", "YMS", 3, 3},
    {'x', "X or M", "XM", 1, 1, false},
    {'y', "Y", "Y", 1, 1, false},
    {'p', "Y0 to Y3", "Y", 1, 1, false},
    {'S', "S", "S", 1, 1, false},
    {'n', "K, H, D, T, C, V, Z or bits (K4M0) of X, Y, M or S", "KDTCVZ#", 1, 2},
    {'w', "D, T, C, V, Z or bits (K4M0) of Y, M or S", "DTCVZ#", 1, 2},
    {'u', "D, T, C or bits (K4M0) of X, Y, M or S", "DTC#", 1, 2},
    {'U', "D, T, C or bits (K4M0) of Y, M or S", "DTC#", 1, 2},
    {'z', "K, H, D, T, C, V, Z, X, Y, M or S", "KDTCVZXYMS", 1, 1},
    {'Z', "D, T, C, V, Z, X, Y, M or S", "DTCVZXYMS", 1, 1},
    {'W', "D, T, C, V or Z", "DTCVZ", 1, 1},
    {'O', "D, T, C, Y, M or S", "DTCYMS", 1, 1},
    {'c', "D, T or C", "DTC", 3, 3},
    {'C', "D, T or C", "DTC", 3, 3},
    {'7', "D, T or C", "DTC", 7, 7},
    {'8', "D, T or C", "DTC", 7, 7},
    {'3', "D", "D", 3, 3},
    {'A', "X or Y", "XY", 1, 1, false},
    {'X', "X0 to X5", "X", 1, 1, false},
    {'H', "C200 to C255", "C", 1, 1, false},
    {'I', "Y, M, S or I010 to I060", "YMSI", 1, 1},
    {'R', "Y, M, S or the same C", "YMSC", 1, 1},
    {'i', "D", "D", 1, 2},
    {'G', "D", "D", 1, 2},
    {'q', "D", "D", 2, 4},
    {'F', "D", "D", 2, 2},
    {'Q', "D", "D", 2, 2},
    {'D', "D", "D", 2, 2, false},
    {'a', "D", "D", ecamtbx_parameters, ecamtbx_parameters, false},
    {'d', "D", "D", block_length, block_length, false},
    {'f', "E (E1.5), K, H or D", "EKD", 2, 2},
    {'j', any_number, "KD", 1, 2},
    {'k', any_number, "KD", 1, 1},
    {'t', any_number, "KD", 1, 1, false},
    {'v', "K or D", "KD", 1, 1},
    {'m', "C, D or K", "CDK", 1, 1, false},
    {'N', "N0 to N7", "N", 1, 1, false},
    {'P', "a label, P0 to P127", "P", 1, 1, false},
};

const OperandKind& operand_kind(char letter) {
  const auto* const found = std::ranges::find(operand_kinds, letter, &OperandKind::letter);
  if (found == std::end(operand_kinds)) throw std::logic_error("an instruction with an operand of no kind");
  return *found;
}

const OperandFamily* family_of(char letter) {
  for (const auto& family : families)
    if (family.letter == letter) return &family;
  return nullptr;
}
const OperandFamily* family_of(OperandType kind) { return family_of(letter_of(kind)); }

std::string numbered(const OperandFamily& family, int number) {
  return family.octal ? fmt::format("{}{:o}", family.letter, number)
                      : fmt::format("{}{}", family.letter, number);
}
std::string range_text(const OperandFamily& family) {
  auto text = fmt::format("{} to {}", numbered(family, family.ranges[0].first),
                          numbered(family, family.ranges[0].last));
  if (family.ranges[1].last >= 0)
    text += fmt::format(" and {} to {}", numbered(family, family.ranges[1].first),
                        numbered(family, family.ranges[1].last));
  return text;
}
bool exists(const OperandFamily& family, int first, int count = 1) {
  return std::any_of(std::begin(family.ranges), std::end(family.ranges), [&](const OperandRange& range) {
    return first >= range.first && first <= range.last - (count - 1);
  });
}

std::string_view without_plus(std::string_view text) {
  return text.substr(text.starts_with('+') && text.size() > 1 && text[1] != '-' ? 1 : 0);
}

template <typename Number>
bool number_from(std::string_view text, Number& number, auto... base) {
  const auto read = parsed<Number>(without_plus(text), base...);
  number = read.value_or(number);
  return read.has_value();
}

class OperandReader {
 public:
  OperandReader(std::string_view text, ValueFault& fault) : text_(upper(text)), fault_(fault) {}

  std::optional<Operand> read() {
    const auto at = text_.find_first_of("VZ", 1);
    if (at == std::string::npos) return read_plain();
    // Behind the operand: D10Z0; Z alone is Z0.
    const auto digits = std::string_view(text_).substr(at + 1);
    const bool exists = digits.empty() || (digits.size() == 1 && digits[0] >= '0' && digits[0] <= '7');
    if (!exists)
      return refuse("il.index-register"_code, "has no such index register",
                    "there are V0 to V7 and Z0 to Z7: D10Z0");
    const int number = (digits.empty() ? 0 : digits[0] - '0') + (text_[at] == 'Z' ? Operand::first_z : 0);
    const auto whole = text_;
    text_.resize(at);
    auto operand = read_plain();
    text_ = whole;
    if (!operand) return std::nullopt;
    if (operand->kind == OperandType::V || operand->kind == OperandType::Z ||
        operand->kind == OperandType::real || operand->kind == OperandType::word_bit ||
        operand->kind == OperandType::label || operand->kind == OperandType::nesting ||
        operand->kind == OperandType::interrupt)
      return refuse("il.index-register"_code, "takes no index register",
                    "index a device, bits or a number: D10Z0, K4M0Z0, K5V1");
    operand->index = number;
    return operand;
  }

 private:
  std::optional<Operand> read_plain() {
    const char letter = text_.empty() ? ' ' : text_.front();
    const auto rest = std::string_view(text_).substr(std::min<std::size_t>(1, text_.size()));
    if (letter == 'K') return read_constant(rest);
    if (letter == 'H') return read_hexadecimal(rest);
    if (letter == 'E') return read_real(rest);
    const auto* family = family_of(letter);
    if ((letter == 'V' || letter == 'Z') && rest.empty()) return read_device(*family, "0");
    if (family == nullptr || rest.empty() || rest.front() < '0' || rest.front() > '9')
      return refuse("il.operand"_code, "is no operand", "write a device (X0, D100), K10, H1F or E1.5");
    return read_device(*family, rest);
  }

  std::nullopt_t refuse(Code code, std::string_view what, std::string remedy) {
    fault_ = {code, fmt::format("'{}' {}", shown(text_), what), std::move(remedy)};
    return std::nullopt;
  }

  std::optional<Operand> read_constant(std::string_view digits) {
    for (std::size_t i = 1; i < digits.size(); ++i)
      if (family_of(digits[i]) != nullptr)
        return read_bits(digits.substr(0, i), digits[i], digits.substr(i + 1));
    Operand operand;
    if (!number_from(digits, operand.value))
      return refuse("il.width"_code, "is no 32-bit number", "write K-2147483648 to K2147483647");
    return operand;
  }

  std::optional<Operand> read_bits(std::string_view groups, char letter, std::string_view digits) {
    Operand operand;
    operand.kind = OperandType::bits;
    const auto& family = *family_of(letter);
    operand.of = static_cast<OperandType>(letter);
    if (std::string_view("XYMS").find(letter) == std::string_view::npos)
      return refuse("il.out-of-range"_code, "groups no bits", "bits are grouped of X, Y, M or S: K4M0");
    if (!number_from(groups, operand.count) || operand.count < 1 || operand.count > 8)
      return refuse("il.out-of-range"_code, "has no such groups of bits",
                    "group K1 (4 bits) to K8 (32 bits)");
    if (!read_number(family, digits, operand.number)) return std::nullopt;
    if (!exists(family, operand.number, 4 * operand.count))
      return refuse("il.out-of-range"_code, "goes beyond the devices",
                    fmt::format("there are {}", range_text(family)));
    return operand;
  }

  std::optional<Operand> read_hexadecimal(std::string_view digits) {
    std::uint32_t value = 0;
    if (!number_from(digits, value, 16))
      return refuse("il.width"_code, "is no 32-bit number", "write H0 to HFFFFFFFF");
    Operand operand;
    operand.value = static_cast<std::int32_t>(value);
    operand.hexadecimal = true;
    return operand;
  }

  std::optional<Operand> read_real(std::string_view digits) {
    Operand operand;
    operand.kind = OperandType::real;
    if (!number_from(digits, operand.real) || !std::isfinite(operand.real))
      return refuse("il.width"_code, "is no 32-bit floating-point number", "write E1.5 or E-3.2E4");
    return operand;
  }

  std::optional<Operand> read_device(const OperandFamily& family, std::string_view digits) {
    Operand operand;
    operand.kind = static_cast<OperandType>(family.letter);
    const auto dot = digits.find('.');
    if (operand.kind == OperandType::D && dot != std::string_view::npos) {
      operand.kind = OperandType::word_bit;
      if (!number_from(digits.substr(dot + 1), operand.count, 16) || operand.count < 0 || operand.count > 15)
        return refuse("il.out-of-range"_code, "has no such bit", "a word has the bits 0 to F: D10.F");
      digits = digits.substr(0, dot);
    }
    if (!read_number(family, digits, operand.number)) return std::nullopt;
    return operand;
  }

  bool read_number(const OperandFamily& family, std::string_view digits, int& number) {
    if (number_from(digits, number, family.octal ? 8 : 10) && exists(family, number)) return true;
    const bool decimal = family.octal && digits.find_first_of("89") != std::string_view::npos;
    refuse("il.out-of-range"_code, decimal ? "is not octal" : "does not exist",
           decimal ? fmt::format("{0} count {0}0 to {0}7, {0}10 to {0}17 and on", family.letter)
                   : fmt::format("there are {}", range_text(family)));
    return false;
  }

  std::string text_;
  ValueFault& fault_;
};

/// Whether a kind of operand takes what the text named.
bool takes(char kind, const Operand& operand) {
  if (is_written(kind) && operand.kind == OperandType::bits && operand.of == OperandType::X) return false;
  if (kind == 'p' && operand.number >= pulse_outputs) return false;
  if (kind == 'X' && operand.number >= interrupt_inputs) return false;
  if (kind == 'H' && operand.number < first_wide_counter) return false;
  if (kind == 'I' && operand.kind == OperandType::interrupt && !is_counter_interrupt(operand.number))
    return false;
  return operand_kind(kind).takes.find(letter_of(operand.kind)) != std::string_view::npos;
}

bool is_word(char kind) { return std::string_view("nwuUzZWOcC78").find(kind) != std::string_view::npos; }

/// V and Z, as devices and as indexes.
std::optional<ValueFault> misfit_of_index(const Operand& operand, char kind, const Spelling& spelling) {
  if (operand.kind == OperandType::V && spelling.wide)
    return ValueFault{"il.index-register"_code,
                      fmt::format("{} is the upper half of a 32-bit index", to_string(operand)),
                      fmt::format("use Z{0}: a 32-bit instruction takes V{0} with it", operand.number)};
  if (operand.index == Operand::no_index) return {};
  if (!operand_kind(kind).indexed)
    return ValueFault{"il.index-register"_code,
                      fmt::format("{} does not take an index register here", spelling.text),
                      fmt::format("write the number itself, not {}", to_string(operand))};
  if (spelling.wide && operand.index < Operand::first_z)
    return ValueFault{"il.index-register"_code,
                      fmt::format("{} is indexed by V in a 32-bit instruction", to_string(operand)),
                      "use Z: a 32-bit instruction takes V with it"};
  return {};
}

std::optional<ValueFault> misfit_of_constant(const Operand& operand, char kind, const Spelling& spelling) {
  if (kind == 'm') {
    if (operand.value >= 1) return {};
    return ValueFault{"il.operand"_code, fmt::format("{} is no time axis", to_string(operand)),
                      "K1 counts every 100 us, K10 every ms"};
  }
  const bool narrow = (is_word(kind) && !spelling.wide) || kind == 'k';
  const bool fits = operand.hexadecimal ? static_cast<std::uint32_t>(operand.value) <= 0xFFFF
                                        : operand.value >= std::numeric_limits<std::int16_t>::min() &&
                                              operand.value <= std::numeric_limits<std::int16_t>::max();
  if (!narrow || fits) return {};
  return ValueFault{
      "il.width"_code, fmt::format("{} is wider than 16 bits", to_string(operand)),
      spelling.mnemonic->has(form::w) ? "use the 32-bit instruction" : "write K-32768 to K32767"};
}

}  // namespace

std::optional<Operand> read_operand(std::string_view text, ValueFault& fault) {
  return OperandReader(text, fault).read();
}

bool is_interrupt(int number) {
  const int rest = number % 100;
  if (number < 100 * interrupt_inputs && (rest == 0 || rest == 1)) return true;
  if (number >= 600 && number <= 899) return rest >= 10;
  return is_counter_interrupt(number);
}

std::string_view operand_text(char kind) { return operand_kind(kind).text; }

bool exists(const Operand& operand) {
  const auto* family = family_of(operand.kind == OperandType::bits ? operand.of : operand.kind);
  return family == nullptr || exists(*family, operand.number);
}

std::string devices_text(const Operand& operand) {
  const auto& family = *family_of(operand.kind == OperandType::bits ? operand.of : operand.kind);
  return fmt::format("there are {}", range_text(family));
}

bool is_written(char kind) {
  return std::string_view("oserlhBwUWOC83iqFDIR").find(kind) != std::string_view::npos;
}

int extent_of(const Operand& operand, char kind, bool wide) {
  if (operand.kind == OperandType::bits) return 4 * operand.count;
  return wide ? operand_kind(kind).wide_extent : operand_kind(kind).extent;
}

std::optional<ValueFault> read_only(const Operand& operand, int count, const Spelling& spelling) {
  const bool word = operand.kind == OperandType::D || operand.kind == OperandType::word_bit;
  const bool relay = (operand.kind == OperandType::bits ? operand.of : operand.kind) == OperandType::M;
  if (!word && !relay) return {};
  const char letter = word ? 'D' : 'M';
  for (int number = std::max(operand.number, first_special); number < operand.number + count; ++number) {
    const auto* const row = special_register(letter, number);
    if (row == nullptr || row->access != "read") continue;
    const bool clock = word && number >= first_clock_word && number <= last_clock_word;
    return ValueFault{
        "il.operand"_code,
        fmt::format("{} writes {}{}, which is read only: {}", spelling.text, letter, number, row->meaning),
        clock  ? "set the clock with TWR"
        : word ? "write a word of your own, D0 to D7999"
               : "write a relay of your own, M0 to M3071"};
  }
  return {};
}

int stride_of(const Operand& first, bool wide) {
  if (first.kind == OperandType::bits) return 4 * first.count;
  const bool wide_counter = first.kind == OperandType::C && first.number >= first_wide_counter;
  return wide && !wide_counter ? 2 : 1;
}

bool has_values(const Operand& first, int count, bool wide) {
  Operand last = first;
  last.number += count * stride_of(first, wide) - 1;
  const bool narrow_counter = first.kind == OperandType::C && first.number < first_wide_counter;
  return exists(last) && (!narrow_counter || last.number < first_wide_counter);
}

std::optional<ValueFault> unserved(const Operand& operand) {
  const bool grouped = operand.kind == OperandType::bits;
  const auto kind = grouped                                 ? operand.of
                    : operand.kind == OperandType::word_bit ? OperandType::D
                                                            : operand.kind;
  if (kind != OperandType::D && kind != OperandType::M) return {};
  const int count = grouped ? 4 * operand.count : 1;
  for (int number = operand.number; number < operand.number + count; ++number)
    if (!is_served(letter_of(kind), number))
      return ValueFault{"il.not-simulated"_code,
                        fmt::format("{}{} is not simulated", letter_of(kind), number),
                        fmt::format("there are {}", served_specials(letter_of(kind)))};
  return {};
}

std::optional<ValueFault> misfit(const Operand& operand, char kind, const Spelling& spelling) {
  if (!takes(kind, operand))
    return ValueFault{"il.operand"_code,
                      fmt::format("{} does not take {} here", spelling.text, to_string(operand)),
                      fmt::format("it takes {}", operand_text(kind))};
  if (auto fault = misfit_of_index(operand, kind, spelling)) return fault;
  if (operand.kind == OperandType::V || operand.kind == OperandType::Z) return {};
  if (operand.kind == OperandType::constant) return misfit_of_constant(operand, kind, spelling);
  if (operand.kind == OperandType::bits) {
    if (!exists(*family_of(operand.of), operand.number, 4 * operand.count))
      return ValueFault{"il.out-of-range"_code, fmt::format("{} goes beyond the devices", to_string(operand)),
                        fmt::format("there are {}", range_text(*family_of(operand.of)))};
    if (spelling.wide || operand.count <= 4) return {};
    return ValueFault{"il.width"_code, fmt::format("{} is wider than 16 bits", to_string(operand)),
                      "group K1 to K4, or use the 32-bit instruction"};
  }
  const auto* family = family_of(operand.kind);
  if (family == nullptr) return {};
  if (operand.kind == OperandType::C && operand.number >= first_wide_counter && is_word(kind)) {
    if (spelling.wide) return {};
    return ValueFault{"il.width"_code, fmt::format("{} is 32 bits wide", to_string(operand)),
                      "use the 32-bit instruction"};
  }
  const int count = spelling.wide ? operand_kind(kind).wide_extent : operand_kind(kind).extent;
  if (operand.kind == OperandType::C && is_word(kind) && operand.number + count > first_wide_counter)
    return ValueFault{"il.out-of-range"_code,
                      fmt::format("{} takes {} words from {} on", spelling.text, count, to_string(operand)),
                      "the 16-bit counters end at C199"};
  if ((kind == 'a' || kind == 'd') && operand.number + count > first_special)
    return ValueFault{"il.out-of-range"_code,
                      fmt::format("{} takes {} words from {} on", spelling.text, count, to_string(operand)),
                      "the block has to end at D7999"};
  if (exists(*family, operand.number, count)) return {};
  return ValueFault{"il.out-of-range"_code,
                    fmt::format("{} takes {} devices from {} on", spelling.text, count, to_string(operand)),
                    fmt::format("there are {}", range_text(*family))};
}

std::string to_string(const Operand& operand) {
  if (operand.index != Operand::no_index) {
    auto plain = operand;
    plain.index = Operand::no_index;
    return fmt::format("{}{}{}", to_string(plain), operand.index < Operand::first_z ? 'V' : 'Z',
                       operand.index % Operand::first_z);
  }
  switch (operand.kind) {
    case OperandType::constant:
      return operand.hexadecimal ? fmt::format("H{:X}", static_cast<std::uint32_t>(operand.value))
                                 : fmt::format("K{}", operand.value);
    case OperandType::real:
      return fmt::format("E{}", operand.real);
    case OperandType::bits:
      return fmt::format("K{}{}", operand.count, numbered(*family_of(operand.of), operand.number));
    case OperandType::word_bit:
      return fmt::format("D{}.{:X}", operand.number, operand.count);
    case OperandType::interrupt:
      return fmt::format("I{:03}", operand.number);
    default:
      return numbered(*family_of(operand.kind), operand.number);
  }
}

}  // namespace drycut::devices::lx3vp::il
