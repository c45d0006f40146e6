#include "sim/recordings/recording_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "base/text.hpp"
#include "plants/plant.hpp"
#include "sim/file.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/scenario/format.hpp"
#include "sim/scenario/specimens.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::recordings {

namespace {

using scenario::Archive;
using scenario::MapReader;

/// Signs between cells and in numbers, by their words.
struct SignWord {
  std::string_view word;
  char sign;
};
constexpr std::array separator_words = {SignWord{"tab", '\t'},  SignWord{"semicolon", ';'},
                                        SignWord{"comma", ','}, SignWord{"blank", ' '},
                                        SignWord{"colon", ':'}, SignWord{"bar", '|'}};
constexpr std::array decimal_words = {SignWord{"point", '.'}, SignWord{"comma", ','}};

template <std::size_t Count>
scenario::Form sign_form(const std::array<SignWord, Count>& words, std::optional<char>& sign) {
  std::vector<std::string> names(words.size());
  std::transform(words.begin(), words.end(), names.begin(),
                 [](const SignWord& word) { return std::string(word.word); });
  return scenario::choice_form(
      names,
      [&words, &sign] {
        const auto* const found = std::find_if(words.begin(), words.end(), [&](const SignWord& word) {
          return word.sign == sign.value_or(words.front().sign);
        });
        return static_cast<std::size_t>(found - words.begin());
      },
      [&words, &sign](std::size_t number) { sign = words.at(number).sign; });
}

/// Without a default that would be told and written.
scenario::Form if_given(bool given, scenario::Form form) {
  if (!given) form.write = [] { return std::string(); };
  return form;
}

scenario::Form optional_number(std::optional<double>& value) {
  return scenario::single(
      [&value](const scenario::Text& text, const std::string& name, scenario::Findings& findings) {
        value = scenario::read_si(text, name, "", findings);
      },
      [&value] { return value ? fmt::format("{}", *value) : std::string(); },
      std::string(scenario::number_schema));
}

/// A unit that is known; its place is that of the text.
bool is_sound_unit(MapReader& reader, const scenario::Text& unit) {
  if (scenario::is_unit(unit.text)) return true;
  scenario::Text quantity = unit;
  quantity.text = "1 " + unit.text;
  reader.findings().add("scenario.unknown-unit"_code, unit.place,
                        fmt::format("{}: unknown unit '{}'", reader.full("unit"), unit.text),
                        "'drycut plants --units' lists units; a speed of turning is rpm, not 1/min");
  return false;
}

void visit_time(Archive& archive, RecordingFile::TimeBase& time) {
  archive.in_line();
  archive.value({"column", "its header, or its number from 1", !time.column.text.empty()},
                scenario::form(time.column));
  archive.value({"unit", "of the column: ms", !time.unit.text.empty()}, scenario::form(time.unit));
  archive.value({"rate", "samples a second; with a column, that has the number of the sample"},
                if_given(time.rate > 0, scenario::form(time.rate, "Hz", 1e-6, 1e12, "1e-6 Hz to 1e12 Hz")));
  archive.value({"start", "time of the first sample, where no column says it", time.start != 0},
                scenario::form(time.start, "s", -1e9, 1e9, "-1e9 s to 1e9 s"));
  archive.judge([&time](MapReader& reader) {
    if (!time.unit.text.empty() && is_sound_unit(reader, time.unit) &&
        !scenario::same_dimension(time.unit.text, "s"))
      reader.findings().add("scenario.wrong-unit"_code, time.unit.place,
                            fmt::format("{} is a time, not {} ({})", reader.full("unit"),
                                        scenario::dimension_name(time.unit.text), time.unit.text),
                            "s, ms or us");
    if (!time.unit.text.empty() && time.rate > 0)
      reader.refuse("scenario.does-not-go-together"_code, "rate", "a column of times needs no rate",
                    "leave unit or rate out");
    if (!time.column.text.empty() && time.unit.text.empty() && time.rate == 0 && reader.is_sound())
      reader.refuse("recording.no-time"_code, "column",
                    fmt::format("the column {} has no unit", in_quotes(time.column.text)),
                    "unit: ms if it is a time; rate: 1 kHz if it counts samples");
  });
}

/// What the channel of that name would have to be, if the machines have one.
void judge_dimension(MapReader& reader, const RecordingFile::Channel& channel) {
  const auto wanted = units_of_channel(channel.name.text);
  const auto unit = channel.of.unit.empty() ? channel.unit.text : channel.of.unit;
  const auto fits = [&](const std::string& known) { return scenario::same_dimension(known, unit); };
  if (wanted.empty() || std::any_of(wanted.begin(), wanted.end(), fits)) return;
  const bool is_share = channel.of.unit.empty() && scenario::same_dimension(unit, "");
  reader.findings().add(
      "scenario.wrong-unit"_code, channel.of.unit.empty() ? channel.unit.place : channel.of.place,
      fmt::format("{} is {}, not {} ({})", channel.name.text, scenario::dimension_name(wanted.front()),
                  scenario::dimension_name(unit), unit),
      is_share ? fmt::format("say what it is a share of: of: 1 {}", wanted.front())
               : fmt::format("give it in {}, or name another channel", wanted.front()));
}

void judge_channel(MapReader& reader, const RecordingFile::Channel& channel) {
  if (!reader.has("unit")) return;
  if (!is_sound_unit(reader, channel.unit)) return;
  if (reader.has("of") && !scenario::same_dimension(channel.unit.text, ""))
    reader.findings().add("scenario.does-not-go-together"_code, reader.place("of"),
                          fmt::format("{} is for a share or for counts, not for {}", reader.full("of"),
                                      scenario::dimension_name(channel.unit.text)),
                          "leave it out, or write unit: \"%\"");
  else if (reader.has("full") && !reader.has("of"))
    reader.refuse("scenario.needs-another"_code, "full",
                  fmt::format("{} says nothing without of", reader.full("full")),
                  "write what so many are: of: 1 rev");
  else if (std::abs(channel.sign) != 1)
    reader.findings().add("scenario.out-of-range"_code, reader.value_place("sign"),
                          fmt::format("{} is {}", reader.full("sign"), channel.sign),
                          "1 or -1; scale takes any number");
  else if (reader.is_sound())
    judge_dimension(reader, channel);
}

}  // namespace

