#include "sim/studies/why/differences.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <optional>
#include <utility>

#include "sim/scenario/archive.hpp"
#include "sim/scenario/format.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::studies {

namespace {

using scenario::YamlNode;

/// Two sequences beside each other: what is the same has both places, what is not has one, and where as many
/// of one stand for as many of the other both, with `same` false.
struct Beside {
  std::optional<std::size_t> good;
  std::optional<std::size_t> failed;
  bool same = false;
};

/// A longest common subsequence; of sequences too long for that what they begin and end with alike.
template <typename Same>
std::vector<std::pair<std::size_t, std::size_t>> common(std::size_t good, std::size_t failed,
                                                        const Same& same) {
  constexpr std::size_t most_pairs = 25'000'000;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  std::size_t begin = 0;
  while (begin < good && begin < failed && same(begin, begin)) {
    pairs.emplace_back(begin, begin);
    ++begin;
  }
  std::size_t end = 0;
  while (end < good - begin && end < failed - begin && same(good - 1 - end, failed - 1 - end)) ++end;
  const auto rows = good - begin - end;
  const auto columns = failed - begin - end;
  if (rows > 0 && columns > 0 && rows <= most_pairs / columns) {
    std::vector<std::uint32_t> longest((rows + 1) * (columns + 1), 0);  // of what is left from there on
    const auto at = [&](std::size_t i, std::size_t j) -> std::uint32_t& {
      return longest[i * (columns + 1) + j];
    };
    for (auto i = rows; i-- > 0;)
      for (auto j = columns; j-- > 0;)
        at(i, j) = same(begin + i, begin + j) ? at(i + 1, j + 1) + 1 : std::max(at(i + 1, j), at(i, j + 1));
    for (std::size_t i = 0, j = 0; i < rows && j < columns;) {
      if (same(begin + i, begin + j)) {
        pairs.emplace_back(begin + i++, begin + j++);
      } else if (at(i + 1, j) >= at(i, j + 1)) {
        ++i;
      } else {
        ++j;
      }
    }
  }
  for (auto k = end; k-- > 0;) pairs.emplace_back(good - 1 - k, failed - 1 - k);
  return pairs;
}

/// Calls `use` with each stretch that is the same, and each gap between: [from, to) of both.
template <typename Same, typename Use>
void each_stretch(std::size_t good, std::size_t failed, const Same& same, const Use& use) {
  std::size_t i = 0;
  std::size_t j = 0;
  auto pairs = common(good, failed, same);
  pairs.emplace_back(good, failed);
  for (const auto& [a, b] : pairs) {
    if (i < a || j < b) use(i, a, j, b, false);
    if (a < good && b < failed) use(a, a + 1, b, b + 1, true);
    i = a + 1;
    j = b + 1;
  }
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t from = 0; from < text.size();) {
    const auto end = std::min(text.find('\n', from), text.size() - 1) + 1;
    lines.push_back(text.substr(from, end - from));
    from = end;
  }
  return lines;
}

std::string trimmed(std::string text) {
  const auto blank = [](unsigned char c) { return std::isspace(c) != 0; };
  text.erase(std::find_if_not(text.rbegin(), text.rend(), blank).base(), text.end());
  text.erase(text.begin(), std::find_if_not(text.begin(), text.end(), blank));
  return text;
}

std::string joined(const std::vector<std::string>& lines, std::size_t from, std::size_t to) {
  std::string text;
  for (; from < to; ++from) text += lines[from];
  return text;
}

/// For people: short, without quotes.
std::string shown(const YamlNode& node) {
  std::vector<std::string> parts;
  switch (node.kind) {
    case YamlNode::Kind::null:
      return "null";
    case YamlNode::Kind::scalar:
      return node.text.text;
    case YamlNode::Kind::sequence:
      for (const auto& item : node.items) parts.push_back(shown(item));
      return scenario::yaml_list(parts);
    case YamlNode::Kind::map:
      for (const auto& entry : node.entries)
        parts.push_back(fmt::format("{}: {}", entry.key.text, shown(entry.value)));
      return scenario::yaml_map(parts);
  }
  return "";
}

bool same_tree(const YamlNode& a, const YamlNode& b) { return text_of(a) == text_of(b); }

bool is_list_of_maps(const YamlNode& node) {
  return node.kind == YamlNode::Kind::sequence && !node.items.empty() &&
         std::ranges::all_of(node.items,
                             [](const YamlNode& item) { return item.kind == YamlNode::Kind::map; });
}

