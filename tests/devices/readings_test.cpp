#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "devices/catalogue.hpp"
#include "devices/qmove/language.hpp"
#include "devices/qmove/text.hpp"

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
    for (const Reading& reading : entry.type->readings) {
      EXPECT_TRUE(reading.of.empty() || has_row(*entry.type, reading.of)) << entry.type->name << reading.of;
      EXPECT_TRUE(reading.of.empty() || seen.insert(reading.of).second) << "twice: " << reading.of;
      EXPECT_FALSE(reading.text.empty()) << reading.of;
      EXPECT_TRUE(reading.manual.starts_with("00") || reading.manual.starts_with("wiki.qem.it"))
          << reading.manual;
    }
    EXPECT_FALSE(entry.type->readings.empty()) << entry.type->name;
  }
}

TEST(Readings, OfTheLanguageCoverWhatNoManualShows) {
  for (const char* word :
       {"NEXT", "ENDWHILE", "ENDSUB", "CALL", "RESOUT", "timer", "NEQ", "order of operators"})
    EXPECT_TRUE(std::ranges::any_of(qmove::language, [&](const qmove::LanguageRow& row) {
      return row.form.find(word) != std::string_view::npos && !row.reading.empty();
    })) << word;
}

// The table forgets no word of the language.
TEST(Readings, TheLanguageTableHasEveryReservedWord) {
  std::string forms;
  for (const qmove::LanguageRow& row : qmove::language) forms += std::string(row.form) + " ";
  for (const std::string& word : qmove::reserved_words())
    EXPECT_NE(forms.find(word), std::string::npos) << word;
}

}  // namespace
}  // namespace drycut::devices
