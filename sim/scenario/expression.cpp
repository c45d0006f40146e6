#include "sim/scenario/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/state_archive.hpp"
#include "base/text.hpp"
#include "sim/scenario/expression_tree.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::scenario {

struct Expression::Compiled {
  struct Term {
    std::string text;
    std::string_view relation;  // "<", "<=", ">", ">=", or "" if the term does not compare so
    std::size_t left = 0;       // the whole term if it does not compare
    std::size_t right = 0;
    std::vector<const double*> uses;
  };
  struct Verdict {
    bool holds = false;
    double room = std::numeric_limits<double>::quiet_NaN();
  };

  void add_terms(std::string_view text, const ExpressionTokens& tokens, std::size_t node);
  [[nodiscard]] Verdict judge(const Term& term) const;
  // A term read as `value` below, or above, a limit.
  struct Side {
    std::size_t value = 0;
    std::size_t limit = 0;
    bool below = true;
    bool fixed = false;  // the limit is a number
  };
  [[nodiscard]] bool is_fixed(std::size_t node) const {
    const auto& nodes = tree.nodes;
    return std::none_of(nodes.begin() + static_cast<std::ptrdiff_t>(nodes[node].begin),
                        nodes.begin() + static_cast<std::ptrdiff_t>(node) + 1,
                        [](const auto& one) { return one.slot != nullptr; });
  }
  [[nodiscard]] std::optional<Side> side_of(const Term& term) const;
  [[nodiscard]] std::string text_of_value(const Term& term, const Side& side) const {
    const auto at = term.text.find(term.relation);
    auto text =
        side.value == term.left ? term.text.substr(0, at) : term.text.substr(at + term.relation.size());
    std::erase(text, ' ');
    return text;
  }
  // Computes the nodes from..to, both included.
  void compute_nodes(std::size_t from, std::size_t to) {
    for (auto i = from; i <= to; ++i) values[i] = compute(tree.nodes[i], values);
  }

  // A factor that is a condition or a number without unit: a switch of what it multiplies.
  struct Factor {
    std::size_t node = 0;
    std::string text;
    bool seen = false;  // other than 0
  };
  void add_factors(std::string_view text, const ExpressionTokens& tokens);

  ExpressionTree tree;
  std::vector<double> values;  // one a node
  std::vector<Factor> factors;
  bool evaluated = false;
  std::vector<Term> terms;
  std::vector<std::string> texts;
  bool has_margin = false;
};

namespace {

// A flag stands alone (AxisX.st_still); any other number that is compared with nothing would always hold.
bool is_condition(const ExpressionTokens& tokens, const ExpressionTree::Node& node) {
  constexpr std::array<std::string_view, 6> conditions{"==", "!=", "||", "&&", "!", "?"};
  if (node.last == node.first + 1 && tokens[node.first].kind == ExpressionToken::Kind::name) return true;
  const auto first = tokens.begin() + static_cast<std::ptrdiff_t>(node.first);
  const auto last = tokens.begin() + static_cast<std::ptrdiff_t>(node.last);
  return std::any_of(first, last, [&](const ExpressionToken& token) {
    return token.kind == ExpressionToken::Kind::sign &&
           (is_relation(token.text) || std::ranges::find(conditions, token.text) != conditions.end());
  });
}

}  // namespace

// Takes a conjunction apart: terms of && stand alone.
void Expression::Compiled::add_terms(std::string_view text, const ExpressionTokens& tokens,
                                     std::size_t node) {
  const auto& root = tree.nodes[node];
  if (root.sign == "&&") {
    add_terms(text, tokens, root.of[0]);
    add_terms(text, tokens, root.of[1]);
    return;
  }
  auto& term = terms.emplace_back();
  term.text = node_text(text, tokens, root);
  const bool compares = is_relation(root.sign);
  if (compares) term.relation = root.sign;
  term.left = compares ? root.of[0] : node;
  term.right = compares ? root.of[1] : node;
  for (auto i = root.begin; i <= node; ++i)
    if (tree.nodes[i].slot != nullptr && !tree.nodes[i].windowed) term.uses.push_back(tree.nodes[i].slot);
}