YamlNode scalar(std::string text) { return YamlNode(YamlNode::Kind::scalar, {std::move(text), {}, {}}); }

class Mixer {
 public:
  explicit Mixer(const Take& take) : take_(take) {}

  YamlNode mix(const YamlNode& good, const YamlNode& failed, const std::string& path) {
    if (good.kind == YamlNode::Kind::map && failed.kind == YamlNode::Kind::map)
      return maps(good, failed, path);
    const bool lists = (is_list_of_maps(good) || is_list_of_maps(failed)) &&
                       good.kind == YamlNode::Kind::sequence && failed.kind == YamlNode::Kind::sequence;
    if (lists) return sequences(good, failed, path);
    if (same_tree(good, failed)) return good;
    const bool bad = take_({Difference::Kind::value, path, shown(good), shown(failed)}) == TakenSide::failed;
    return bad ? failed : good;
  }

 private:
  static std::string below(const std::string& path, const std::string& key) {
    return path.empty() ? key : path + "." + key;
  }

  YamlNode maps(const YamlNode& good, const YamlNode& failed, const std::string& path) {
    YamlNode all(YamlNode::Kind::map, good.text);
    for (const auto& entry : good.entries) {
      const auto where = below(path, entry.key.text);
      if (const auto* other = scenario::child(failed, entry.key.text)) {
        all.entries.push_back({entry.key, mix(entry.value, *other, where)});
      } else if (take_({Difference::Kind::value, where, shown(entry.value), ""}) != TakenSide::failed) {
        all.entries.push_back(entry);
      }
    }
    for (const auto& entry : failed.entries) {
      if (scenario::child(good, entry.key.text) != nullptr) continue;
      const auto where = below(path, entry.key.text);
      // A section that one side lacks altogether is taken by its parts.
      const bool apart = path.empty() && entry.value.kind != YamlNode::Kind::scalar;
      if (apart) {
        auto part = mix(YamlNode(entry.value.kind, entry.value.text), entry.value, where);
        if (!part.entries.empty() || !part.items.empty()) all.entries.push_back({entry.key, std::move(part)});
      } else if (take_({Difference::Kind::value, where, "", shown(entry.value)}) == TakenSide::failed) {
        all.entries.push_back(entry);
      }
    }
    return all;
  }

  static bool alike(const YamlNode& a, const YamlNode& b) {
    const auto* one = scenario::name_of_item(a);
    const auto* other = scenario::name_of_item(b);
    if (one != nullptr && other != nullptr) return one->text == other->text;
    return one == other && same_tree(a, b);
  }

  YamlNode sequences(const YamlNode& good, const YamlNode& failed, const std::string& path) {
    YamlNode all(YamlNode::Kind::sequence, good.text);
    const auto where = [&](const YamlNode& item, std::size_t place) {
      const auto* name = scenario::name_of_item(item);
      return fmt::format("{}[{}]", path, name != nullptr ? name->text : std::to_string(place));
    };
    each_stretch(
        good.items.size(), failed.items.size(),
        [&](std::size_t i, std::size_t j) { return alike(good.items[i], failed.items[j]); },
        [&](std::size_t i, std::size_t to_i, std::size_t j, std::size_t to_j, bool) {
          // As many for as many: the same entries with other values.
          while (to_i - i == to_j - j && i < to_i) {
            all.items.push_back(mix(good.items[i], failed.items[j], where(good.items[i], i)));
            ++i;
            ++j;
          }
          for (; i < to_i; ++i)
            if (take_({Difference::Kind::entry, where(good.items[i], i), shown(good.items[i]), ""}) !=
                TakenSide::failed)
              all.items.push_back(good.items[i]);
          for (; j < to_j; ++j) {
            const auto side =
                take_({Difference::Kind::entry, where(failed.items[j], j), "", shown(failed.items[j])});
            if (side == TakenSide::good) continue;
            all.items.push_back(failed.items[j]);
            if (side == TakenSide::late) put_off(all.items.back());
          }
        });
    return all;
  }

  /// Later than any run.
  static void put_off(YamlNode& entry) {
    const auto late = scalar("1e6 s");
    for (auto& [key, value, line] : entry.entries)
      if (key.text == "at") {
        value = late;
        return;
      }
    entry.entries.push_back({{"at", {}, {}}, late});
  }

  const Take& take_;
};

}  // namespace