void visit(Archive& archive, RecordingFile::Channel& channel) {
  const auto& [name, column, time, unit, of, full, scale, sign, delay, numbers, clipped] = channel;
  archive.in_line();
  archive.value({"column", "its header, or its number from 1"}, scenario::form(channel.column));
  archive.require("column", "name the column: column: Torque, or its number: column: 2");
  archive.value({"time", "the column with its own time, where it has one", !time.text.empty()},
                scenario::form(channel.time));
  archive.value({"unit", "of the column: N m, rpm, \"%\", counts", !unit.text.empty()},
                scenario::form(channel.unit));
  archive.require("unit", "the file may not say it: look at the tool's settings; \"\" is a pure number");
  archive.value({"of", "what 100 %, or `full` counts, are: 9.55 N m"},
                if_given(!of.unit.empty(), scenario::form(channel.of)));
  archive.value({"full", "so many of the column are `of`: 8192 counts of: 1 rev", full != 1},
                scenario::form(channel.full, "", 1e-12, 1e18, "a number above 0"));
  archive.value({"scale", "its numbers are multiplied by it: 0.1 of tenths", scale != 1},
                scenario::form(channel.scale, "", -1e12, 1e12, "-1e12 to 1e12"));
  archive.value({"sign", "-1: it counts the other way than the machine", sign != 1},
                scenario::form(channel.sign, "", -1, 1, "1 or -1"));
  archive.value({"delay", "so much later than it was does the file have it", delay != 0},
                scenario::form(channel.delay, "s", -10, 10, "-10 s to 10 s"));
  archive.value({"numbers", "of 16 bits: bit 15 is the sign, or they go on below 0 from 65535",
                 numbers != Numbers::plain},
                scenario::choice_form({"plain", "sign_magnitude", "twos_complement"}, channel.numbers));
  archive.value({"clipped", "the number that stands for what could not be recorded", clipped.has_value()},
                optional_number(channel.clipped));
  archive.judge([&channel](MapReader& reader) { judge_channel(reader, channel); });
}

