#include "sim/scenario/yaml_node.hpp"

#include <fmt/format.h>
#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <sstream>
#include <unordered_map>

#include "base/plain_text.hpp"
#include "base/text.hpp"

namespace drycut::sim::scenario {

namespace {

constexpr int deepest = 100;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

// The lines of a text, for places: yaml-cpp counts columns in bytes, from 0.
class Lines {
 public:
  Lines(std::string_view text, int source) : text_(text), source_(source) {
    starts_.push_back(0);
    for (std::size_t i = 0; i < text.size(); ++i) {
      const bool return_only = text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n');
      if (text[i] == '\n' || return_only) starts_.push_back(i + 1);
    }
  }

  [[nodiscard]] std::size_t offset(const YAML::Mark& mark) const {
    const auto line =
        std::clamp<std::size_t>(static_cast<std::size_t>(std::max(mark.line, 0)), 0, starts_.size() - 1);
    return std::min(text_.size(), starts_[line] + static_cast<std::size_t>(std::max(mark.column, 0)));
  }
  [[nodiscard]] ScenePlace place(std::size_t offset) const {
    const auto after = std::upper_bound(starts_.begin(), starts_.end(), offset);
    const auto line = static_cast<std::size_t>(after - starts_.begin()) - 1;
    // From the place asked for last, if it is before this one in the line: a line may be a whole file.
    if (starts_[line] > last_offset_ || offset < last_offset_) {
      last_offset_ = starts_[line];
      last_column_ = 1;
    }
    for (; last_offset_ < offset; ++last_offset_) {
      if ((static_cast<unsigned char>(text_[last_offset_]) & 0xC0) != 0x80) ++last_column_;
    }
    return {static_cast<int>(line) + 1, last_column_, source_};
  }
  [[nodiscard]] ScenePlace place(const YAML::Mark& mark) const { return place(offset(mark)); }
  [[nodiscard]] std::string_view text() const { return text_; }
  // A variable stands before `mark` in its line.
  [[nodiscard]] bool has_variable(const YAML::Mark& mark) const {
    const auto line = std::min(static_cast<std::size_t>(std::max(mark.line, 0)), starts_.size() - 1);
    return text_.substr(starts_[line], offset(mark) - starts_[line] + 1).find("${") != std::string_view::npos;
  }
  // A colon stands at `mark`, behind a key and a text that has begun: "title: saw: test".
  [[nodiscard]] bool has_second_colon(const YAML::Mark& mark) const {
    const auto at = offset(mark);
    if (at >= text_.size() || text_[at] != ':') return false;
    const auto line = std::min(static_cast<std::size_t>(std::max(mark.line, 0)), starts_.size() - 1);
    const auto before = text_.substr(starts_[line], at - starts_[line]);
    const auto key = before.rfind(": ");
    return key != std::string_view::npos && before.find_first_of(",{}[]\"'", key) == std::string_view::npos;
  }
  // The word before `mark`: in "{speed: 0 m/min thickness: 2 mm}" a comma is missing before it.
  [[nodiscard]] std::string_view word_before(const YAML::Mark& mark) const {
    const auto end = offset(mark);
    auto begin = end;
    while (begin > 0 && !is_blank(text_[begin - 1])) --begin;
    return text_.substr(begin, end - begin);
  }
  // What stands in the line before that of `mark` if it is "2.CNT01 knife.encoder", without a colon.
  [[nodiscard]] std::string_view line_without_colon(const YAML::Mark& mark) const {
    for (auto line = static_cast<std::size_t>(std::max(mark.line, 0)); line-- > 0;) {
      auto begin = starts_[line];
      const auto whole = text_.substr(begin, starts_[line + 1] - begin);
      const auto content = trimmed(whole.substr(0, std::min(whole.find(" #"), whole.find('\n'))));
      if (content.empty() || content.front() == '#') continue;
      return content.find_first_of("-:{}[],\"'|>") == std::string_view::npos ? content : "";
    }
    return {};
  }
  // A tab before the first word of the line of `mark`; yaml-cpp's own message is not always about it.
  [[nodiscard]] std::optional<ScenePlace> indenting_tab(const YAML::Mark& mark) const {
    const auto line = std::min(static_cast<std::size_t>(std::max(mark.line, 0)), starts_.size() - 1);
    for (std::size_t i = starts_[line]; i < text_.size() && is_blank(text_[i]) && text_[i] != '\n'; ++i) {
      if (text_[i] == '\t') return place(i);
    }
    return {};
  }

