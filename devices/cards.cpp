#include "devices/cards.hpp"

#include <array>
#include <cctype>

#include <fmt/format.h>

#include "base/state_archive.hpp"

namespace drycut::devices {

namespace {

struct KindSpelling {
  std::string_view text;
  Kind kind;
};

// First spelling of a kind is the one that we print. "IN" is found in some of the manuals' records.
constexpr std::array<KindSpelling, 6> spellings{{{"CNT", Kind::counter},
                                                 {"INP", Kind::input},
                                                 {"IN", Kind::input},
                                                 {"OUT", Kind::output},
                                                 {"AN", Kind::analogue},
                                                 {"INT", Kind::interrupt}}};

// Terminals of a base unit, which have no slot; numbers from 0.
struct BaseSpelling {
  std::string_view text;
  Kind kind;
  int base;
  int last;
};
constexpr std::array<BaseSpelling, 3> base_spellings{
    {{"X", Kind::input, 8, 0377}, {"Y", Kind::output, 8, 0377}, {"C", Kind::counter, 10, 255}}};

constexpr int max_number = 999;
constexpr int interrupt_lines = 8;

// Takes the number at the start of `text`; nullopt if there is none or it is too large to be one.
std::optional<int> take_number(std::string_view& text, int base = 10) {
  int number = 0;
  std::size_t length = 0;
  while (length < text.size() && text[length] >= '0' && text[length] < '0' + base) {
    number = number * base + (text[length] - '0');
    if (number > max_number) return std::nullopt;
    ++length;
  }
  if (length == 0) return std::nullopt;
  text.remove_prefix(length);
  return number;
}

std::string take_letters(std::string_view& text) {
  std::string letters;
  while (!text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) != 0) {
    letters += static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    text.remove_prefix(1);
  }
  return letters;
}

std::optional<Kind> kind_of(std::string_view letters) {
  for (const KindSpelling& spelling : spellings)
    if (spelling.text == letters) return spelling.kind;
  return std::nullopt;
}

}  // namespace

std::optional<Address> parse_address(std::string_view text) {
  Address address;
  const std::optional<int> slot = take_number(text);
  if (slot) {
    if (*slot < 1 || text.empty() || text.front() != '.') return std::nullopt;
    text.remove_prefix(1);
    address.slot = *slot;
  }
  const std::optional<Kind> kind = kind_of(take_letters(text));
  if (!kind) return std::nullopt;
  address.kind = *kind;
  const std::optional<int> number = take_number(text);
  if (!number || *number < 1 || !text.empty()) return std::nullopt;
  address.number = *number;
  // Interrupt lines, and only they, belong to no slot.
  if ((address.kind == Kind::interrupt) == slot.has_value()) return std::nullopt;
  if (address.kind == Kind::interrupt && address.number > interrupt_lines) return std::nullopt;
  return address;
}

std::optional<Address> parse_base_terminal(std::string_view text) {
  const std::string letters = take_letters(text);
  for (const BaseSpelling& spelling : base_spellings) {
    if (spelling.text != letters) continue;
    const std::optional<int> number = take_number(text, spelling.base);
    if (!number || *number > spelling.last || !text.empty()) return std::nullopt;
    return Address{spelling.kind, 0, *number};
  }
  return std::nullopt;
}

std::string to_string(const Address& address) {
  if (address.kind == Kind::interrupt) return fmt::format("INT{}", address.number);
  for (const BaseSpelling& spelling : base_spellings)
    if (address.slot == 0 && spelling.kind == address.kind)
      return spelling.base == 8 ? fmt::format("{}{:o}", spelling.text, address.number)
                                : fmt::format("{}{}", spelling.text, address.number);
  for (const KindSpelling& spelling : spellings)
    if (spelling.kind == address.kind)
      return fmt::format("{}.{}{:02}", address.slot, spelling.text, address.number);
  return {};
}

std::string_view name_of(Kind kind) {
  constexpr std::array<std::string_view, 5> names = {"counter", "digital input", "digital output",
                                                     "analogue output", "interrupt line"};
  return names[static_cast<std::size_t>(kind)];
}

void Counter::visit(StateArchive& archive) { STATE(archive, count, latched); }
void DigitalInput::visit(StateArchive& archive) { STATE(archive, level); }
void DigitalOutput::visit(StateArchive& archive) { STATE(archive, level, held); }
void AnalogueOutput::visit(StateArchive& archive) { STATE(archive, word, held); }
void PulseTrain::visit(StateArchive& archive) { STATE(archive, count); }
void OutputTurn::visit(StateArchive& archive) { STATE(archive, holds_, contested_); }

namespace {

std::string key_name(const Address& address) { return to_string(address); }
std::string key_name(int line) { return to_string(Address{Kind::interrupt, 0, line}); }

// In their places: others refer to them.
template <typename Terminals>
struct InPlace {
  Terminals& terminals;

  void visit(StateArchive& archive) {
    auto number = static_cast<std::uint32_t>(terminals.size());
    STATE(archive, number);
    if (number != terminals.size()) throw BadState("other terminals");
    for (auto& [key, terminal] : terminals) archive.named(key_name(key), terminal);
  }
};

template <typename Terminals>
void visit_in_place(StateArchive& archive, std::string_view name, Terminals& terminals) {
  InPlace<Terminals> all{terminals};
  archive.named(name, all);
}

}  // namespace

void Cards::visit(StateArchive& archive) {
  visit_in_place(archive, "counters", counters);
  visit_in_place(archive, "inputs", inputs);
  visit_in_place(archive, "outputs", outputs);
  visit_in_place(archive, "analogue_outputs", analogue_outputs);
  visit_in_place(archive, "pulse_outputs", pulse_outputs);
  visit_in_place(archive, "interrupt_lines", interrupt_lines);
}

}  // namespace drycut::devices
