#include <algorithm>

#include <fmt/format.h>

#include "devices/qmove/cnf_parser.hpp"

// The INTDEVICE section of the .CNF: one record a device, checked against the fields of its type.
namespace drycut::devices::qmove {

namespace {

std::string form_of(const DeviceType& type) {
  std::string form = fmt::format("<name> {}", type.name);
  for (const Field& field : type.fields) form += fmt::format(" {}", field.name);
  return form;
}

std::string article(std::string_view noun) {
  const bool vowel = std::string_view("aeiou").find(noun.front()) != std::string_view::npos;
  return fmt::format("{} {}", vowel ? "an" : "a", noun);
}

struct TerminalKind {
  Kind kind;
  std::string_view example;
};

TerminalKind terminal_kind(Field::Kind kind) {
  switch (kind) {
    case Field::Kind::counter:
      return {Kind::counter, "2.CNT01"};
    case Field::Kind::input:
      return {Kind::input, "2.INP01"};
    case Field::Kind::output:
      return {Kind::output, "2.OUT01"};
    default:
      return {Kind::analogue, "2.AN01"};
  }
}

// The manuals do not say how many terminals a card has; no card that they or their examples name has more.
int most_terminals(Kind kind) { return kind == Kind::counter || kind == Kind::analogue ? 8 : 64; }

}  // namespace

void CnfParser::device(const Words& words) {
  const bool named = declare(words[0]);
  if (words.size() < 2) {
    complain("cnf.syntax"_code, words[0].place, in_quotes(words[0].text) + " has no device type",
             "write: <name> <type> <fields>");
    return;
  }
  const std::optional<std::size_t> type_index = device_type(words[1]);
  if (!type_index) return;
  const DeviceType& type = *catalogue_[*type_index].type;
  std::vector<Word> fields(words.begin() + 2, words.end());

  // CAMMING4's own example leaves out CountMB: what stands in its place is no address (spec D6).
  constexpr std::size_t fourth = 3;
  if (fields.size() + 1 == type.fields.size() && fields.size() > fourth &&
      type.fields[fourth].name == "CountMB" && fields[fourth].text.find('.') == std::string_view::npos)
    fields.insert(fields.begin() + fourth, Word{"X.X", fields[fourth].place});

  if (fields.size() != type.fields.size()) {
    const bool missing = fields.size() < type.fields.size();
    const Word& at = missing ? words.back() : fields[type.fields.size()];
    complain("cnf.syntax"_code, at.place,
             fmt::format("{} {} has {} fields after its name and type, found {}", type.name,
                         in_quotes(words[0].text), type.fields.size(), fields.size()),
             "write: " + form_of(type));
  }
  DeviceRecord record{words[0].text, *type_index, {}, words[0].place};
  bool sound = fields.size() == type.fields.size();
  for (std::size_t i = 0; i < std::min(fields.size(), type.fields.size()); ++i) {
    const std::optional<Resource> found = resource(type.fields[i], fields[i], type);
    sound = sound && found;
    if (found && found->address && found->address->kind == Kind::counter)
      for (std::size_t j = 0; j < i; ++j)
        if (record.resources[j].address == found->address)
          // The manual's own start-up example does it (000 1.1.1.1).
          configuration_.notes.emplace_back(
              "cnf.same-counter"_code,
              fmt::format("{}:{}:{}: {} and {} of {} are the same counter, {}", file_, fields[i].place.line,
                          fields[i].place.column, type.fields[j].name, type.fields[i].name, words[0].text,
                          fields[i].text));
    record.resources.push_back(found.value_or(Resource{}));
  }
  // A record with a fault stays, so that modules that name the device are still checked.
  record.resources.resize(type.fields.size());
  if (named) configuration_.devices.push_back(std::move(record));
}

std::optional<std::size_t> CnfParser::device_type(const Word& word) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < catalogue_.size(); ++i) {
    if (same_word(catalogue_[i].type->name, word.text)) return i;
    names.emplace_back(catalogue_[i].type->name);
  }
  complain("cnf.unknown-name"_code, word.place, "unknown device type " + in_quotes(word.text),
           suggestion(word.text, names, "known types are " + listed(names)));
  return std::nullopt;
}

