#include "sim/scenario/extends.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "sim/file.hpp"
#include "sim/scenario/archive.hpp"

namespace drycut::sim::scenario {

namespace {

namespace fs = std::filesystem;
using Kind = YamlNode::Kind;

constexpr auto most_dots = 8;  // no parameter has as many

bool leaves_out(const YamlNode& node) { return node.kind == Kind::null && !node.text.text.empty(); }

YamlNode::Entry* entry_of(YamlNode& map, std::string_view key) {
  const auto found = std::find_if(map.entries.begin(), map.entries.end(), [&](const auto& entry) {
    return entry.key.text == key && !entry.is_repeated();
  });
  return found == map.entries.end() ? nullptr : &*found;
}

// servo.speed_gain: 1 becomes servo: {speed_gain: 1}. What would meet a value stays, and is told as given
// twice.
void nest(YamlNode& map) {
  for (std::size_t i = 0; i < map.entries.size(); ++i) {
    auto& entry = map.entries[i];
    const auto dot = entry.key.text.find('.');
    const auto dots = std::count(entry.key.text.begin(), entry.key.text.end(), '.');
    if (dots == 0 || dots > most_dots || entry.is_repeated()) continue;
    const auto first = entry.key.text.substr(0, dot);
    Text rest = entry.key;
    rest.text = entry.key.text.substr(dot + 1);
    auto* group = entry_of(map, first);
    if (group != nullptr && (group->value.kind != Kind::map || child(group->value, rest.text) != nullptr))
      continue;
    YamlNode::Entry inner{rest, entry.value};
    if (group != nullptr) {
      group->value.entries.push_back(std::move(inner));
      map.entries.erase(map.entries.begin() + static_cast<std::ptrdiff_t>(i--));
    } else {
      YamlNode made(Kind::map, {"", entry.key.place});
      made.entries.push_back(std::move(inner));
      entry = {Text{first, entry.key.place}, std::move(made)};
    }
  }
  for (auto& entry : map.entries)
    if (entry.value.kind == Kind::map) nest(entry.value);
}

bool has_parameters(const std::string& name) {
  const auto below = [&](std::string_view section) {
    return name.starts_with(section) && name.find('.', section.size()) == std::string::npos;
  };
  return below("plants.") || below("controller.plcopen.axes.");
}

class Merger {
 public:
  explicit Merger(Findings& findings) : findings_(findings) {}

  // Puts what `own` says into `base`, a map called `name`.
  void maps(YamlNode& base, YamlNode own, const std::string& name) {
    if (has_parameters(name)) {
      nest(base);
      nest(own);
    }
    base.text.place = own.text.place;
    std::vector<YamlNode::Entry> added;
    for (auto& entry : own.entries) {
      auto* const old = entry.is_repeated() ? nullptr : entry_of(base, entry.key.text);
      if (old != nullptr)
        change(base, *old, std::move(entry), name);
      else if (leaves_out(entry.value))
        nothing_to_leave_out(entry.key, keys_of(base));
      else
        added.push_back(std::move(entry));
    }
    // Two that are new do not stand beside each other.
    if (name == "variables" || name == "plants" || name == "controller.plcopen.axes") {
      const auto known = keys_of(base);
      for (auto& entry : added) entry.value.beside = known;
    }
    std::move(added.begin(), added.end(), std::back_inserter(base.entries));
  }

 private:
  void change(YamlNode& base, YamlNode::Entry& old, YamlNode::Entry own, const std::string& name) {
    const auto full = name.empty() ? own.key.text : name + "." + own.key.text;
    if (leaves_out(own.value)) {
      base.entries.erase(base.entries.begin() + (&old - base.entries.data()));
      return;
    }
    old.key = std::move(own.key);
    if (own.value.kind == Kind::map && old.value.kind == Kind::map)
      maps(old.value, std::move(own.value), full);
    else if (own.value.kind == Kind::map && has_names(old.value))
      list(old.value, std::move(own.value), full);
    else if (name == "variables")
      give(old, std::move(own.value));
    else
      old.value = std::move(own.value);
  }

  static bool has_names(const YamlNode& list) {
    return list.kind == Kind::sequence && !list.items.empty() &&
           std::all_of(list.items.begin(), list.items.end(),
                       [](const YamlNode& item) { return name_of_item(item) != nullptr; });
  }