 private:
  std::string_view text_;
  int source_;
  std::vector<std::size_t> starts_;
  mutable std::size_t last_offset_ = 0;
  mutable int last_column_ = 1;
};

// Bytes of the escape sequence of a double-quoted text that starts at `at`.
std::size_t escape_length(std::string_view raw, std::size_t at) {
  if (at + 1 >= raw.size()) return 1;
  switch (raw[at + 1]) {
    case 'x':
      return 4;
    case 'u':
      return 6;
    case 'U':
      return 10;
    default:
      return 2;
  }
}

// Bytes of the UTF-8 character that starts with `first`.
std::size_t character_length(char first) {
  const auto byte = static_cast<unsigned char>(first);
  if (byte >= 0xF0) return 4;
  if (byte >= 0xE0) return 3;
  return byte >= 0xC0 ? 2 : 1;
}

// Walks the value of a scalar beside the file's own characters, so that every byte of the value has its
// place.
class Alignment {
 public:
  Alignment(const Lines& lines, std::size_t start, const std::string& value)
      : lines_(lines), raw_(lines.text()), at_(start), value_(value) {}

  Text run() {
    quote_ = at_ < raw_.size() && (raw_[at_] == '"' || raw_[at_] == '\'') ? raw_[at_] : '\0';
    if (quote_ != '\0') ++at_;
    if (quote_ == '\0' && at_ < raw_.size() && (raw_[at_] == '|' || raw_[at_] == '>')) skip_block_header();
    Text text{value_, lines_.place(at_)};
    for (std::size_t i = 0; i < value_.size();) {
      const std::size_t before = at_;
      const std::size_t taken = take(i);
      i += taken;
      if (at_ - before != taken || taken != 1) text.breaks.push_back({i, lines_.place(at_)});
    }
    return text;
  }
  // A quoted scalar must end with its quote; yaml-cpp lets the end of the file close it.
  [[nodiscard]] bool closed() {
    if (quote_ == '\0') return true;
    while (at_ < raw_.size() && (is_blank(raw_[at_]) || (quote_ == '"' && raw_[at_] == '\\'))) ++at_;
    return at_ < raw_.size() && raw_[at_] == quote_;
  }

 private:
  void skip_block_header() {
    while (at_ < raw_.size() && raw_[at_] != '\n') ++at_;
    while (at_ < raw_.size() && is_blank(raw_[at_])) ++at_;
  }

  // One character of the value at `i` (a folded line end is one blank); returns its bytes in the value.
  std::size_t take(std::size_t i) {
    if (at_ >= raw_.size()) return 1;
    const char c = value_[i];
    if (quote_ == '"' && raw_[at_] == '\\') {
      at_ += escape_length(raw_, at_);
      while (raw_.substr(0, at_).ends_with('\n') && at_ < raw_.size() && is_blank(raw_[at_])) ++at_;
      return std::min(character_length(c), value_.size() - i);
    }
    if (quote_ == '\'' && c == '\'') {
      at_ += 2;
      return 1;
    }
    if (is_blank(c) && raw_[at_] != c) {
      while (at_ < raw_.size() && is_blank(raw_[at_])) ++at_;
      return 1;
    }
    if (c == '\n') {  // of a block: the next line's indentation belongs to no value
      ++at_;
      while (at_ < raw_.size() && raw_[at_] == ' ') ++at_;
      return 1;
    }
    if (c == ' ' && ends_line()) {
      while (at_ < raw_.size() && is_blank(raw_[at_])) ++at_;
      return 1;
    }
    const std::size_t bytes = std::min(character_length(c), value_.size() - i);
    at_ = std::min(raw_.size(), at_ + bytes);
    return bytes;
  }
  // Blanks before a line end are folded away with it.
  [[nodiscard]] bool ends_line() const {
    std::size_t next = at_;
    while (next < raw_.size() && raw_[next] == ' ') ++next;
    return next < raw_.size() && (raw_[next] == '\n' || raw_[next] == '\r');
  }

