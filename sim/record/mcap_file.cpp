#include "sim/record/mcap_file.hpp"

#include <fmt/format.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "base/json.hpp"

namespace drycut::sim::record {

namespace {

constexpr std::string_view magic = "\x89MCAP0\r\n";
constexpr std::size_t chunk_size = 1U << 20U;

enum Opcode : char {
  header = 1,
  footer,
  schema,
  channel,
  message,
  chunk,
  message_index,
  chunk_index,
  statistics = 0x0B,
  metadata,
  metadata_index,
  summary_offset,
  data_end
};

// Integers lie with the least byte first, texts behind their length.
template <typename Integer>
void append(std::string& to, Integer number) {
  for (std::size_t i = 0; i < sizeof(Integer); ++i)
    to += static_cast<char>(static_cast<std::uint64_t>(number) >> (8 * i));
}
template <typename Length = std::uint32_t>
void append_text(std::string& to, std::string_view text) {
  append(to, static_cast<Length>(text.size()));
  to += text;
}
void append_record(std::string& to, Opcode code, std::string_view body) {
  to += static_cast<char>(code);
  append_text<std::uint64_t>(to, body);
}
std::uint32_t check_sum(std::string_view bytes, std::uint32_t before = 0) {
  return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

Json number_schema(const std::string& unit) {
  return {{"type", "number"}, {"description", unit.empty() ? "-" : unit}};
}

/// As foxglove/schemas has it.
std::string log_schema() {
  const Json whole = {{"type", "integer"}, {"minimum", 0}};
  Json levels = Json::array();
  for (const auto* level : {"UNKNOWN", "DEBUG", "INFO", "WARNING", "ERROR", "FATAL"})
    levels.push_back({{"title", level}, {"const", levels.size()}});
  return json_text(
      {{"title", "foxglove.Log"},
       {"type", "object"},
       {"properties",
        {{"timestamp",
          {{"type", "object"}, {"title", "time"}, {"properties", {{"sec", whole}, {"nsec", whole}}}}},
         {"level", {{"title", "foxglove.LogLevel"}, {"oneOf", levels}}},
         {"message", {{"type", "string"}}},
         {"name", {{"type", "string"}}},
         {"file", {{"type", "string"}}},
         {"line", whole}}}});
}

int log_level(Severity severity) {
  constexpr int info = 2;  // and WARNING, ERROR, FATAL behind it
  return info + static_cast<int>(severity);
}

/// JSON has no word for what is no number.
void append_number(std::string& json, double number) {
  if (std::isfinite(number))
    fmt::format_to(std::back_inserter(json), "{}", number);
  else
    json += "null";
}

}  // namespace

McapFile::McapFile(const Recording& recording, const std::filesystem::path& file, const About& about)
    : file_(file) {
  std::string begin(magic);
  std::string body;
  append_text(body, "");  // no profile
  append_text(body, "drycut");
  append_record(begin, header, body);
  std::string pairs;
  for (const auto& [name, text] : about) {
    append_text(pairs, name);
    append_text(pairs, text);
  }
  body.clear();
  append_text(body, "drycut");
  append_text(body, pairs);
  const auto place = begin.size();
  append_record(begin, metadata, body);
  std::string index;
  append(index, std::uint64_t{place});
  append(index, std::uint64_t{begin.size() - place});
  append_text(index, "drycut");
  append_record(metadata_index_, metadata_index, index);
  put(begin);

  log_ = add_topic("/events", "foxglove.Log", log_schema());
  for (const auto& column : recording.columns()) add_channel(column);
  const std::function<Json(const Node&)> schema_of = [&](const Node& node) {
    if (node.slot != nullptr) return number_schema(node.unit);
    Json properties = Json::object();
    for (const auto& inner : node.inside) properties[inner.name] = schema_of(inner);
    return Json{{"type", "object"}, {"properties", properties}};
  };
  for (const auto& source : sources_) {
    Json json = schema_of(source);
    json["title"] = "drycut." + source.name;
    // A source that is called as the log is.
    const auto topic = "/" + source.name + (source.name == "events" ? "_" : "");
    source_topics_.push_back(add_topic(topic, "drycut." + source.name, json_text(json)));
  }
}

// "knife.motor.torque" is motor.torque of "/knife"; a name without a source is of "/program".
void McapFile::add_channel(const Recording::Column& column) {
  std::vector<std::string_view> parts;
  for (std::string_view rest = column.name;;) {
    const auto dot = rest.find('.');
    parts.push_back(rest.substr(0, dot));
    if (dot == std::string_view::npos) break;
    rest.remove_prefix(dot + 1);
  }
  if (parts.size() == 1) parts.insert(parts.begin(), "program");
  auto* level = &sources_;
  // Where knife.motor is a channel and knife.motor.torque one, too.
  const auto free_name = [&](std::string_view part) {
    std::string name(part);
    while (std::any_of(level->begin(), level->end(), [&](const Node& node) { return node.name == name; }))
      name += '_';
    return name;
  };
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    const auto found = std::find_if(level->begin(), level->end(), [&](const Node& node) {
      return node.slot == nullptr && node.part == parts[i];
    });
    if (found != level->end()) {
      level = &found->inside;
      continue;
    }
    level->push_back({std::string(parts[i]), free_name(parts[i]), "", nullptr, {}});
    level = &level->back().inside;
  }
  level->push_back({std::string(parts.back()), free_name(parts.back()), column.unit, column.slot, {}});
}

std::uint16_t McapFile::add_topic(const std::string& topic, const std::string& schema_name,
                                  const std::string& json_schema) {
  if (topics_.size() == std::numeric_limits<std::uint16_t>::max())
    throw std::runtime_error("MCAP takes 65535 topics at most");
  const auto id = static_cast<std::uint16_t>(topics_.size() + 1);
  auto& made = topics_.emplace_back();
  append(made.schema, id);
  append_text(made.schema, schema_name);
  append_text(made.schema, "jsonschema");
  append_text(made.schema, json_schema);
  append(made.channel, id);
  append(made.channel, id);
  append_text(made.channel, topic);
  append_text(made.channel, "json");
  append_text(made.channel, "");  // no metadata
  append_record(chunk_.records, schema, made.schema);
  append_record(chunk_.records, channel, made.channel);
  return id;
}

void McapFile::add_message(std::uint16_t topic, Time time, const std::string& json) {
  auto& to = topics_[topic - 1U];
  append(to.index, static_cast<std::uint64_t>(time));
  append(to.index, std::uint64_t{chunk_.records.size()});
  std::string body;
  append(body, topic);
  append(body, static_cast<std::uint32_t>(to.messages++));
  append(body, static_cast<std::uint64_t>(time));
  append(body, static_cast<std::uint64_t>(time));
  body += json;
  append_record(chunk_.records, message, body);
  const auto take = [&](std::uint64_t& messages, Time& begin, Time& end) {
    begin = messages == 0 ? time : std::min(begin, time);
    end = messages == 0 ? time : std::max(end, time);
    ++messages;
  };
  take(chunk_.messages, chunk_.begin, chunk_.end);
  take(messages_, begin_, end_);
  if (chunk_.records.size() >= chunk_size) put_chunk();
}

void McapFile::append_json(const Node& node, std::string& json) {
  if (node.slot != nullptr) return append_number(json, *node.slot);
  char before = '{';
  for (const auto& inner : node.inside) {
    json += before;
    json += json_text(Json(inner.name));
    json += ':';
    append_json(inner, json);
    before = ',';
  }
  json += '}';
}

void McapFile::sample(Time time) {
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    std::string json;
    append_json(sources_[i], json);
    add_message(source_topics_[i], time, json);
  }
}