std::string Difference::text() const {
  if (kind == Kind::line) {
    const auto one = trimmed(good);
    const auto other = trimmed(failed);
    if (failed.empty()) return fmt::format("{}: without '{}'", where, one);
    if (good.empty()) return fmt::format("{}: with '{}'", where, other);
    return fmt::format("{}: '{}' -> '{}'", where, one, other);
  }
  if (failed.empty()) return fmt::format("{}: without {}", where, good);
  if (good.empty()) return fmt::format("{}: with {}", where, failed);
  return fmt::format("{}: {} -> {}", where, good, failed);
}

std::string Difference::preset() const {
  constexpr std::string_view set = ".set.";
  const auto at = where.find(set);
  return where.starts_with("controller.") && at != std::string::npos ? where.substr(at + set.size()) : "";
}

YamlNode without_looks(YamlNode root) {
  const auto drop = [](YamlNode& map, std::string_view key) {
    std::erase_if(map.entries, [&](const YamlNode::Entry& entry) { return entry.key.text == key; });
  };
  for (const auto* section : {"pictures", "opcua", "panel", "faults"}) drop(root, section);
  for (auto& [key, value, line] : root.entries) {
    if (key.text == "scene") drop(value, "title");
    if (key.text != "record") continue;
    drop(value, "channels");
    drop(value, "format");
  }
  return root;
}

YamlNode mixed_tree(const YamlNode& good, const YamlNode& failed, const Take& take) {
  return Mixer(take).mix(good, failed, "");
}

std::vector<Difference> differences_between(const scenario::Scenario& one, const scenario::Scenario& other) {
  scenario::Findings ignored({"expanded"});  // they were read
  const auto tree = [&](const scenario::Scenario& scenario) {
    return without_looks(scenario::parse_scenario(scenario::expand(scenario), 0, ignored));
  };
  std::vector<Difference> found;
  static_cast<void>(mixed_tree(tree(one), tree(other), [&](const Difference& difference) {
    found.push_back(difference);
    return TakenSide::good;
  }));
  return found;
}

std::string mixed_lines(const std::string& name, const std::string& good, const std::string& failed,
                        const Take& take) {
  const auto a = lines_of(good);
  const auto b = lines_of(failed);
  std::string text;
  const auto choose = [&](std::size_t i, std::size_t to_i, std::size_t j, std::size_t to_j) {
    const auto one = joined(a, i, to_i);
    const auto other = joined(b, j, to_j);
    const auto last = std::max(to_j, j + 1);
    const auto where =
        last - j == 1 ? fmt::format("{}:{}", name, j + 1) : fmt::format("{}:{}-{}", name, j + 1, last);
    text += take({Difference::Kind::line, where, one, other}) == TakenSide::failed ? other : one;
  };
  each_stretch(
      a.size(), b.size(), [&](std::size_t i, std::size_t j) { return a[i] == b[j]; },
      [&](std::size_t i, std::size_t to_i, std::size_t j, std::size_t to_j, bool same) {
        if (same) {
          text += a[i];
        } else if (to_i - i == to_j - j) {
          for (; i < to_i; ++i, ++j) choose(i, i + 1, j, j + 1);
        } else {
          choose(i, to_i, j, to_j);
        }
      });
  return text;
}

std::string text_of(const YamlNode& node) {
  std::vector<std::string> parts;
  switch (node.kind) {
    case YamlNode::Kind::null:
      return "~";
    case YamlNode::Kind::scalar:
      return scenario::yaml_quoted(node.text.text);
    case YamlNode::Kind::sequence:
      for (const auto& item : node.items) parts.push_back(text_of(item));
      return scenario::yaml_list(parts);
    case YamlNode::Kind::map:
      for (const auto& entry : node.entries)
        parts.push_back(fmt::format("{}: {}", scenario::yaml_quoted(entry.key.text), text_of(entry.value)));
      return scenario::yaml_map(parts);
  }
  return "";
}

bool same_but_numbers(std::string_view one, std::string_view other) {
  const auto is_number = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.'; };
  const auto stripped = [&](std::string_view text) {
    std::string rest;
    for (const char c : text) {
      if (c == ' ' || c == '\t') continue;
      if (!is_number(c)) {
        rest += c;
      } else if (rest.empty() || rest.back() != '0') {
        rest += '0';
      }
    }
    return rest;
  };
  return stripped(one) == stripped(other);
}

}  // namespace drycut::sim::studies