  const Lines& lines_;
  std::string_view raw_;
  std::size_t at_;
  const std::string& value_;
  char quote_ = '\0';
};

/// yaml-cpp makes single bytes of the escapes \\N (U+0085) and \\_ (U+00A0); this makes characters of them.
std::string in_utf8(const std::string& value) {
  std::string text;
  for (std::size_t at = 0; at < value.size();) {
    const auto length = utf8_length(value, at);
    if (length == 0) text += '\xC2';
    text += value.substr(at, std::max<std::size_t>(length, 1));
    at += std::max<std::size_t>(length, 1);
  }
  return text;
}

// Thrown to leave yaml-cpp from inside its events; caught in parse_yaml.
struct TooDeep {
  ScenePlace place;
};

// Builds the tree from yaml-cpp's events.
class Builder : public YAML::EventHandler {
 public:
  Builder(const Lines& lines, Findings& findings) : lines_(lines), findings_(findings) {}

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    refuse_anchor(mark, anchor);
    const auto offset = lines_.offset(mark);
    const char first = offset < lines_.text().size() ? lines_.text()[offset] : '\0';
    const bool written = first == '~' || first == 'n' || first == 'N';
    put(YamlNode{YamlNode::Kind::null, {written ? "~" : "", lines_.place(mark)}});
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    findings_.add("scenario.yaml-not-taken"_code, lines_.place(mark),
                  "aliases (*name) are not used in scenarios", "write the value out");
    put(YamlNode{YamlNode::Kind::null, {"", lines_.place(mark)}});
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& bytes) override {
    const auto value = in_utf8(bytes);
    if (const auto fault = text_fault(value))  // an escape, for the file itself is plain text
      findings_.add("scenario.yaml-syntax"_code, lines_.place(mark),
                    "an escape makes what is no text: " + fault->what, "leave it out");
    const bool odd = refuse_anchor(mark, anchor) || refuse_tag(mark, tag);
    Alignment alignment(lines_, lines_.offset(mark), value);
    auto text = odd ? Text{value, lines_.place(mark)} : alignment.run();
    if (!odd && !alignment.closed()) {
      findings_.add("scenario.yaml-syntax"_code, lines_.place(mark), "this quotation is not closed",
                    "end the text with the same quote");
    }
    put(YamlNode{YamlNode::Kind::scalar, std::move(text)});
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    begin(YamlNode::Kind::sequence, mark, tag, anchor);
  }
  void OnSequenceEnd() override { end(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    begin(YamlNode::Kind::map, mark, tag, anchor);
  }
  void OnMapEnd() override { end(); }

  YamlNode take() { return std::move(root_); }
  // Where the innermost [ or { that is still open stands.
  [[nodiscard]] std::optional<ScenePlace> open_bracket() const {
    for (auto level = open_.rbegin(); level != open_.rend(); ++level) {
      const auto& place = level->node.text.place;
      if (level->bracket) return place;
    }
    return {};
  }

 private:
  struct Level {
    YamlNode node;
    std::optional<Text> key;
    bool bracket = false;
    std::unordered_map<std::string, int> keys = {};  // of a map: first line of each
  };

  bool refuse_anchor(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (anchor == 0) return false;
    findings_.add("scenario.yaml-not-taken"_code, lines_.place(mark),
                  "anchors (&name) are not used in scenarios", "write the value out");
    return true;
  }
  bool refuse_tag(const YAML::Mark& mark, const std::string& tag) {
    if (tag.empty() || tag == "?" || tag == "!") return false;
    findings_.add("scenario.yaml-not-taken"_code, lines_.place(mark),
                  "tags (!name) are not used in scenarios", "write the value alone");
    return true;
  }

  void begin(YamlNode::Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    const auto place = lines_.place(mark);
    if (open_.size() >= deepest) throw TooDeep{place};
    refuse_anchor(mark, anchor);
    refuse_tag(mark, tag);
    const auto offset = lines_.offset(mark);
    const bool bracket =
        offset < lines_.text().size() && (lines_.text()[offset] == '[' || lines_.text()[offset] == '{');
    open_.push_back({YamlNode{kind, {"", place}}, {}, bracket});
  }
  void end() {
    auto node = std::move(open_.back().node);
    open_.pop_back();
    put(std::move(node));
  }
  void put(YamlNode node) {
    if (open_.empty()) {
      root_ = std::move(node);
      return;
    }
    auto& level = open_.back();
    if (level.node.kind == YamlNode::Kind::sequence) {
      level.node.items.push_back(std::move(node));
    } else if (level.key) {
      const int line = level.key->place.line;
      const auto [first, fresh] = level.keys.emplace(level.key->text, line);
      level.node.entries.push_back({std::move(*level.key), std::move(node), fresh ? 0 : first->second});
      level.key.reset();
    } else {
      if (node.kind != YamlNode::Kind::scalar) {
        findings_.add("scenario.yaml-syntax"_code, node.text.place,
                      fmt::format("{} cannot be a key", name_of(node.kind)), "write key: value");
      }
      level.key = std::move(node.text);
    }
  }

  const Lines& lines_;
  Findings& findings_;
  YamlNode root_;
  std::vector<Level> open_;
};

// yaml-cpp's words for the commonest slips, in words that say what to do.
void refuse_yaml(const YAML::ParserException& error, const Lines& lines,
                 const std::optional<ScenePlace>& open, Findings& findings) {
  auto place = lines.place(error.mark);
  const auto told = [&](Code code, std::string what, std::string remedy) {
    findings.add(code, place, std::move(what), std::move(remedy));
  };
  if (const auto tab = lines.indenting_tab(error.mark)) {
    place = *tab;
    return told("scenario.yaml-syntax"_code, "a tab in the indentation", "indent with spaces");
  }
  if (open && lines.has_variable(error.mark))
    return told("scenario.yaml-syntax"_code, "inside { } and [ ] a value with ${name} stands in quotes",
                "write \"${length} / 2\"");
  if (lines.has_second_colon(error.mark)) {
    const auto key = lines.word_before(error.mark);
    return told("scenario.yaml-syntax"_code, "a second ': ' behind a key",
                fmt::format("{}a text with a colon in it stands in quotes: title: \"saw: test\"",
                            open ? fmt::format("write a comma before '{}'; ", key) : ""));
  }
  const std::string opened =
      open ? fmt::format(" opened at line {}, column {}", open->line, open->column) : std::string();
  if (error.msg == YAML::ErrorMsg::END_OF_SEQ_FLOW)
    return told("scenario.yaml-syntax"_code, fmt::format("the list{} is not closed", opened),
                "write ] or a comma here");
  if (error.msg == YAML::ErrorMsg::END_OF_MAP_FLOW)
    return told("scenario.yaml-syntax"_code, fmt::format("the map{} is not closed", opened),
                "write } or a comma here");
  if (error.msg == YAML::ErrorMsg::UNKNOWN_TOKEN)
    return told("scenario.yaml-syntax"_code, "no YAML text begins like this", "put the text into quotes");
  if (error.msg == YAML::ErrorMsg::UNKNOWN_ANCHOR || error.msg.find("anchor") != std::string::npos)
    return told("scenario.yaml-not-taken"_code, "aliases (*name) are not used in scenarios",
                "write the value out");
  if (const auto line = lines.line_without_colon(error.mark);
      error.msg == YAML::ErrorMsg::MAP_VALUE && !open && !line.empty()) {
    place = lines.place(static_cast<std::size_t>(line.data() - lines.text().data()));
    return told("scenario.yaml-syntax"_code, fmt::format("there is no colon in {}", in_quotes(line)),
                "write key: value");
  }
  told("scenario.yaml-syntax"_code, fmt::format("not readable as YAML: {}", error.msg),
       "check indentation, colons and brackets here and in the line before");
}

}  // namespace

void Findings::add(Code code, const ScenePlace& place, std::string what, std::string remedy) {
  if (std::find(silent_.begin(), silent_.end(), place) != silent_.end()) return;
  found_.push_back({code, place, std::move(what), std::move(remedy)});
}

int Findings::add_source(std::string name, const std::filesystem::path& folder) {
  sources_.push_back(std::move(name));
  const auto source = static_cast<int>(sources_.size()) - 1;
  if (!folder.empty()) folders_[source] = folder;
  return source;
}

std::string Findings::path_from(const Text& text) const {
  const auto folder = folders_.find(text.place.source);
  if (folder == folders_.end() || text.text.empty()) return text.text;
  return (folder->second / text.text).lexically_normal().string();
}

Problems Findings::sorted() const {
  auto found = found_;
  std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
    return std::tie(a.place.source, a.place.line, a.place.column) <
           std::tie(b.place.source, b.place.line, b.place.column);
  });
  Problems problems;
  for (auto& [code, place, what, remedy] : found) {
    problems.push_back({code, sources_.at(static_cast<std::size_t>(place.source)), place.line, place.column,
                        std::move(what), std::move(remedy)});
  }
  return problems;
}

