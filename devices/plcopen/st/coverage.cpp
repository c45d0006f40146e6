#include "devices/plcopen/st/coverage.hpp"

#include <algorithm>

namespace drycut::devices::plcopen::st {
namespace {

/// What of the text the instructions between two places are: of a POU, or of what connects programs.
class CoverageReader {
 public:
  CoverageReader(const Compiled& code, const Counts& counts, std::span<const std::string> files, Coverage& to)
      : code_(code), counts_(counts), files_(files), to_(to) {}

  void read(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Origin& origin = code_.origins[i];
      if (origin.standard) continue;
      if (code_.code[i].statement && origin.statement > 0)
        file(origin.statement).line(line(origin.statement), counts_.passed[i]);
      if (origin.decision >= 0) i = condition(i, end);
      if (code_.code[i].op == StOp::choose) choice(i);
    }
  }

  /// Whether a body between two places has a statement of the text.
  [[nodiscard]] bool has_statements(std::size_t begin, std::size_t end) const {
    for (std::size_t i = begin; i < end; ++i)
      if (code_.code[i].statement && !code_.origins[i].standard && code_.origins[i].statement > 0)
        return true;
    return false;
  }

  void function(const Pou& pou) {
    file(pou.line).functions[{line(pou.line), pou.name}] +=
        counts_.passed[static_cast<std::size_t>(pou.body)];
  }

 private:
  /// From the first of a condition's jumps on to the last: it holds where that goes on.
  std::size_t condition(std::size_t first, std::size_t end) {
    const int decision = code_.origins[first].decision;
    Coverage::Count fails = 0;
    std::size_t last = first;
    for (std::size_t i = first; i < end; ++i) {
      if (code_.origins[i].decision != decision) continue;
      fails += counts_.refused[i];
      last = i;
    }
    const int at = code_.origins[first].line;
    file(at).line(line(at), counts_.passed[first]);
    // A constant decides nothing.
    const StInstruction& jump = code_.code[first];
    const bool one_jump = first == last && (jump.op == StOp::jump_if || jump.op == StOp::jump_unless);
    if (!one_jump || jump.a.base != Base::constant)
      file(at).decisions[line(at)].push_back({counts_.passed[last] - counts_.refused[last], fails});
    return last;
  }

  /// CASE: its bodies, and none of them, which an ELSE is.
  void choice(std::size_t at) {
    const StInstruction& of = code_.code[at];
    Coverage::Ways ways;
    Coverage::Count none = counts_.passed[at];
    int body = -1;
    for (std::uint32_t i = of.b.cells; i < of.b.cells + of.c.cells; ++i) {
      if (code_.choices[i].body == body) continue;
      body = code_.choices[i].body;
      ways.push_back(counts_.passed[static_cast<std::size_t>(body)]);
      none -= ways.back();
    }
    ways.push_back(none);
    const int number = code_.origins[at].line;
    file(number).decisions[line(number)].push_back(std::move(ways));
  }

  [[nodiscard]] Coverage::File& file(int line) { return to_.files[files_[code_.lines.at(line).file]]; }
  [[nodiscard]] int line(int of_all) const { return code_.lines.at(of_all).line; }

  const Compiled& code_;
  const Counts& counts_;
  std::span<const std::string> files_;
  Coverage& to_;
};

}  // namespace

Coverage coverage_of(const Compiled& code, const Counts& counts, std::span<const std::string> files) {
  Coverage all;
  CoverageReader reader(code, counts, files, all);
  // The bodies lie one behind the other, and behind them what connects programs.
  std::vector<const Pou*> bodies;
  for (const Pou& pou : code.pous)
    if (pou.body >= 0) bodies.push_back(&pou);
  std::size_t end = code.code.size();
  for (const auto& instance : code.instances)
    if (instance.before >= 0) end = std::min(end, static_cast<std::size_t>(instance.before));
  for (const auto& instance : code.instances)
    if (instance.after >= 0) end = std::min(end, static_cast<std::size_t>(instance.after));
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Pou& pou = *bodies[i];
    if (pou.line == 0 || is_test(pou.name) || is_test(pou.name.substr(pou.name.find('.') + 1))) continue;
    const auto first = static_cast<std::size_t>(pou.body);
    const auto last = i + 1 < bodies.size() ? static_cast<std::size_t>(bodies[i + 1]->body) : end;
    const bool by_methods = std::any_of(bodies.begin(), bodies.end(), [&](const Pou* other) {
      return other->name.starts_with(pou.name + ".");
    });
    // A block of methods alone has no body to be called.
    if (!by_methods || reader.has_statements(first, last)) reader.function(pou);
    reader.read(first, last);
  }
  reader.read(end, code.code.size());
  return all;
}

}  // namespace drycut::devices::plcopen::st
