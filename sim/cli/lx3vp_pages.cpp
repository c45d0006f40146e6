// `drycut devices` for the LX3VP.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "devices/lx3vp/ecamtbx.hpp"
#include "devices/lx3vp/ecamtbx_registers.hpp"
#include "devices/lx3vp/il_operands.hpp"
#include "devices/lx3vp/il_program.hpp"
#include "devices/lx3vp/modbus_map.hpp"
#include "devices/lx3vp/registers.hpp"
#include "sim/cli/pages.hpp"

namespace drycut::sim::cli {

namespace {

namespace lx3vp = devices::lx3vp;
using lx3vp::BlockWord;

std::string_view access_text(BlockWord::Access access) {
  if (access == BlockWord::Access::reserved) return "reserved";
  return access == BlockWord::Access::read ? "read" : "read/write";
}

template <typename Word>
Sheet::Cell offsets(const Word& word) {
  return {word.offset, word.words == 1 ? fmt::format("{}", word.offset)
                                       : fmt::format("{}-{}", word.offset, word.offset + word.words - 1)};
}

/// Where the manual is silent and what is done here.
Sheet readings_of(std::span<const lx3vp::BlockReading> readings) {
  Sheet sheet("readings", "Readings of ours, where the manual is silent or contradicts itself",
              {"where", "reading"});
  for (const auto& reading : readings) sheet.add({reading.where, reading.text});
  return sheet;
}

Page decam_page() {
  Sheet words("words", "Words; 32-bit values have their low word first",
              {"offset=word", "words=", "name", "type", "range", "initial", "access", "taken", "meaning"});
  for (const auto& word : lx3vp::block_words()) {
    const bool has_initial = word.access == BlockWord::Access::write && word.set_up != 0;
    words.add({offsets(word),
               word.words,
               word.name,
               word.type,
               word.range,
               {word.set_up, has_initial ? fmt::format("{}", word.set_up) : ""},
               access_text(word.access),
               word.taken,
               word.meaning});
  }
  Sheet flags("flags", "Flags", {"word", "bit", "name", "access", "meaning"});
  for (const auto& flag : lx3vp::block_flags())
    flags.add({flag.word, flag.bit, flag.name, flag.access, flag.meaning});
  return {"DECAM",
          "electronic cam of the LX3VP: its parameter block from S2 on",
          "DECAM S1 S2 S3 D1 D2: master C, D or K (x 100 us), block D, start signal X or M, "
          "pulse output Y0..Y3, direction Y\n\n"
          "Words that no program, file or scenario has written have their initial value when the cam starts, "
          "which is\n"
          "told as a note; else what was written counts, a 0 too.",
          {words, flags, readings_of(lx3vp::block_readings())}};
}

Sheet words_of(const std::string& key, const std::string& title, std::span<const lx3vp::EcamtbxWord> list) {
  Sheet sheet(key, title, {"offset=word", "words=", "parameter", "type", "unit", "range", "meaning"});
  for (const auto& word : list)
    sheet.add({offsets(word), word.words, word.number, word.type, word.unit, word.range, word.meaning});
  return sheet;
}

Page ecamtbx_page() {
  Sheet results("results", "Results in D1", {"result", "meaning"});
  results.add({{nullptr, "above 0"}, {nullptr, "rows of the table"}});
  for (const auto error : lx3vp::ecam_errors())
    results.add({static_cast<int>(error), lx3vp::error_text(error)});
  return {
      "ECAMTBX",
      "cam tables of the LX3VP: its parameter lists and results",
      "ECAMTBX S0 S1 D0 D1: parameter list D (20 words), type K or D, block D of the cam, "
      "result D (32 bit)\n\n"
      "It writes the rows from word 40 of the block on, their number into word 38 and 40 into word 39; with\n"
      "word 4 bit 0 a saw's synchronous zone into words 9 to 12. With an error the block is left as it was "
      "and\n"
      "the run's events tell why.",
      {words_of("saw_words",
                "K100 (rotary saw) and K101 (flying saw); 32-bit values have their low word first",
                lx3vp::saw_words()),
       words_of("s_curve_words",
                "K0 (cosine) and K1 (parabolas), S-curves over time; 100 us are a master count",
                lx3vp::s_curve_words()),
       results, readings_of(lx3vp::ecamtbx_readings())}};
}

/// MOV, MOVP, DMOV, DMOVP: the 32-bit form begins with D, the pulse form ends in P.
std::vector<std::string> spellings_of(const lx3vp::il::Mnemonic& mnemonic) {
  std::vector<std::string> names;
  for (const auto& spelling : lx3vp::il::spellings())
    if (spelling.mnemonic == &mnemonic) names.push_back(spelling.text);
  return names;
}

Sheet modbus_sheet() {
  Sheet sheet("modbus", "Modbus addresses (Wecon, PLC Editor, 8.1)",
              {"registers", "functions", "address", "access", "meaning"});
  for (const auto& row : lx3vp::modbus_rows()) {
    auto last = row.first;
    last.number += row.count - 1;
    const int end = row.address + row.count * lx3vp::addresses_each(row) - 1;
    const auto* functions = row.bits ? (row.may_write ? "1, 2, 5, 15" : "1, 2") : "3, 4, 6, 16, 22, 23";
    sheet.add({fmt::format("{}..{}", to_string(row.first), to_string(last)), functions,
               fmt::format("0x{:04X}..0x{:04X}", row.address, end), row.may_write ? "read/write" : "read",
               row.meaning});
  }
  return sheet;
}

Page lx3vp_page() {
  Sheet registers("registers", "Special registers", {"name=register", "type", "access", "meaning"});
  for (const auto& special : lx3vp::special_registers())
    registers.add({special.name, special.type, special.access, special.meaning});
  Sheet instructions("instructions", "Instructions",
                     {"names=instruction", "=meaning", "operands", "meaning="});
  for (const auto& entry : lx3vp::il::mnemonics()) {
    std::vector<std::string_view> operands;
    for (const char kind : entry.operands) operands.push_back(lx3vp::il::operand_text(kind));
    instructions.add({spellings_of(entry),
                      entry.meaning,
                      {operands, fmt::format("{}", fmt::join(operands, "; "))},
                      entry.meaning});
  }
  return {"LX3VP",
          "WECON LX3VP: special registers, Modbus addresses and instructions",
          "",
          {registers, modbus_sheet(), instructions, readings_of(lx3vp::il::instruction_readings())}};
}

}  // namespace

std::vector<Page> lx3vp_pages() { return {decam_page(), ecamtbx_page(), lx3vp_page()}; }

}  // namespace drycut::sim::cli
