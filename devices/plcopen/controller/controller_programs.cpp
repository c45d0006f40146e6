// What one sees of the program while it runs: its text, the variables that each line names, where its tasks
// are.
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "devices/plcopen/controller/controller.hpp"
#include "devices/plcopen/st/code.hpp"
#include "devices/plcopen/st/lexer.hpp"

namespace drycut::devices::plcopen {
namespace {

using st::StToken;

/// Finds the variables that the lines of a text name.
class Namer {
 public:
  Namer(const st::Compiled& code, const std::map<std::string, std::size_t>& symbols, ProgramText& told)
      : code_(code), symbols_(symbols), told_(told) {
    Problems none;  // it has been compiled
    tokens_ = st::tokens_of(told.text, told.file, none);
  }

  void run() {
    while (tokens_[at_].kind != StToken::Kind::end) {
      const StToken& token = tokens_[at_];
      if (token.is("(")) {
        calls_.push_back(std::exchange(chain_, ""));
      } else if (token.is(")")) {
        if (!calls_.empty()) calls_.pop_back();
        chain_.clear();
      } else if (token.kind == StToken::Kind::name) {
        word();
        continue;
      } else {
        chain_.clear();
      }
      ++at_;
    }
  }

 private:
  [[nodiscard]] const StToken& ahead(std::size_t count) const {
    return tokens_[std::min(at_ + count, tokens_.size() - 1)];
  }

  void word() {
    const StToken& token = tokens_[at_];
    if (token.word("PROGRAM") || token.word("FUNCTION_BLOCK") || token.word("FUNCTION")) {
      enter(ahead(1).text);
      at_ += 2;
      return;
    }
    const int line = token.place.line;
    chain_ = chain();
    const bool pin = tokens_[at_].is(":=") || tokens_[at_].is("=>");
    if (pin && !calls_.empty() && !calls_.back().empty() && name(line, calls_.back() + "." + chain_)) return;
    name(line, chain_);
  }

  /// From now on names are those of this unit.
  void enter(std::string_view unit) {
    constexpr std::size_t most = 4;
    prefixes_.clear();
    for (const auto& scope : code_.scopes)
      if (same_word(scope.pou, unit) && prefixes_.size() < most) prefixes_.push_back(scope.prefix);
  }

  /// A name with its members and fixed elements: "CamIn.InSync", "pos[3].x"; what stands behind it is next.
  std::string chain() {
    std::string all(tokens_[at_++].text);
    for (;;) {
      if (tokens_[at_].is(".") && ahead(1).kind == StToken::Kind::name) {
        all += "." + std::string(ahead(1).text);
        at_ += 2;
      } else if (const auto size = fixed_index(all); size > 0) {
        at_ += size;
      } else {
        return all;
      }
    }
  }

  /// Adds `[3]` or `[2, 1]` to a name if that is next; how many tokens it has.
  [[nodiscard]] std::size_t fixed_index(std::string& all) const {
    if (!tokens_[at_].is("[")) return 0;
    std::string index;
    for (std::size_t i = 1; ahead(i).whole(); i += 2) {
      index += fmt::format("[{}]", ahead(i).value);
      if (ahead(i + 1).is(",")) continue;
      if (!ahead(i + 1).is("]")) return 0;
      all += index;
      return i + 2;
    }
    return 0;
  }

  /// True if that is a variable here: of the unit, of all its instances, or of all units.
  bool name(int line, const std::string& text) {
    bool found = false;
    for (const auto& prefix : prefixes_) found = add(line, prefix + text) || found;
    return found || add(line, text);
  }
  bool add(int line, const std::string& text) {
    const auto symbol = symbols_.find(lower(text));
    if (symbol == symbols_.end()) return false;
    told_.add_value(line, code_.symbols[symbol->second].name);
    return true;
  }