// Of (gbStep == 2) * abs(x) the condition, of flag * abs(x) the flag, of flag * (step > 1) * abs(x) both; the
// number in step * number is none.
void Expression::Compiled::add_factors(std::string_view text, const ExpressionTokens& tokens) {
  using Node = ExpressionTree::Node;
  const auto is_product = [](const Node& node) {
    return node.kind == Node::Kind::two && node.sign == "*" && !node.windowed;
  };
  const auto is_condition = [](const Node& node) {
    constexpr std::array<std::string_view, 4> signs{"==", "!=", "&&", "||"};
    return is_relation(node.sign) || std::ranges::find(signs, node.sign) != signs.end();
  };
  std::vector<bool> is_factor(tree.nodes.size(), false);
  for (const auto& node : tree.nodes)
    if (is_product(node)) is_factor[node.of[0]] = is_factor[node.of[1]] = true;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const auto& product = tree.nodes[i];
    if (!is_product(product)) continue;
    for (const bool second : {false, true}) {
      const auto at = product.of[second ? 1 : 0];
      const auto& other = tree.nodes[product.of[second ? 0 : 1]];
      const auto& node = tree.nodes[at];
      const bool is_flag = node.kind == Node::Kind::name &&
                           (is_factor[i] ? is_condition(other) : other.kind == Node::Kind::one);
      if (is_condition(node) || is_flag) factors.push_back({at, node_text(text, tokens, node)});
    }
  }
}

Expression::Compiled::Verdict Expression::Compiled::judge(const Term& term) const {
  const bool known = std::none_of(term.uses.begin(), term.uses.end(),
                                  [](const double* number) { return std::isnan(*number); });
  const double left = values[term.left];
  if (term.relation.empty()) return {known && !std::isnan(left) && left != 0, 0};
  const double right = values[term.right];
  if (term.relation == "<") return {known && left < right, right - left};
  if (term.relation == "<=") return {known && left <= right, right - left};
  if (term.relation == ">") return {known && left > right, left - right};
  return {known && left >= right, left - right};
}

Expression::Expression(std::unique_ptr<Compiled> compiled) : compiled_(std::move(compiled)) {}
Expression::Expression(Expression&&) noexcept = default;
Expression& Expression::operator=(Expression&&) noexcept = default;
Expression::~Expression() = default;

std::optional<Expression> Expression::compile(std::string_view text, const Resolver& resolve,
                                              const std::vector<std::string>& known,
                                              std::vector<ExpressionFault>& faults, Kind kind,
                                              const Resolver& inside) {
  const auto before = faults.size();
  const auto tokens = scan_expression(text, faults);
  if (faults.size() != before) return {};
  auto compiled = std::make_unique<Compiled>();
  compiled->tree = build_tree(text, tokens, {resolve, inside, known}, faults);
  const auto& tree = compiled->tree;
  if (faults.size() != before) return {};
  compiled->values.resize(tree.nodes.size());
  if (kind == Kind::number) return Expression(std::move(compiled));
  compiled->add_terms(text, tokens, tree.root);
  compiled->add_factors(text, tokens);
  const auto compares = [](const Compiled::Term& term) { return !term.relation.empty(); };
  compiled->has_margin = std::all_of(compiled->terms.begin(), compiled->terms.end(), compares);
  for (const auto& term : compiled->terms) {
    compiled->texts.push_back(term.text);
    const auto& node = tree.nodes[term.left];
    if (kind != Kind::condition || compares(term) || is_condition(tokens, node)) continue;
    faults.push_back({"expression.kind"_code, tokens[node.first].offset,
                      fmt::format("{} is a number, not a condition", in_quotes(term.text)),
                      "compare it with a limit: < <= > >= == !="});
  }
  if (kind == Kind::limit && !compiled->has_margin)
    faults.push_back({"expression.kind"_code, 0, "a constraint compares by < <= > >=",
                      "for example max(abs(knife.motor.torque)) <= 20"});
  if (faults.size() != before) return {};
  return Expression(std::move(compiled));
}

std::optional<Expression> Expression::compile(const Text& text, const Scenario& scenario,
                                              const Resolver& resolve, const std::vector<std::string>& known,
                                              Problems& problems, const Resolver& inside) {
  // The reader has said already that it is missing.
  if (text.text.empty() && text.place.line == 0) return {};
  std::vector<ExpressionFault> faults;
  auto expression = compile(text.text, resolve, known, faults, Kind::condition, inside);
  for (auto& fault : faults) {
    const auto problem = problem_at(fault.code, scenario, text.at(fault.offset), std::move(fault.what),
                                    std::move(fault.remedy));
    const bool said = std::any_of(problems.begin(), problems.end(), [&](const Problem& other) {
      return other.line == problem.line && other.column == problem.column && other.what == problem.what &&
             other.remedy == problem.remedy && other.file == problem.file;
    });
    if (!said) problems.push_back(problem);
  }
  return expression;
}

