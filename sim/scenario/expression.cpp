#include "sim/scenario/expression.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>

#include "base/text.hpp"
#include "sim/scenario/expression_scan.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::scenario {

namespace {

using Kind = ExpressionToken::Kind;

double logical_not(double value) { return value == 0 ? 1 : 0; }

mu::Parser new_parser() {
  mu::Parser parser;
  parser.DefineInfixOprt("!", logical_not);
  return parser;
}

// Tokens first..last-1 of an expression.
struct Range {
  std::size_t first;
  std::size_t last;
};

struct Term {
  std::string text;
  std::string relation;  // "<", "<=", ">", ">=", or "" if the term does not compare so
  mu::Parser left;       // the whole term if it does not compare
  mu::Parser right;
  std::vector<const double*> uses;
};

struct Verdict {
  bool holds = false;
  double room = std::numeric_limits<double>::quiet_NaN();
};

Verdict judge(const Term& term) {
  const bool known = std::none_of(term.uses.begin(), term.uses.end(),
                                  [](const double* number) { return std::isnan(*number); });
  const double left = term.left.Eval();
  if (term.relation.empty()) return {known && !std::isnan(left) && left != 0, 0};
  const double right = term.right.Eval();
  if (term.relation == "<") return {known && left < right, right - left};
  if (term.relation == "<=") return {known && left <= right, right - left};
  if (term.relation == ">") return {known && left > right, left - right};
  return {known && left >= right, left - right};
}

// Builds the terms of a scanned expression.
class Compiler {
 public:
  Compiler(std::string_view text, const ExpressionTokens& tokens, const Expression::Resolver& resolve,
           const std::vector<std::string>& known, std::vector<ExpressionFault>& faults)
      : text_(text), tokens_(tokens), resolve_(resolve), known_(known), faults_(faults) {}

  std::deque<Term> run() {
    look_up_names();
    if (faults_.empty()) split({0, tokens_.size()});
    return std::move(terms_);
  }

 private:
  void look_up_names() {
    const auto functions = new_parser().GetFunDef();
    slots_.assign(tokens_.size(), nullptr);
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      const auto& token = tokens_[i];
      if (token.kind == Kind::function && !functions.contains(token.text)) {
        std::vector<std::string> names;
        for (const auto& [name, function] : functions) names.push_back(name);
        fault(token.offset, fmt::format("unknown function '{}'", token.text), suggest(token.text, names));
      }
      if (token.kind != Kind::name || token.text == "_pi" || token.text == "_e") continue;
      slots_[i] = resolve_(token.text);
      if (slots_[i] == nullptr) unknown_name(token);
    }
  }

  void unknown_name(const ExpressionToken& token) {
    std::string remedy = suggest(token.text, known_);
    const auto quantity = parse_quantity(token.text);
    if ((quantity && is_unit(quantity->unit)) || is_unit(token.text)) {
      remedy = "numbers carry no unit here: they are in the unit of the name they are compared with";
    }
    if (token.text == "and" || token.text == "AND") remedy = "write &&";
    if (token.text == "or" || token.text == "OR") remedy = "write ||";
    if (token.text == "not" || token.text == "NOT") remedy = "write !";
    fault(token.offset, fmt::format("unknown name '{}'", token.text), remedy);
  }

  static std::string suggest(const std::string& word, const std::vector<std::string>& candidates) {
    constexpr std::size_t few = 30;
    if (candidates.empty() || candidates.size() > few) return did_you_mean(word, candidates, "");
    return did_you_mean(word, candidates);
  }

  // Takes a conjunction apart: parentheses around the whole fall away, terms of && stand alone.
  void split(Range range) {
    while (tokens_[range.first].kind == Kind::open && tokens_[range.first].partner == range.last - 1) {
      range = {range.first + 1, range.last - 1};
    }
    std::vector<std::size_t> ands;
    std::size_t relation = range.last;
    bool plain = false;
    for (std::size_t i = range.first; i < range.last; ++i) {
      const auto& token = tokens_[i];
      if (token.kind == Kind::open) i = token.partner;
      if (token.text == "||" || token.text == "?") plain = true;
      if (token.text == "&&") ands.push_back(i);
      if (is_relation(token)) relation = i;
    }
    if (plain || (ands.empty() && relation == range.last)) return add(range, range.last);
    if (ands.empty()) return add(range, relation);
    ands.push_back(range.last);
    std::size_t first = range.first;
    for (const std::size_t end : ands) {
      split({first, end});
      first = end + 1;
    }
  }

  void add(Range range, std::size_t relation) {
    auto& term = terms_.emplace_back();
    const auto start = tokens_[range.first].offset;
    term.text = text_.substr(start, tokens_[range.last - 1].end - start);
    fill(term.left, term.uses, {range.first, relation});
    if (relation == range.last) return require_condition(term.text, range);
    term.relation = tokens_[relation].text;
    fill(term.right, term.uses, {relation + 1, range.last});
  }

  // A flag stands alone (AxisX.st_still); any other number that is compared with nothing would always hold.
  void require_condition(const std::string& text, Range range) {
    constexpr std::array<std::string_view, 6> conditions{"==", "!=", "||", "&&", "!", "?"};
    const bool flag = range.last == range.first + 1 && tokens_[range.first].kind == Kind::name;
    const auto decides = [&](const ExpressionToken& token) {
      return is_relation(token) || std::ranges::find(conditions, token.text) != conditions.end();
    };
    const auto first = tokens_.begin() + static_cast<std::ptrdiff_t>(range.first);
    if (flag || std::any_of(first, tokens_.begin() + static_cast<std::ptrdiff_t>(range.last), decides))
      return;
    fault(tokens_[range.first].offset, fmt::format("{} is a number, not a condition", in_quotes(text)),
          "compare it with a limit: < <= > >= == !=");
  }

