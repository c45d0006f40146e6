#include "sim/commands/lx3vp_tables.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "devices/lx3vp/block.hpp"
#include "devices/lx3vp/il_mnemonics.hpp"
#include "sim/commands/text_table.hpp"

namespace drycut::sim {

namespace {

namespace lx3vp = devices::lx3vp;
using lx3vp::BlockWord;
using nlohmann::ordered_json;

constexpr std::string_view decam_summary = "electronic cam of the LX3VP: its parameter block from S2 on";
constexpr std::string_view lx3vp_summary = "WECON LX3VP: special registers and instructions";

std::string_view access_text(BlockWord::Access access) {
  switch (access) {
    case BlockWord::Access::read:
      return "read";
    case BlockWord::Access::write:
      return "read/write";
    case BlockWord::Access::reserved:
      return "reserved";
  }
  return "";
}

std::string offsets(const BlockWord& word) {
  return word.words == 1 ? fmt::format("{}", word.offset)
                         : fmt::format("{}-{}", word.offset, word.offset + word.words - 1);
}

void print_decam() {
  fmt::print(
      "DECAM: {}\n\nDECAM S1 S2 S3 D1 D2: master C, D or K (x 100 us), block D, start signal X or M, "
      "pulse output Y0..Y3, direction Y\n",
      decam_summary);
  TextTable words({"word", "name", "type", "range", "initial", "access", "taken", "meaning"});
  for (const auto& word : lx3vp::block_words()) {
    words.add({offsets(word), std::string(word.name), std::string(word.type), std::string(word.range),
               word.access == BlockWord::Access::reserved ? "" : fmt::format("{}", word.initial),
               std::string(access_text(word.access)), std::string(word.taken), std::string(word.meaning)});
  }
  words.print("Words; 32-bit values have their low word first");
  TextTable flags({"word", "bit", "name", "access", "meaning"});
  for (const auto& flag : lx3vp::block_flags()) {
    flags.add({fmt::format("{}", flag.word), fmt::format("{}", flag.bit), std::string(flag.name),
               std::string(flag.access), std::string(flag.meaning)});
  }
  flags.print("Flags");
}

ordered_json decam_json() {
  ordered_json json = {{"name", "DECAM"}, {"summary", decam_summary}};
  for (const auto& word : lx3vp::block_words()) {
    json["words"].push_back({{"offset", word.offset},
                             {"words", word.words},
                             {"name", word.name},
                             {"type", word.type},
                             {"range", word.range},
                             {"initial", word.initial},
                             {"access", access_text(word.access)},
                             {"taken", word.taken},
                             {"meaning", word.meaning}});
  }
  for (const auto& flag : lx3vp::block_flags()) {
    json["flags"].push_back({{"word", flag.word},
                             {"bit", flag.bit},
                             {"name", flag.name},
                             {"access", flag.access},
                             {"meaning", flag.meaning}});
  }
  return json;
}

// MOV, MOVP, DMOV, DMOVP: the 32-bit form begins with D, the pulse form ends in P.
std::vector<std::string> spellings_of(const lx3vp::il::Mnemonic& mnemonic) {
  std::vector<std::string> names;
  for (const auto& spelling : lx3vp::il::spellings())
    if (spelling.mnemonic == &mnemonic) names.push_back(spelling.text);
  return names;
}

void print_lx3vp() {
  fmt::print("LX3VP: {}\n", lx3vp_summary);
  TextTable registers({"register", "type", "access", "meaning"});
  for (const auto& special : lx3vp::special_registers()) {
    registers.add({std::string(special.name), std::string(special.type), std::string(special.access),
                   std::string(special.meaning)});
  }
  registers.print("Special registers");
  TextTable instructions({"instruction", "meaning", "operands"});
  for (const auto& entry : lx3vp::il::mnemonics()) {
    std::string operands;
    for (const char kind : entry.operands)
      operands += fmt::format("{}{}", operands.empty() ? "" : "; ", lx3vp::il::operand_text(kind));
    instructions.add({fmt::format("{}", fmt::join(spellings_of(entry), ", ")), std::string(entry.meaning),
                      std::move(operands)});
  }
  instructions.print("Instructions");
}

ordered_json lx3vp_json() {
  ordered_json json = {{"name", "LX3VP"}, {"summary", lx3vp_summary}};
  for (const auto& special : lx3vp::special_registers()) {
    json["registers"].push_back({{"name", special.name},
                                 {"type", special.type},
                                 {"access", special.access},
                                 {"meaning", special.meaning}});
  }
  for (const auto& entry : lx3vp::il::mnemonics()) {
    ordered_json operands = ordered_json::array();
    for (const char kind : entry.operands) operands.push_back(lx3vp::il::operand_text(kind));
    json["instructions"].push_back(
        {{"names", spellings_of(entry)}, {"operands", std::move(operands)}, {"meaning", entry.meaning}});
  }
  return json;
}

}  // namespace

std::span<const Lx3vpTable> lx3vp_tables() {
  static constexpr Lx3vpTable tables[] = {
      {"DECAM", decam_summary, print_decam, decam_json},
      {"LX3VP", lx3vp_summary, print_lx3vp, lx3vp_json},
  };
  return tables;
}

}  // namespace drycut::sim