Evaluation Expression::evaluate() const {
  compiled_->compute_nodes(0, compiled_->tree.nodes.size() - 1);
  compiled_->evaluated = true;
  for (auto& factor : compiled_->factors) factor.seen = factor.seen || compiled_->values[factor.node] != 0;
  Evaluation result{true, {}, 0};
  double least = std::numeric_limits<double>::infinity();
  bool known = true;
  int index = 0;
  for (const auto& term : compiled_->terms) {
    const auto verdict = compiled_->judge(term);
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

std::string Expression::unmet() const {
  if (!compiled_->evaluated) return "";
  for (const auto& factor : compiled_->factors)
    if (!factor.seen) return factor.text;
  return "";
}

std::optional<Expression::Compiled::Side> Expression::Compiled::side_of(const Term& term) const {
  if (term.relation.empty()) return {};
  const bool below = term.relation.front() == '<';
  if (is_fixed(term.left) && !is_fixed(term.right)) return Side{term.right, term.left, !below, true};
  return Side{term.left, term.right, below, is_fixed(term.right)};
}

std::optional<double> Expression::used(int term) const {
  const auto& all = compiled_->terms;
  const auto& values = compiled_->values;
  const auto& own = all[static_cast<std::size_t>(term)];
  const auto side = compiled_->side_of(own);
  if (!side) return {};
  const double value = values[side->value];
  const double limit = values[side->limit];
  if (!std::isfinite(value) || !std::isfinite(limit)) return {};
  for (const auto& other : all) {
    const auto across = compiled_->side_of(other);
    if (!side->fixed || !across || !across->fixed || across->below == side->below ||
        compiled_->text_of_value(other, *across) != compiled_->text_of_value(own, *side))
      continue;
    const double low = side->below ? values[across->limit] : limit;
    const double high = side->below ? limit : values[across->limit];
    if (low < high) return std::abs(value - (low + high) / 2) / ((high - low) / 2);
  }
  // Below a limit under 0 is as above one over 0.
  const double size = side->below ? limit : -limit;
  const double found = side->below ? value : -value;
  if (size == 0) return {};
  if (size > 0) return std::max(0.0, found) / size;
  return found < 0 ? size / found : std::numeric_limits<double>::infinity();
}

std::pair<double, double> Expression::range_of(const double* name) const {
  using Node = ExpressionTree::Node;
  static const auto* const absolute = find_function("abs");
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  for (const auto& term : compiled_->terms) {
    const auto side = compiled_->side_of(term);
    if (!side || !side->fixed) continue;
    const auto& nodes = compiled_->tree.nodes;
    const Node* node = &nodes[side->value];
    const bool both = node->kind == Node::Kind::one && node->one == absolute->one;
    if (both) node = &nodes[node->of[0]];
    if (node->slot != name || (both && !side->below)) continue;
    const double factor = node->kind == Node::Kind::linear ? node->factor : 1;
    const double offset = node->kind == Node::Kind::linear ? node->number : 0;
    if (factor == 0) continue;
    const double edge = (compiled_->values[side->limit] - offset) / factor;
    const double other = (-compiled_->values[side->limit] - offset) / factor;
    if (both || side->below == (factor > 0)) high = std::min(high, both ? std::max(edge, other) : edge);
    if (both || side->below != (factor > 0)) low = std::max(low, both ? std::min(edge, other) : edge);
  }
  return {low, high};
}

double Expression::value() const {
  compiled_->compute_nodes(0, compiled_->tree.nodes.size() - 1);
  return compiled_->values[compiled_->tree.root];
}

const std::vector<std::string>& Expression::terms() const { return compiled_->texts; }
bool Expression::has_margin() const { return compiled_->has_margin; }

const std::deque<ExpressionStatistic>& Expression::statistics() const { return compiled_->tree.statistics; }

void Expression::start(double at) {
  for (auto& window : compiled_->tree.windows) window.running.start(at);
}

void Expression::start(std::size_t statistic, double at) {
  compiled_->tree.windows[statistic].running.start(at);
}

void Expression::take(double at) {
  for (std::size_t i = 0; i < compiled_->tree.windows.size(); ++i) take(i, at);
}

void Expression::take(std::size_t statistic, double at) {
  auto& window = compiled_->tree.windows[statistic];
  compiled_->compute_nodes(window.begin, window.root);
  window.running.take(at, compiled_->values[window.root]);
}

void Expression::finish() {
  auto& tree = compiled_->tree;
  for (std::size_t i = 0; i < tree.windows.size(); ++i)
    tree.statistics[i].value = tree.windows[i].running.result();
}

void Expression::visit(StateArchive& archive) {
  STATE(archive, compiled_->evaluated, compiled_->values);
  archive.each("factors", compiled_->factors, [&](Compiled::Factor& factor) { STATE(archive, factor.seen); });
  auto& tree = compiled_->tree;
  archive.each("statistics", tree.statistics, [&](ExpressionStatistic& of) { STATE(archive, of.value); });
  archive.each("windows", tree.windows,
               [&](ExpressionTree::Window& window) { STATE(archive, window.running); });
}

}  // namespace drycut::sim::scenario
