// The scenario written back, every default in force.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "sim/scenario/archive.hpp"
#include "sim/scenario/format.hpp"

namespace drycut::sim::scenario {

namespace {

// Writes one map: a line an entry, what is in an entry two columns further in.
class Writer final : public Archive {
 public:
  void value(const Key& key, const Form& form) override {
    if (!key.shown) return;
    if (const auto text = form.write(); !text.empty()) line("{}: {}", yaml_text(key.name), text);
  }

  void section(const Key& key, const Visit& visit) override {
    if (!key.shown) return;
    Writer inner;
    visit(inner);
    put(yaml_text(key.name), inner);
  }

  void list(const Key& key, const Items& items) override {
    if (!key.shown) return;
    std::vector<std::string> in_line;
    if (items.size > 0 && !items.in_line) line("{}:", key.name);
    for (std::size_t i = 0; i < items.size; ++i) {
      Writer item;
      items.visit(item, i);
      if (items.in_line)
        in_line.push_back(item.in_one_line());
      else if (item.is_in_line_)
        line("  - {}", item.in_one_line());
      else
        for (const auto& text : item.lines_) line("  {} {}", &text == &item.lines_.front() ? "-" : " ", text);
    }
    if (items.size == 0 || items.in_line) line("{}: {}", key.name, yaml_list(in_line));
  }

  void names(const Key& key, const Items& items) override {
    if (!key.shown) return;
    if (items.size == 0) return line("{}: {{}}", key.name);
    section(key, [&](Archive& inner) {
      for (std::size_t i = 0; i < items.size; ++i)
        inner.section({items.name(i), ""}, [&](Archive& item) { items.visit(item, i); });
    });
  }

  // Parameters of a group stand together in the table; a group that is taken up again later is written with
  // its full name.
  void table(const ParameterTable& table) override {
    std::string group;
    std::vector<std::string> seen;
    for (const auto& [name, meaning, form, covers] : table.rows) {
      if (!covers.empty()) continue;
      const auto dot = table.nested ? name.find('.') : std::string::npos;
      const auto first = dot == std::string::npos ? std::string() : name.substr(0, dot);
      if (!first.empty() && first != group && std::find(seen.begin(), seen.end(), first) == seen.end()) {
        line("{}:", first);
        seen.push_back(first);
        group = first;
      }
      if (first.empty() || first != group) {
        group.clear();
        line("{}: {}", yaml_text(name), form.write());
      } else {
        line("  {}: {}", name.substr(dot + 1), form.write());
      }
    }
  }

  void plants(const Key& key, std::vector<PlantEntry>& plants) override {
    Archive::names(key, plants, &PlantEntry::name);
  }

  void controller(const Key& key, std::unique_ptr<ControllerSection>& controller) override {
    if (!key.shown) return;
    section(key, [&](Archive& inner) {
      inner.section({controller->kind(), ""}, [&](Archive& own) { controller->visit(own); });
    });
  }

  void alone(const Form& form) override { single_ = form.write(); }
  bool instead(bool written, const Form& form) override {
    if (written) alone(form);
    return written;
  }
  void require(std::string_view, std::string_view) override {}
  void require_one(const std::vector<std::string_view>&, std::string_view, std::string_view) override {}
  void in_line() override { is_in_line_ = true; }

  [[nodiscard]] std::string text() const { return fmt::format("{}\n", fmt::join(lines_, "\n")); }

 private:
  template <typename... Values>
  void line(fmt::format_string<Values...> format, Values&&... values) {
    lines_.push_back(fmt::format(format, std::forward<Values>(values)...));
  }

  void put(const std::string& key, const Writer& inner) {
    if (inner.is_in_line_ || !inner.single_.empty()) return line("{}: {}", key, inner.in_one_line());
    line("{}:", key);
    for (const auto& text : inner.lines_) line("  {}", text);
  }

  [[nodiscard]] std::string in_one_line() const { return single_.empty() ? yaml_map(lines_) : single_; }

  std::vector<std::string> lines_;
  std::string single_;  ///< in place of lines
  bool is_in_line_ = false;
};

}  // namespace

std::string yaml_of(const std::function<void(Archive&)>& visit) {
  Writer writer;
  visit(writer);
  return writer.text();
}

std::string expand(const Scenario& scenario) {
  // visit() takes a scenario that may change, because other archives fill it; this archive only reads.
  return yaml_of([&](Archive& archive) { visit(archive, const_cast<Scenario&>(scenario)); });
}

std::string yaml_map(const std::vector<std::string>& entries) {
  return fmt::format("{{{}}}", fmt::join(entries, ", "));
}

std::string yaml_list(const std::vector<std::string>& items) {
  return fmt::format("[{}]", fmt::join(items, ", "));
}

std::string format_time(Time time) {
  // The largest unit in which three decimals hold it.
  struct Unit {
    Time size;
    std::string_view name;
  };
  static constexpr std::array<Unit, 4> units = {
      {{second, "s"}, {millisecond, "ms"}, {microsecond, "us"}, {1, "ns"}}};
  for (const auto& unit : units) {
    const bool fits = unit.size == 1 || (time >= unit.size && time % (unit.size / 1000) == 0);
    if (time != 0 && !fits) continue;
    auto text = fmt::format("{}", time / unit.size);
    if (const Time rest = time % unit.size; rest != 0) {
      text += fmt::format(".{:03}", rest / (unit.size / 1000));
      text.resize(text.find_last_not_of('0') + 1);
    }
    return fmt::format("{} {}", text, unit.name);
  }
  return "";
}

std::string yaml_quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    switch (c) {
      case '"':
        out += "\\\"";
        break;
      case '\\':
        out += "\\\\";
        break;
      case '\n':
        out += "\\n";
        break;
      case '\t':
        out += "\\t";
        break;
      case '\r':
        out += "\\r";
        break;
      default:
        out += c;
    }
  }
  return out + "\"";
}

std::string yaml_text(std::string_view text) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view(" _./-+^%").find(c) != std::string_view::npos;
  };
  const bool null_word = text == "null" || text == "Null" || text == "NULL";
  const bool bare = !text.empty() && !null_word && text.front() != ' ' && text.back() != ' ' &&
                    text.find("  ") == std::string_view::npos &&
                    std::string_view("-.%").find(text.front()) == std::string_view::npos &&
                    std::all_of(text.begin(), text.end(), plain);
  const bool negative_number = text.size() > 1 && text.front() == '-' &&
                               std::isdigit(static_cast<unsigned char>(text[1])) != 0 &&
                               std::all_of(text.begin(), text.end(), plain) && text.back() != ' ';
  return bare || negative_number ? std::string(text) : yaml_quoted(text);
}

}  // namespace drycut::sim::scenario
