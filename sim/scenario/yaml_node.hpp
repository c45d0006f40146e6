#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/problem.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::scenario {

/// A YAML document as a plain tree in which everything keeps its place. Scalars stay text: what a text means
/// is the reader's business.
struct YamlNode {
  enum class Kind { null, scalar, sequence, map };
  struct Entry;
  YamlNode();
  explicit YamlNode(Kind kind, Text text);

  Kind kind = Kind::null;
  Text text;  ///< of a scalar; of all kinds the place; "~" of nothing that is written so, or as null
  std::vector<YamlNode> items;  ///< of a sequence
  std::vector<Entry> entries;   ///< of a map, in the order of the file; duplicate keys are kept
  /// Of a variable: the value that it had first, in what is extended or in the file, if it was given another.
  std::vector<YamlNode> first;
  /// What is extended has none of this name but these: of a variable, a plant, a list's entry.
  std::vector<std::string> beside;
};
struct YamlNode::Entry {
  Text key;
  YamlNode value;
  int first_line = 0;  ///< of the first entry with this key, if this is another one
  /// refuse_duplicates has told it; it is not to be read.
  [[nodiscard]] bool is_repeated() const { return first_line > 0; }
};
inline YamlNode::YamlNode() = default;
inline YamlNode::YamlNode(Kind of, Text given) : kind(of), text(std::move(given)) {}

/// The problems of a scenario while it is being read: every text that takes part has a name, and the problems
/// come out in the order of the texts.
class Findings {
 public:
  explicit Findings(std::vector<std::string> sources) : sources_(std::move(sources)) {}
  void add(Code code, const ScenePlace& place, std::string what, std::string remedy);
  /// Another text takes part: its number. `folder`: of the file, seen from that of the scenario; "" = the
  /// same.
  int add_source(std::string name, const std::filesystem::path& folder = {});
  /// A file name that `text` gives, relative to the scenario's folder, whichever file it stands in.
  [[nodiscard]] std::string path_from(const Text& text) const;
  /// Nothing more is said of what stands exactly here: it has been told.
  void silence(const ScenePlace& place) { silent_.push_back(place); }
  [[nodiscard]] bool empty() const { return found_.empty(); }
  [[nodiscard]] std::size_t count() const { return found_.size(); }
  [[nodiscard]] const std::vector<std::string>& sources() const { return sources_; }
  /// All problems so far, in order of place.
  [[nodiscard]] Problems sorted() const;

 private:
  struct Found {
    Code code;
    ScenePlace place;
    Prose what;
    Prose remedy;
  };
  std::vector<std::string> sources_;
  std::map<int, std::filesystem::path> folders_;  ///< of sources that stand in another one than the scenario
  std::vector<Found> found_;
  std::vector<ScenePlace> silent_;
};

/// A scenario's text as a tree: a YAML text of scenario's size.
YamlNode parse_scenario(std::string_view text, int source, Findings& findings);

/// Reads one YAML document. Syntax errors, anchors, aliases, tags and second documents are problems at their
/// place in `source`, and then the tree is empty (null). Never throws.
YamlNode parse_yaml(std::string_view text, int source, Findings& findings);

/// Gives an entry another value, which remembers the first.
void give(YamlNode::Entry& entry, YamlNode value);

/// The first value of that key in a map; nullptr if there is none.
const YamlNode* child(const YamlNode& node, std::string_view key);

/// The name that an entry of a list gives itself; nullptr if it has none.
const Text* name_of_item(const YamlNode& item);

/// What kind of node it is, for messages: "a map", "a list", "a text", "nothing".
std::string_view name_of(YamlNode::Kind kind);

}  // namespace drycut::sim::scenario