  // muParser gets short names of its own: it would not take dots, indices and leading digits.
  void fill(mu::Parser& parser, std::vector<const double*>& uses, Range range) {
    parser = new_parser();
    std::string formula;
    for (std::size_t i = range.first; i < range.last; ++i) {
      const auto& token = tokens_[i];
      if (token.kind == Kind::name && slots_[i] != nullptr) {
        const auto name = fmt::format("v{}", i);
        // muParser asks for a writable slot because of its assignments, which the scanner refuses.
        parser.DefineVar(name, const_cast<double*>(slots_[i]));
        uses.push_back(slots_[i]);
        formula += name + " ";
      } else {
        formula += token.text;
        if (token.kind != Kind::function) formula += " ";  // muParser wants abs( without a blank
      }
    }
    try {
      parser.SetExpr(formula);
      parser.Eval();  // compiles it; later evaluations run the byte code
    } catch (const mu::ParserError& error) {
      refuse(error, range);
    }
  }

  void refuse(const mu::ParserError& error, Range range) {
    std::size_t offset = tokens_[range.first].offset;
    for (std::size_t i = range.first; i < range.last; ++i) {
      if (tokens_[i].kind != Kind::function || tokens_[i].text != error.GetToken()) continue;
      offset = tokens_[i].offset;
      break;
    }
    if (error.GetCode() == mu::ecTOO_MANY_PARAMS || error.GetCode() == mu::ecTOO_FEW_PARAMS) {
      const bool many = error.GetCode() == mu::ecTOO_MANY_PARAMS;
      return fault(offset, fmt::format("{} has too {} arguments", error.GetToken(), many ? "many" : "few"),
                   many ? "remove some" : "add what is missing");
    }
    fault(offset, fmt::format("not understood: {}", error.GetMsg()), "write it in a simpler form");
  }

  void fault(std::size_t offset, std::string what, std::string remedy) {
    faults_.push_back({offset, std::move(what), std::move(remedy)});
  }

  std::string_view text_;
  const ExpressionTokens& tokens_;
  const Expression::Resolver& resolve_;
  const std::vector<std::string>& known_;
  std::vector<ExpressionFault>& faults_;
  std::vector<const double*> slots_;
  std::deque<Term> terms_;
};

}  // namespace

struct Expression::Compiled {
  std::deque<Term> terms;
  std::vector<std::string> texts;
  bool has_margin = false;
};

Expression::Expression(std::unique_ptr<Compiled> compiled) : compiled_(std::move(compiled)) {}
Expression::Expression(Expression&&) noexcept = default;
Expression& Expression::operator=(Expression&&) noexcept = default;
Expression::~Expression() = default;

std::optional<Expression> Expression::compile(std::string_view text, const Resolver& resolve,
                                              const std::vector<std::string>& known,
                                              std::vector<ExpressionFault>& faults) {
  std::vector<ExpressionFault> own;
  const auto tokens = scan_expression(text, own);
  auto compiled = std::make_unique<Compiled>();
  if (own.empty()) compiled->terms = Compiler(text, tokens, resolve, known, own).run();
  faults.insert(faults.end(), own.begin(), own.end());
  if (!own.empty()) return {};
  for (const auto& term : compiled->terms) compiled->texts.push_back(term.text);
  compiled->has_margin = std::none_of(compiled->terms.begin(), compiled->terms.end(),
                                      [](const Term& term) { return term.relation.empty(); });
  return Expression(std::move(compiled));
}

std::optional<Expression> Expression::compile(const Text& text, const Scenario& scenario,
                                              const Resolver& resolve, const std::vector<std::string>& known,
                                              Problems& problems) {
  // The reader has said already that it is missing.
  if (text.text.empty() && text.place.line == 0) return {};
  std::vector<ExpressionFault> faults;
  auto expression = compile(text.text, resolve, known, faults);
  for (auto& fault : faults) {
    const auto problem =
        problem_at(scenario, text.at(fault.offset), std::move(fault.what), std::move(fault.remedy));
    const bool said = std::any_of(problems.begin(), problems.end(), [&](const Problem& other) {
      return other.line == problem.line && other.column == problem.column && other.what == problem.what &&
             other.remedy == problem.remedy && other.file == problem.file;
    });
    if (!said) problems.push_back(problem);
  }
  return expression;
}

Evaluation Expression::evaluate() const {
  Evaluation result{true, {}, 0};
  double least = std::numeric_limits<double>::infinity();
  bool known = true;
  int index = 0;
  for (const auto& term : compiled_->terms) {
    const auto verdict = judge(term);
    // A number that is none is worse than any limit passed.
    if (known && std::isnan(verdict.room)) {
      known = false;
      result.term = index;
    }
    if (compiled_->has_margin && known && verdict.room < least) {
      least = verdict.room;
      result.term = index;
    }
    if (!compiled_->has_margin && result.holds && !verdict.holds) result.term = index;
    result.holds = result.holds && verdict.holds;
    ++index;
  }
  if (compiled_->has_margin && known) result.margin = least;
  return result;
}

const std::vector<std::string>& Expression::terms() const { return compiled_->texts; }
bool Expression::has_margin() const { return compiled_->has_margin; }

}  // namespace drycut::sim::scenario