  const st::Compiled& code_;
  const std::map<std::string, std::size_t>& symbols_;
  ProgramText& told_;
  std::vector<StToken> tokens_;
  std::size_t at_ = 0;
  std::string chain_;                  ///< the name just read: what a parenthesis behind it calls
  std::vector<std::string> calls_;     ///< what the open parentheses call, "" = nothing
  std::vector<std::string> prefixes_;  ///< of the unit's instances
};

std::optional<int> first_line_with(const ProgramText& text, const std::string& value) {
  for (const auto& [line, names] : text.values)
    if (std::find(names.begin(), names.end(), value) != names.end()) return line;
  return std::nullopt;
}

}  // namespace

std::vector<ProgramText> PlcopenController::programs() {
  const st::Compiled& code = program_.compiled();
  std::vector<ProgramText> all;
  for (std::size_t i = 0; i < code.files.size(); ++i) {
    ProgramText& told = all.emplace_back(files_.at(i), "st", code.files[i].text);
    Namer(code, symbols_, told).run();
  }
  return all;
}

// A scan without statement_time takes no time: between two there is no place where it stands.
ProgramPositions PlcopenController::positions(std::int64_t time_ns) const {
  ProgramPositions told;
  ProgramPositions::Task task{computing_ ? computing_->task : "program", 0, 0, "", {}};
  if (!powered_) {
    task.doing = "no power";
  } else if (const auto& fault = runtime_.fault()) {
    task.line = fault->line;
    task.doing = "error: " + fault->text;
  } else if (computing_ && time_ns < computing_->ended_ns) {
    task.line = runtime_.line_at(time_ns - computing_->begun_ns);
    task.doing = "runs";
  }
  if (task.line > 0) {
    const auto at = program_.lines().at(task.line);
    task.program = at.file;
    task.line = at.line;
  }
  told.tasks.push_back(std::move(task));
  const std::string scanned = runtime_.scanned();
  for (std::size_t i = 0; i < program_.files().size(); ++i) {
    const auto first = static_cast<std::size_t>(program_.lines().first(i)) - 1;
    const auto count = split_lines(program_.files()[i].text).size();
    told.scanned.push_back(scanned.substr(std::min(first, scanned.size()), count));
  }
  return told;
}

// Of blocks without which no axis works. Moves, blocks that end a motion, and readings need not come.
std::vector<ProgramWait> PlcopenController::waits() {
  constexpr std::array needed{"MC_Power", "MC_Home", "MC_CamTableSelect", "MC_CamIn", "MC_GearIn"};
  std::vector<ProgramWait> waits;
  if (!powered_ || runtime_.fault()) return waits;
  const auto texts = programs();
  for (const ErrorPins& block : blocks_) {
    const auto type = runtime_.block_type(block.error);
    if (block.commanded || !block.command ||
        std::none_of(needed.begin(), needed.end(), [&](const char* name) { return type.starts_with(name); }))
      continue;
    const std::string& pin = runtime_.symbols()[*block.command].name;
    for (const auto& text : texts)
      if (const auto line = first_line_with(text, pin)) {
        waits.push_back({text.name, *line, 0});
        break;
      }
  }
  std::stable_sort(waits.begin(), waits.end(), [](const auto& a, const auto& b) { return a.line < b.line; });
  return waits;
}

std::vector<Controller::ProgramDoubt> PlcopenController::doubts() const {
  std::vector<ProgramDoubt> found;
  for (const auto& [code, line, column, text, value] : program_.compiled().doubts)
    found.push_back({code, fmt::format("{}: {}", told_place(line, column), text), value});
  return found;
}

std::vector<Controller::PositionLoop> PlcopenController::position_loops() {
  std::vector<PositionLoop> loops;
  for (std::size_t i = 0; i < plugs_.size(); ++i) {
    const Counter* counter = plugs_[i].encoder;
    const AnalogueOutput* dac = plugs_[i].reference;
    if (counter == nullptr || dac == nullptr) continue;
    loops.push_back({configuration_.axes[i].name,
                     [dac] { return dac->word * (dac_full_scale_volts / dac_full_scale); },
                     [counter] { return counter->count; },
                     {},
                     "turn the encoder or the drive round"});
  }
  return loops;
}

}  // namespace drycut::devices::plcopen