void visit(Archive& archive, RecordingFile& recording) {
  archive.value({"file", "the export of the machine's tool"}, scenario::path_form(recording.file));
  archive.require("file", "name the export: file: scope.csv");
  archive.value({"format", "who wrote it"}, scenario::choice_form(format_names(), recording.format));
  archive.value({"separator", "what stands between its cells; else as most rows of numbers come of it"},
                if_given(recording.separator.has_value(), sign_form(separator_words, recording.separator)));
  archive.value({"decimal", "what stands in its numbers; else likewise"},
                if_given(recording.decimal.has_value(), sign_form(decimal_words, recording.decimal)));
  const auto& time = recording.time;
  const bool has_time = !time.column.text.empty() || !time.unit.text.empty() || time.rate > 0;
  archive.section({"time", "a column, or a rate; else as the format has it", has_time},
                  [&](Archive& inner) { visit_time(inner, recording.time); });
  archive.value({"rows", "of its data, from 1, both included: [1, 5000]", recording.rows.has_value()},
                scenario::form(recording.rows));
  archive.names({"channels", "by the names that the machine's channels have"}, recording.channels,
                &RecordingFile::Channel::name);
  archive.require("channels", "name one: channels: {knife.motor.torque: {column: Torque, unit: N m}}");
  archive.judge([&recording](MapReader& reader) {
    const auto& rows = recording.rows;
    if (rows && (rows->first < 1 || std::floor(rows->first) != rows->first ||
                 std::floor(rows->second) != rows->second || rows->second > 1e15))
      reader.findings().add("scenario.out-of-range"_code, reader.value_place("rows"),
                            "rows are whole numbers from 1", "for example [1, 5000]");
    if (reader.has("separator") && recording.separator == recording.decimal)
      reader.refuse("recording.ambiguous-comma"_code, "decimal",
                    "a comma cannot stand both between cells and in numbers", "export it with another sign");
  });
}

Problem RecordingFile::problem(Code code, const scenario::ScenePlace& place, std::string what,
                               std::string remedy) const {
  return {code, path.string(), place.line, place.column, std::move(what), std::move(remedy)};
}

bool is_recording(std::string_view text) {
  const auto first = trimmed(text.substr(0, text.find('\n')));
  return text.starts_with("file:") || first.starts_with("{file:") ||
         text.find("\nfile:") != std::string_view::npos;
}

RecordingFile read_recording_text(std::string_view text, const std::filesystem::path& file,
                                  Problems& problems) {
  RecordingFile recording;
  recording.path = file;
  scenario::Findings findings({file.string()});
  const auto root = scenario::parse_scenario(text, 0, findings);
  if (findings.empty() && root.kind == scenario::YamlNode::Kind::null) {
    findings.add("scenario.missing-key"_code, {1, 1}, "the recording is empty",
                 "name the export: file: scope.csv");
  } else if (findings.empty() && root.kind != scenario::YamlNode::Kind::map) {
    scenario::refuse_kind(root, "a recording", scenario::YamlNode::Kind::map, findings);
  } else if (findings.empty()) {
    MapReader reader(root, "", findings);
    visit(reader, recording);
    reader.finish();
  }
  for (auto& problem : findings.sorted()) problems.push_back(std::move(problem));
  return recording;
}

RecordingFile read_recording_file(const std::filesystem::path& file, Problems& problems) {
  const auto text = read_file(file, problems);
  return text ? read_recording_text(*text, file, problems) : RecordingFile();
}

std::string write(const RecordingFile& recording) {
  // visit() takes a recording that may change, because other archives fill it; this archive only reads.
  return scenario::yaml_of([&](Archive& archive) { visit(archive, const_cast<RecordingFile&>(recording)); });
}

std::vector<std::string> units_of_channel(const std::string& name) {
  static const auto known = [] {
    std::map<std::string, std::set<std::string>, std::less<>> all;
    for (const auto& type : plants::plant_types())
      for (const auto& specimen : scenario::specimens_of(type))
        for (const auto& channel : specimen->plant().channels()) all[channel.name].insert(channel.unit);
    return all;
  }();
  const auto dot = name.find('.');
  const auto found = dot == std::string::npos ? known.end() : known.find(name.substr(dot + 1));
  if (found == known.end()) return {};
  return {found->second.begin(), found->second.end()};
}

std::string unit_of_time(const std::string& written) {
  const auto word = lower(written);
  if (word == "second" || word == "seconds" || word == "sec") return "s";
  return scenario::is_unit(word) && scenario::same_dimension(word, "s") ? word : "";
}

Worth worth_of(const RecordingFile::Channel& channel) {
  Worth made;
  const auto factor = channel.scale * channel.sign;
  const auto one = [](std::string_view unit) { return scenario::to_si(1, unit) - scenario::to_si(0, unit); };
  if (channel.of.unit.empty()) {
    made.unit = scenario::readable_si(channel.unit.text);
    made.factor = factor * one(channel.unit.text);
    made.offset = scenario::to_si(0, channel.unit.text);
  } else {
    made.unit = scenario::readable_si(channel.of.unit);
    made.factor =
        factor * one(channel.unit.text) / channel.full * scenario::to_si(channel.of.number, channel.of.unit);
  }
  return made;
}

}  // namespace drycut::sim::recordings