YamlNode parse_yaml(std::string_view text, int source, Findings& findings) {
  const Lines lines(text, source);
  const auto before = findings.count();
  Builder builder(lines, findings);
  try {
    std::istringstream stream{std::string(text)};
    YAML::Parser parser(stream);
    parser.HandleNextDocument(builder);
    auto root = builder.take();
    Builder rest(lines, findings);
    // Anything after the first document (a second one, or text after a closing bracket).
    if (parser.HandleNextDocument(rest)) {
      findings.add("scenario.yaml-not-taken"_code, rest.take().text.place,
                   "something stands after the end of the document",
                   "one document a file, and nothing after its closing bracket");
    }
    if (findings.count() == before) return root;
  } catch (const TooDeep& deep) {
    findings.add("scenario.yaml-not-taken"_code, deep.place,
                 fmt::format("nested more than {} levels deep", deepest), "nest less");
  } catch (const YAML::DeepRecursion& deep) {
    findings.add("scenario.yaml-not-taken"_code, lines.place(deep.mark),
                 fmt::format("nested more than {} levels deep", deepest), "nest less");
  } catch (const YAML::ParserException& error) {
    refuse_yaml(error, lines, builder.open_bracket(), findings);
  } catch (const std::exception& error) {
    findings.add("scenario.yaml-syntax"_code, {1, 1, source},
                 fmt::format("not readable as YAML: {}", error.what()), "a scenario is a YAML text");
  }
  return YamlNode{YamlNode::Kind::null, {"", {1, 1, source}}};
}