void McapFile::happened(const RecordedEvent& event) {
  const Time time = std::llround(event.at_seconds() * static_cast<double>(second));
  const auto words = values_text(event);
  add_message(log_, time,
              json_text({{"timestamp", {{"sec", time / second}, {"nsec", time % second}}},
                         {"level", log_level(event.severity)},
                         {"message", words.empty() ? event.event : event.event + ": " + words},
                         {"name", event.source},
                         {"file", ""},
                         {"line", 0}}));
  if (event.values.empty()) return;
  const auto topic = fmt::format("/{}/{}", event.source, event.event);
  auto found = event_topics_.find(topic);
  if (found == event_topics_.end()) {
    Json properties = Json::object();
    for (const auto& value : event.values) properties[value.name] = number_schema(value.unit);
    const auto name = fmt::format("drycut.{}.{}", event.source, event.event);
    const Json described = {{"type", "object"}, {"properties", properties}, {"title", name}};
    found = event_topics_.emplace(topic, add_topic(topic, name, json_text(described))).first;
  }
  std::string json;
  for (const auto& value : event.values) {
    json += fmt::format("{}{}:", json.empty() ? "{" : ",", json_text(Json(value.name)));
    append_number(json, without_noise(value.number));
  }
  add_message(found->second, time, json + "}");
}

