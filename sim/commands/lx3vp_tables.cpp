// `drycut devices` for the LX3VP.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "devices/lx3vp/block.hpp"
#include "devices/lx3vp/ecamtbx.hpp"
#include "devices/lx3vp/ecamtbx_words.hpp"
#include "devices/lx3vp/il_mnemonics.hpp"
#include "sim/commands/controller_table.hpp"
#include "sim/commands/text_table.hpp"

namespace drycut::sim {

namespace {

namespace lx3vp = devices::lx3vp;
using lx3vp::BlockWord;
using nlohmann::ordered_json;

constexpr std::string_view decam_summary = "electronic cam of the LX3VP: its parameter block from S2 on";
constexpr std::string_view ecamtbx_summary = "cam tables of the LX3VP: its parameter lists and results";
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

std::string initial_text(const BlockWord& word) {
  return word.access == BlockWord::Access::write && word.set_up != 0 ? fmt::format("{}", word.set_up) : "";
}

/// Where the manual is silent and what is done here.
void print_readings(std::span<const lx3vp::Reading> readings) {
  TextTable table({"where", "reading"});
  for (const auto& reading : readings) table.add({std::string(reading.where), std::string(reading.text)});
  table.print("Readings of ours, where the manual is silent or contradicts itself");
}

ordered_json readings_json(std::span<const lx3vp::Reading> readings) {
  ordered_json json = ordered_json::array();
  for (const auto& reading : readings) json.push_back({{"where", reading.where}, {"reading", reading.text}});
  return json;
}

void print_decam() {
  fmt::print(
      "DECAM: {}\n\nDECAM S1 S2 S3 D1 D2: master C, D or K (x 100 us), block D, start signal X or M, "
      "pulse output Y0..Y3, direction Y\n\n"
      "Words that no program, file or scenario has written have their initial value when the cam starts, "
      "which "
      "is\n"
      "told as a note; else what was written counts, a 0 too.\n",
      decam_summary);
  TextTable words({"word", "name", "type", "range", "initial", "access", "taken", "meaning"});
  for (const auto& word : lx3vp::block_words()) {
    words.add({offsets(word), std::string(word.name), std::string(word.type), std::string(word.range),
               initial_text(word), std::string(access_text(word.access)), std::string(word.taken),
               std::string(word.meaning)});
  }
  words.print("Words; 32-bit values have their low word first");
  TextTable flags({"word", "bit", "name", "access", "meaning"});
  for (const auto& flag : lx3vp::block_flags()) {
    flags.add({fmt::format("{}", flag.word), fmt::format("{}", flag.bit), std::string(flag.name),
               std::string(flag.access), std::string(flag.meaning)});
  }
  flags.print("Flags");
  print_readings(lx3vp::block_readings());
}

ordered_json decam_json() {
  ordered_json json = {{"name", "DECAM"}, {"summary", decam_summary}};
  for (const auto& word : lx3vp::block_words()) {
    json["words"].push_back({{"offset", word.offset},
                             {"words", word.words},
                             {"name", word.name},
                             {"type", word.type},
                             {"range", word.range},
                             {"initial", word.set_up},
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
  json["readings"] = readings_json(lx3vp::block_readings());
  return json;
}

std::string offsets(const lx3vp::EcamtbxWord& word) {
  return word.words == 1 ? fmt::format("{}", word.offset)
                         : fmt::format("{}-{}", word.offset, word.offset + word.words - 1);
}

void print_words(std::span<const lx3vp::EcamtbxWord> list, const std::string& title) {
  TextTable words({"word", "parameter", "type", "unit", "range", "meaning"});
  for (const auto& word : list)
    words.add({offsets(word), std::string(word.number), std::string(word.type), std::string(word.unit),
               std::string(word.range), std::string(word.meaning)});
  words.print(title);
}

void print_ecamtbx() {
  fmt::print(
      "ECAMTBX: {}\n\nECAMTBX S0 S1 D0 D1: parameter list D (20 words), type K or D, block D of the cam, "
      "result D (32 bit)\n\n"
      "It writes the rows from word 40 of the block on, their number into word 38 and 40 into word 39; with\n"
      "word 4 bit 0 a saw's synchronous zone into words 9 to 12. With an error the block is left as it was "
      "and\n"
      "the run's events tell why.\n",
      ecamtbx_summary);
  print_words(lx3vp::saw_words(),
              "K100 (rotary saw) and K101 (flying saw); 32-bit values have their low word first");
  print_words(lx3vp::s_curve_words(),
              "K0 (cosine) and K1 (parabolas), S-curves over time; 100 us are a master count");
  TextTable results({"result", "meaning"});
  results.add({"above 0", "rows of the table"});
  for (const auto error : lx3vp::ecam_errors())
    results.add({fmt::format("{}", static_cast<int>(error)), std::string(lx3vp::error_text(error))});
  results.print("Results in D1");
  print_readings(lx3vp::ecamtbx_readings());
}

ordered_json words_json(std::span<const lx3vp::EcamtbxWord> list) {
  ordered_json json = ordered_json::array();
  for (const auto& word : list)
    json.push_back({{"offset", word.offset},
                    {"words", word.words},
                    {"parameter", word.number},
                    {"type", word.type},
                    {"unit", word.unit},
                    {"range", word.range},
                    {"meaning", word.meaning}});
  return json;
}

ordered_json ecamtbx_json() {
  ordered_json json = {{"name", "ECAMTBX"}, {"summary", ecamtbx_summary}};
  json["saw_words"] = words_json(lx3vp::saw_words());
  json["s_curve_words"] = words_json(lx3vp::s_curve_words());
  for (const auto error : lx3vp::ecam_errors())
    json["results"].push_back({{"result", static_cast<int>(error)}, {"meaning", lx3vp::error_text(error)}});
  json["readings"] = readings_json(lx3vp::ecamtbx_readings());
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
  print_readings(lx3vp::il::instruction_readings());
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
  json["readings"] = readings_json(lx3vp::il::instruction_readings());
  return json;
}

}  // namespace

std::vector<ControllerTable> lx3vp_tables() {
  return {{"DECAM", decam_summary, print_decam, decam_json},
          {"ECAMTBX", ecamtbx_summary, print_ecamtbx, ecamtbx_json},
          {"LX3VP", lx3vp_summary, print_lx3vp, lx3vp_json}};
}

}  // namespace drycut::sim