YamlNode parse_scenario(std::string_view text, int source, Findings& findings) {
  constexpr std::size_t largest_text = std::size_t{1} << 20U;  // [bytes]; yaml-cpp takes half a second for it
  if (text.size() > largest_text) {
    findings.add("scenario.yaml-not-taken"_code, {1, 1, source},
                 fmt::format("the text has {} bytes", text.size()),
                 fmt::format("a scenario has at most {}", largest_text));
    return {};
  }
  if (const auto fault = text_fault(text)) {
    findings.add("scenario.yaml-syntax"_code, {fault->line, fault->column, source}, fault->what,
                 "a scenario is a YAML text in UTF-8");
    return {};
  }
  return parse_yaml(text, source, findings);
}

void give(YamlNode::Entry& entry, YamlNode value) {
  value.first = std::move(entry.value.first);
  value.beside = std::move(entry.value.beside);
  if (value.first.empty()) value.first.push_back(std::move(entry.value));
  entry.value = std::move(value);
}

const YamlNode* child(const YamlNode& node, std::string_view key) {
  for (const auto& entry : node.entries)
    if (entry.key.text == key) return &entry.value;
  return nullptr;
}

const Text* name_of_item(const YamlNode& item) {
  const auto* name = child(item, "name");
  return name != nullptr && name->kind == YamlNode::Kind::scalar ? &name->text : nullptr;
}

std::string_view name_of(YamlNode::Kind kind) {
  switch (kind) {
    case YamlNode::Kind::null:
      return "nothing";
    case YamlNode::Kind::scalar:
      return "a single value";
    case YamlNode::Kind::sequence:
      return "a list";
    case YamlNode::Kind::map:
      return "a map";
  }
  return "";
}

}  // namespace drycut::sim::scenario