void McapFile::put(const std::string& records) {
  file_.write(records);
  size_ += records.size();
  check_ = check_sum(records, check_);
}

void McapFile::put_chunk() {
  const auto& records = chunk_.records;
  if (records.empty()) return;
  std::string compressed(ZSTD_compressBound(records.size()), '\0');
  const auto size = ZSTD_compress(compressed.data(), compressed.size(), records.data(), records.size(), 1);
  if (ZSTD_isError(size) != 0) throw std::runtime_error("no memory to compress with");
  compressed.resize(size);
  std::string body;
  append(body, static_cast<std::uint64_t>(chunk_.begin));
  append(body, static_cast<std::uint64_t>(chunk_.end));
  append(body, std::uint64_t{records.size()});
  append(body, check_sum(records));
  append_text(body, "zstd");
  append_text<std::uint64_t>(body, compressed);
  std::string out;
  append_record(out, chunk, body);
  const auto length = out.size();

  std::string places;
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    if (topics_[i].index.empty()) continue;
    const auto id = static_cast<std::uint16_t>(i + 1);
    append(places, id);
    append(places, size_ + out.size());
    body.clear();
    append(body, id);
    append_text(body, topics_[i].index);
    append_record(out, message_index, body);
    topics_[i].index.clear();
  }
  body.clear();
  append(body, static_cast<std::uint64_t>(chunk_.begin));
  append(body, static_cast<std::uint64_t>(chunk_.end));
  append(body, size_);
  append(body, std::uint64_t{length});
  append_text(body, places);
  append(body, std::uint64_t{out.size() - length});
  append_text(body, "zstd");
  append(body, std::uint64_t{compressed.size()});
  append(body, std::uint64_t{records.size()});
  append_record(chunk_indexes_, chunk_index, body);
  ++chunks_;
  chunk_ = {};
  put(out);
}

void McapFile::finish() {
  put_chunk();
  std::string out;
  std::string body;
  append(body, check_);
  append_record(out, data_end, body);
  put(out);

  // The summary: what is in the file, group by group, then where each group is.
  std::string schemas;
  std::string channels;
  std::string counts;
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    append_record(schemas, schema, topics_[i].schema);
    append_record(channels, channel, topics_[i].channel);
    append(counts, static_cast<std::uint16_t>(i + 1));
    append(counts, topics_[i].messages);
  }
  body.clear();
  append(body, messages_);
  append(body, static_cast<std::uint16_t>(topics_.size()));
  append(body, static_cast<std::uint32_t>(topics_.size()));
  append(body, std::uint32_t{0});  // attachments
  append(body, std::uint32_t{1});  // metadata
  append(body, chunks_);
  append(body, static_cast<std::uint64_t>(begin_));
  append(body, static_cast<std::uint64_t>(end_));
  append_text(body, counts);
  std::string figures;
  append_record(figures, statistics, body);

  const auto summary = size_;
  std::string offsets;
  out.clear();
  for (const auto& [code, group] : {std::pair<Opcode, const std::string&>(schema, schemas),
                                    {channel, channels},
                                    {statistics, figures},
                                    {metadata_index, metadata_index_},
                                    {chunk_index, chunk_indexes_}}) {
    if (group.empty()) continue;
    body.assign(1, static_cast<char>(code));
    append(body, summary + out.size());
    append(body, std::uint64_t{group.size()});
    append_record(offsets, summary_offset, body);
    out += group;
  }
  const auto offsets_place = summary + out.size();
  out += offsets;
  constexpr std::uint64_t footer_length = 20;
  out += static_cast<char>(footer);
  append(out, footer_length);
  append(out, summary);
  append(out, offsets_place);
  append(out, check_sum(out));
  out += magic;
  put(out);
  file_.flush();
}

}  // namespace drycut::sim::record