std::optional<Resource> CnfParser::resource(const Field& field, const Word& word, const DeviceType& type) {
  if (field.kind == Field::Kind::period_ms || field.kind == Field::Kind::interrupt_line ||
      field.kind == Field::Kind::port)
    return number_resource(field, word, type);
  if (same_word(word.text, "X.X")) return Resource{};
  const TerminalKind wanted = terminal_kind(field.kind);
  const std::optional<Address> address = parse_address(word.text);
  if (!address || address->kind != wanted.kind) {
    complain("cnf.syntax"_code, word.place,
             fmt::format("{} of {}: {} is {}", field.name, type.name, in_quotes(word.text),
                         address ? article(name_of(address->kind)) : "no address"),
             fmt::format("write the address of {} such as {}, or X.X if unused",
                         article(name_of(wanted.kind)), wanted.example));
    return std::nullopt;
  }
  slot_uses_.push_back({address->slot, word});
  if (wanted.kind == Kind::output) sole_output(*address, word);
  return Resource{0, address};
}

// An output has one name, or one device that works it.
void CnfParser::sole_output(const Address& address, const Word& word) {
  const auto [first, fresh] = outputs_.emplace(address, word.place);
  if (!fresh)
    complain("cnf.declared-twice"_code, word.place, fmt::format("{} is taken already", in_quotes(word.text)),
             fmt::format("the first stands in line {}; an output has one name or one device that works it",
                         first->second.line));
}

std::optional<Resource> CnfParser::number_resource(const Field& field, const Word& word,
                                                   const DeviceType& type) {
  const bool line = field.kind == Field::Kind::interrupt_line;
  if (line && same_word(word.text, "X")) return Resource{};
  const std::optional<int> value = parsed<int>(word.text);
  if (!value || *value < field.min || *value > field.max) {
    complain(
        "cnf.value"_code, word.place,
        fmt::format("{} of {} cannot be {}", field.name, type.name, in_quotes(word.text)),
        line ? fmt::format("write an interrupt line from {} to {}, or X if unused", field.min, field.max)
        : field.kind == Field::Kind::port
            ? fmt::format("write the number of a communication port, from {} to {}", field.min, field.max)
            : fmt::format("write the sampling time in ms, from {} to {}", field.min, field.max));
    return std::nullopt;
  }
  return Resource{*value, std::nullopt};
}

// An address in a slot without a card is a slip. A text without BUS (a fragment) is not judged.
void CnfParser::check_bus() {
  if (!bus_seen_) return;
  const auto is_cpu = [](const Slot& slot) { return upper(slot.card).find("CPU") != std::string::npos; };
  if (!bus_faulty_ && std::none_of(configuration_.slots.begin(), configuration_.slots.end(), is_cpu))
    complain("cnf.value"_code, bus_place_, "BUS has no CPU card", "the CPU stands in slot 1: 1 1CPUB 02");
  for (const SlotUse& use : slot_uses_) {
    const auto address = parse_address(use.word.text);
    const int most = most_terminals(address->kind);
    if (address->number > most)
      complain("cnf.value"_code, use.word.place,
               fmt::format("{}: no card has so many", in_quotes(use.word.text)),
               fmt::format("{} of a card is {} to {}", article(name_of(address->kind)), 1, most));
  }
  for (const SlotUse& use : slot_uses_) {
    const auto found = std::find_if(configuration_.slots.begin(), configuration_.slots.end(),
                                    [&](const Slot& slot) { return slot.number == use.slot; });
    if (found == configuration_.slots.end())
      complain("cnf.value"_code, use.word.place,
               fmt::format("{}: BUS has no slot {}", in_quotes(use.word.text), use.slot),
               "use a slot that BUS gives a card, or add it to BUS");
    else if (found->card.empty())
      complain("cnf.value"_code, use.word.place,
               fmt::format("{}: slot {} is empty", in_quotes(use.word.text), use.slot),
               fmt::format("use a slot with a card, or put a card into line {}", found->place.line));
  }
}

}  // namespace drycut::devices::qmove
