#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "devices/qmove/catalogue.hpp"
#include "devices/qmove/cnf.hpp"
#include "devices/qmove/language.hpp"

// Readings of ours stand beside what they are about, each with the place that leaves it open.
namespace drycut::devices {
namespace {

bool has_row(const DeviceType& type, std::string_view name) {
  const auto named = [&](const auto& row) { return row.name == name; };
  return std::ranges::any_of(type.variables, named) || std::ranges::any_of(type.states, named) ||
         std::ranges::any_of(type.commands, named);
}

TEST(Readings, BelongToARowAndNameThePlaceInAManual) {
  for (const CatalogueEntry& entry : catalogue()) {
    std::set<std::string_view> seen;
    for (const ManualReading& reading : entry.type->readings) {
      EXPECT_TRUE(reading.of.empty() || has_row(*entry.type, reading.of)) << entry.type->name << reading.of;
      EXPECT_TRUE(reading.of.empty() || seen.insert(reading.of).second) << "twice: " << reading.of;
      EXPECT_FALSE(reading.text.empty()) << reading.of;
      EXPECT_TRUE(reading.manual.starts_with("00") || reading.manual.starts_with("wiki.qem.it"))
          << reading.manual;
    }
    EXPECT_FALSE(entry.type->readings.empty()) << entry.type->name;
  }
}

// What the devices decide where a manual is open, or against its letter, is not left to be found out.
TEST(Readings, SayWhatTheDevicesDecide) {
  struct Decided {
    std::string_view device;
    std::string_view of;
    std::string_view says;
  };
  for (const Decided& decided : {Decided{"CAMMING4", "EMRG", "st_regoff"},
                                 {"EPICPOS", "EMRG", "st_regoff"},
                                 {"CAMMING4", "st_toll", "the last START"},
                                 {"EPICPOS", "st_toll", "the last START"},
                                 {"CAMMING4", "STOPCAM", "whatever ramptype"},
                                 {"CAMMING4", "codeQsa", "whatever ramptype"},
                                 {"CAMMING4", "", "but for what a gearing has taken off"},
                                 {"CAMMING4", "follerr", "fractions of a bit"},
                                 {"EPICPOS", "follerr", "fractions of a bit"},
                                 {"EANPOS", "follerr", "fractions of a bit"},
                                 {"CAMMING4", "RSPRSM", "no more"},
                                 {"CAMMING4", "prsmode", "as long as the enable is on"},
                                 {"CAMMING4", "prsmodem", "at the enable's edge"},
                                 {"OOPOS2", "tool", "goes to the limit"},
                                 {"OOPOS2", "overpos", "no least way"}}) {
    const auto says = [&](const ManualReading& reading) {
      return reading.of == decided.of && reading.text.find(decided.says) != std::string_view::npos;
    };
    EXPECT_TRUE(std::ranges::any_of(catalogue(),
                                    [&](const CatalogueEntry& entry) {
                                      return entry.type->name == decided.device &&
                                             std::ranges::any_of(entry.type->readings, says);
                                    }))
        << decided.device << ' ' << decided.of << ": " << decided.says;
  }
}

TEST(Readings, OfTheLanguageCoverWhatNoManualShows) {
  for (const char* word :
       {"NEXT", "ENDWHILE", "ENDSUB", "CALL", "RESOUT", "timer", "NEQ", "order of operators"})
    EXPECT_TRUE(std::ranges::any_of(qmove::language, [&](const qmove::QclRow& row) {
      return row.form.find(word) != std::string_view::npos && !row.reading.empty();
    })) << word;
}

// The table forgets no word of the language.
TEST(Readings, TheLanguageTableHasEveryReservedWord) {
  std::string forms;
  for (const qmove::QclRow& row : qmove::language) forms += std::string(row.form) + " ";
  for (const std::string& word : qmove::reserved_words())
    EXPECT_NE(forms.find(word), std::string::npos) << word;
}

}  // namespace
}  // namespace drycut::devices
