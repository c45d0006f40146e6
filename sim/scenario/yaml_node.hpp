#pragma once
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
  Text text;                    ///< of a scalar; of all kinds the place
  std::vector<YamlNode> items;  ///< of a sequence
  std::vector<Entry> entries;   ///< of a map, in the order of the file; duplicate keys are kept
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
  void add(const Place& place, std::string what, std::string remedy);
  /// Another text takes part: its number.
  int add_source(std::string name);
  [[nodiscard]] bool empty() const { return found_.empty(); }
  [[nodiscard]] std::size_t count() const { return found_.size(); }
  [[nodiscard]] const std::vector<std::string>& sources() const { return sources_; }
  /// All problems so far, in order of place.
  [[nodiscard]] Problems sorted() const;

 private:
  struct Found {
    Place place;
    std::string what;
    std::string remedy;
  };
  std::vector<std::string> sources_;
  std::vector<Found> found_;
};

/// Reads one YAML document. Syntax errors, anchors, aliases, tags and second documents are problems at their
/// place in `source`, and then the tree is empty (null). Never throws.
YamlNode parse_yaml(std::string_view text, int source, Findings& findings);

/// The first value of that key in a map; nullptr if there is none.
const YamlNode* child(const YamlNode& node, std::string_view key);

/// What kind of node it is, for messages: "a map", "a list", "a text", "nothing".
std::string_view name_of(YamlNode::Kind kind);

}  // namespace drycut::sim::scenario