  void list(YamlNode& base, YamlNode own, const std::string& full) {
    std::vector<std::string> names;
    for (const auto& item : base.items) names.push_back(name_of_item(item)->text);
    for (auto& entry : own.entries) {
      const auto& key = entry.key;
      if (entry.is_repeated()) {
        findings_.add("scenario.twice"_code, key.place,
                      fmt::format("'{}' is given twice in {}", key.text, full),
                      fmt::format("keep one; the first is at line {}", entry.first_line));
        continue;
      }
      const auto old = std::find_if(base.items.begin(), base.items.end(), [&](const YamlNode& item) {
        return name_of_item(item)->text == key.text;
      });
      if (leaves_out(entry.value)) {
        if (old == base.items.end())
          nothing_to_leave_out(key, names);
        else
          base.items.erase(old);
      } else if (entry.value.kind != Kind::map) {
        auto node = std::move(entry.value);
        if (node.kind == Kind::null) node.text.place = key.place;
        refuse_kind(node, full + "." + key.text, Kind::map, findings_);
      } else if (old != base.items.end()) {
        maps(*old, std::move(entry.value), full + "." + key.text);
      } else {
        auto& made = base.items.emplace_back(std::move(entry.value));
        made.entries.insert(made.entries.begin(), {Text{"name", key.place}, YamlNode(Kind::scalar, key)});
        made.beside = names;
      }
    }
  }

  static std::vector<std::string> keys_of(const YamlNode& map) {
    std::vector<std::string> keys;
    keys.reserve(map.entries.size());
    for (const auto& entry : map.entries) keys.push_back(entry.key.text);
    return keys;
  }

  void nothing_to_leave_out(const Text& key, const std::vector<std::string>& known) {
    findings_.add("scenario.unknown-name"_code, key.place,
                  fmt::format("there is no '{}' to leave out", key.text),
                  did_you_mean(key.text, known, "leave this line out"));
  }

  Findings& findings_;
};

// Reads a file and all that it extends, the innermost first.
class TreeReader {
 public:
  explicit TreeReader(Findings& findings) : findings_(findings) {}

  // `folder`: of `file`, seen from the scenario's.
  YamlNode read(std::string_view text, const fs::path& file, const fs::path& folder, int source) {
    chain_.push_back(file);
    auto root = parse_scenario(text, source, findings_);
    const auto extends =
        std::find_if(root.entries.begin(), root.entries.end(),
                     [](const YamlNode::Entry& entry) { return entry.key.text == "extends"; });
    if (extends == root.entries.end()) return root;
    const auto named = extends->value;
    const auto key = extends->key.place;
    root.entries.erase(extends);
    if (named.kind != Kind::scalar || named.text.text.empty()) {
      auto node = named;
      if (node.kind == Kind::null) node.text.place = key;
      refuse_kind(node, "extends", Kind::scalar, findings_);
      return {};
    }
    auto base = read_base(named.text, file, folder);
    if (base.kind == Kind::null) return {};
    if (base.kind != Kind::map || root.kind != Kind::map) {
      findings_.add("scenario.not-a-scenario"_code, named.text.place,
                    fmt::format("{} is no scenario", named.text.text),
                    "name a file with sections: scene, plants ...");
      return {};
    }
    Merger(findings_).maps(base, std::move(root), "");
    return base;
  }

 private:
  YamlNode read_base(const Text& named, const fs::path& file, const fs::path& folder) {
    const auto path = (file.parent_path() / named.text).lexically_normal();
    std::error_code ignored;
    std::vector<std::string> way;
    bool again = false;
    for (const auto& open : chain_) {
      again = again || fs::weakly_canonical(open, ignored) == fs::weakly_canonical(path, ignored);
      if (again) way.push_back(open.filename().string());
    }
    if (again) {
      findings_.add("scenario.extends-itself"_code, named.place,
                    fmt::format("{} extends itself: {} -> {}", path.filename().string(),
                                fmt::join(way, " -> "), path.filename().string()),
                    "let one of them extend nothing");
      return {};
    }
    const auto before = findings_.count();
    const auto text = read(path, named);
    if (!text) return {};
    const auto inner = (folder / named.text).lexically_normal().parent_path();
    const auto source = findings_.add_source(path.string(), inner);
    auto base = read(*text, path, inner, source);
    if (base.kind == Kind::null && findings_.count() == before)
      findings_.add("scenario.not-a-scenario"_code, named.place, fmt::format("{} is empty", named.text),
                    "name a scenario with sections");
    return base;
  }

  // A file that cannot be read is a problem where it is named, what is wrong in it where that stands.
  std::optional<std::string> read(const fs::path& path, const Text& named) {
    const std::string here = "extends";
    Problems problems;
    auto text = read_file(path, problems, {here, named.place.line, named.place.column});
    for (auto& problem : problems) {
      const auto source = problem.file == here ? named.place.source : findings_.add_source(problem.file);
      const auto remedy = source == named.place.source
                              ? did_you_mean(path.filename().string(), files_beside(path), problem.remedy)
                              : problem.remedy;
      findings_.add(problem.code, {problem.line, problem.column, source}, problem.what, remedy);
    }
    return text;
  }

  /// Scenarios in the folder of a file, in order.
  static std::vector<std::string> files_beside(const fs::path& path) {
    std::vector<std::string> names;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(path.parent_path(), ignored))
      if (entry.path().extension() == ".yaml") names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

  Findings& findings_;
  std::vector<fs::path> chain_;
};

}  // namespace

YamlNode read_tree(std::string_view text, const fs::path& file, Findings& findings) {
  return TreeReader(findings).read(text, file, {}, 0);
}

}  // namespace drycut::sim::scenario
