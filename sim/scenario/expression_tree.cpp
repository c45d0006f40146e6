// From tokens to a tree: grammar, names, functions, statistics, units.
#include "sim/scenario/expression_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "sim/scenario/units.hpp"

namespace drycut::sim::scenario {

namespace {

using Node = ExpressionTree::Node;
using Token = ExpressionToken::Kind;

ExpressionUnit unit_of_operand(const Expression::Operand& operand) {
  if (!operand.unit) return {ExpressionUnit::Kind::untold};
  return {ExpressionUnit::Kind::known, *operand.unit};
}

class TreeBuilder {
 public:
  TreeBuilder(std::string_view text, const ExpressionTokens& tokens, const ExpressionNames& names)
      : text_(text), tokens_(tokens), names_(names) {}

  ExpressionTree run(std::vector<ExpressionFault>& faults) {
    tree_.root = choice();
    if (at_ < tokens_.size()) refuse(unexpected_token(tokens_[at_]));
    using Of = ExpressionFault::Of;
    const auto of = syntax_ ? Of::syntax : of_names_.empty() ? Of::values : Of::names;
    const auto& all = syntax_ ? std::vector{*syntax_} : of_names_.empty() ? of_values_ : of_names_;
    for (const auto& fault : all) faults.push_back({fault.code, fault.offset, fault.what, fault.remedy, of});
    return std::move(tree_);
  }

 private:
  // ---- faults ----

  // The first fault of syntax ends it: what is left is not looked at.
  void refuse(ExpressionFault fault) {
    if (!syntax_) syntax_ = std::move(fault);
    at_ = tokens_.size();
  }

  void not_closed() {
    refuse({"expression.syntax"_code, tokens_[open_.back()].offset, "this ( is not closed", "add )"});
  }

  void choice_without_colon(std::size_t offset) {
    refuse({"expression.syntax"_code, offset, "? without :", "write condition ? value : other value"});
  }

  // ---- grammar: each returns its node ----

  [[nodiscard]] bool is_next(std::string_view sign) const {
    return at_ < tokens_.size() && tokens_[at_].kind == Token::sign && tokens_[at_].text == sign;
  }

  std::size_t choice() {
    const auto begin = tree_.nodes.size();
    const auto first = at_;
    const auto condition = sum(0);
    if (!is_next("?")) return condition;
    ++at_;
    auto yes = choice();
    if (!colon()) return condition;
    auto no = choice();
    Node node;
    node.kind = Node::Kind::choice;
    node.unit = meet(yes, no);
    node.of = {condition, yes, no};
    return add(std::move(node), begin, first);
  }

  bool colon() {
    if (is_next(":")) {
      ++at_;
      return true;
    }
    if (at_ == tokens_.size()) {
      if (open_.empty())
        choice_without_colon(text_.size());
      else
        not_closed();
      return false;
    }
    const bool in_call =
        !open_.empty() && open_.back() > 0 && tokens_[open_.back() - 1].kind == Token::function;
    const bool ends = tokens_[at_].kind == Token::close ? !open_.empty() : in_call && is_next(",");
    if (ends)
      choice_without_colon(tokens_[at_].offset);
    else
      refuse(unexpected_token(tokens_[at_]));
    return false;
  }

  // Values joined by operators that bind as strongly as `level`, or more.
  std::size_t sum(int level) {
    const auto begin = tree_.nodes.size();
    const auto first = at_;
    auto left = signed_value();
    bool compared = false;
    while (at_ < tokens_.size()) {
      const auto* const by = find_operator(tokens_[at_]);
      if (by == nullptr || by->level < level) break;
      if (by->level == comparison_level && compared) {
        refuse({"expression.syntax"_code, tokens_[at_].offset, "comparisons cannot be chained",
                "write a < b && b < c"});
        break;
      }
      compared = by->level == comparison_level;
      ++at_;
      const auto right = sum(by->level + 1);
      left = join(*by, left, right, begin, first);
    }
    return left;
  }

  // Signs bind less than ^: -2^2 is -4.
  std::size_t signed_value() {
    const auto begin = tree_.nodes.size();
    const auto first = at_;
    if (is_next("+")) {
      ++at_;
      const auto operand = signed_value();
      tree_.nodes[operand].sign = {};
      tree_.nodes[operand].first = first;
      tree_.nodes[operand].last = at_;
      return operand;
    }
    if (!is_next("-") && !is_next("!")) return power();
    const bool minus = is_next("-");
    ++at_;
    const auto operand = signed_value();
    if (minus) return apply([](double x) { return -x; }, operand, unit(operand), begin, first);
    const auto result = apply([](double x) { return x == 0 ? 1.0 : 0.0; }, operand, {}, begin, first);
    return result;
  }

  std::size_t power() {
    const auto begin = tree_.nodes.size();
    const auto first = at_;
    const auto base = value();
    if (!is_next("^")) return base;
    const auto* const by = find_operator(tokens_[at_]);
    ++at_;
    const auto exponent = signed_value();
    return join(*by, base, exponent, begin, first);
  }

  std::size_t value() {
    if (at_ < tokens_.size()) {
      switch (tokens_[at_].kind) {
        case Token::number:
          return number();
        case Token::name:
          return name();
        case Token::function:
          return call();
        case Token::open: {
          open_.push_back(at_++);
          const auto inner = choice();
          close();
          return inner;
        }
        case Token::close:
        case Token::sign:
          break;
      }
    }
    refuse(at_ < tokens_.size() ? missing_value(tokens_[at_]) : missing_last_value(text_.size()));
    return nothing();
  }

  void close() {
    if (at_ == tokens_.size()) return not_closed();
    if (tokens_[at_].kind != Token::close) return refuse(unexpected_token(tokens_[at_]));
    ++at_;
    open_.pop_back();
  }

  std::size_t number() {
    const auto& token = tokens_[at_++];
    Node node;
    node.number = token.value;
    if (!token.unit.empty())
      node.unit = {ExpressionUnit::Kind::known, token.unit, true};
    else if (names_.bare_is_pure)
      node.unit = {ExpressionUnit::Kind::known, ""};
    return add(std::move(node), tree_.nodes.size(), at_ - 1);
  }

  std::size_t name() {
    const auto& token = tokens_[at_++];
    Node node;
    if (token.text == "_pi") {
      node.number = std::numbers::pi;
    } else if (token.text == "_e") {
      node.number = std::numbers::e;
    } else {
      const bool inside = statistic_ < tree_.statistics.size();
      const auto operand = (inside ? names_.inside : names_.resolve)(token.text);
      if (operand.why)
        of_names_.push_back({operand.why->code, token.offset, operand.why->what, operand.why->remedy});
      else if (operand.number == nullptr)
        of_names_.push_back(unknown_name(token, names_.known));
      node.kind = operand.number == nullptr ? Node::Kind::number : Node::Kind::name;
      node.slot = operand.number;
      node.unit = unit_of_operand(operand);
      if (inside) look_at(token);
    }
    return add(std::move(node), tree_.nodes.size(), at_ - 1);
  }

  // ---- functions and statistics ----

  std::size_t call() {
    const auto first = at_;
    const auto& token = tokens_[at_];
    if (names_.inside && RunningStatistic::named(token.text)) {
      const bool plain = (token.text == "max" || token.text == "min") && has_comma(at_ + 1);
      if (!plain) return statistic();
    }
    const auto begin = tree_.nodes.size();
    const auto* const function = find_function(token.text);
    if (function == nullptr) of_names_.push_back(unknown_function(token, names_.inside != nullptr));
    const auto operands = arguments();
    if (function == nullptr || syntax_) return nothing();
    const std::size_t wanted = function->two == nullptr ? 1 : 2;
    if (!function->any_number && operands.size() != wanted) {
      of_values_.push_back(wrong_arity(token, operands.size() > wanted));
      return nothing();
    }
    if (function->one != nullptr) {
      auto operand = operands[0];
      const auto result = unit_of_call(*function, operand);
      return apply(function->one, operand, result, begin, first);
    }
    return of_several(*function, operands, begin, first);
  }

  // True if the call whose ( is token `open` has several arguments.
  [[nodiscard]] bool has_comma(std::size_t open) const {
    int depth = 0;
    for (auto i = open; i < tokens_.size(); ++i) {
      if (tokens_[i].kind == Token::open) ++depth;
      if (tokens_[i].kind == Token::close && --depth == 0) return false;
      if (depth == 1 && tokens_[i].text == ",") return true;
    }
    return false;
  }

  // From the function's name to behind its ).
  std::vector<std::size_t> arguments() {
    std::vector<std::size_t> nodes;
    ++at_;
    open_.push_back(at_++);
    nodes.push_back(choice());
    while (is_next(",")) {
      ++at_;
      nodes.push_back(choice());
    }
    close();
    return nodes;
  }

  std::size_t of_several(const ExpressionFunction& function, std::vector<std::size_t> operands,
                         std::size_t begin, std::size_t first) {
    auto left = operands[0];
    if (operands.size() == 1) return apply([](double x) { return x; }, left, unit(left), begin, first);
    for (std::size_t i = 1; i < operands.size(); ++i) {
      const auto unit = meet(left, operands[i]);
      left = two(function.two, left, operands[i], unit, begin, first);
    }
    if (function.units == ExpressionFunction::Units::arc)
      tree_.nodes[left].unit = {ExpressionUnit::Kind::known, "rad"};
    if (function.name != "avg") return left;
    const auto of = unit(left);
    Node count;
    count.number = static_cast<double>(operands.size());
    const auto right = add(std::move(count), tree_.nodes.size(), first);
    return two([](double a, double b) { return a / b; }, left, right, of, begin, first);
  }

  ExpressionUnit unit_of_call(const ExpressionFunction& function, std::size_t& operand) {
    using Units = ExpressionFunction::Units;
    auto of = unit(operand);
    switch (function.units) {
      case Units::same:
        return of;
      case Units::whole:  // 1 m / 5 mm is 200, and not 0.2 m/mm
        if (of.text.find('/') == std::string::npos || !same_dimension(of.text, "")) return of;
        convert(operand, {ExpressionUnit::Kind::known, ""}, std::string(function.name));
        return {};
      case Units::root:
        return unit_of_root(of);
      case Units::angle:
        if (of.carries) convert(operand, {ExpressionUnit::Kind::known, "rad"}, std::string(function.name));
        return {};
      case Units::arc:
      case Units::none:
        if (of.carries) convert(operand, {ExpressionUnit::Kind::known, ""}, std::string(function.name));
        return function.units == Units::none ? ExpressionUnit{}
                                             : ExpressionUnit{ExpressionUnit::Kind::known, "rad"};
      case Units::free:
        break;
    }
    return {};
  }

  std::size_t statistic() {
    const auto first = at_;
    const auto begin = tree_.nodes.size();
    const auto& token = tokens_[first];
    const bool inside = statistic_ < tree_.statistics.size();
    if (inside)
      of_names_.push_back({"expression.not-here"_code, token.offset,
                           fmt::format("{} inside {}", token.text, tokens_[statistic_at_].text),
                           "a term looks at channels or event values"});
    const auto index = tree_.statistics.size();
    if (!inside) {
      statistic_ = index;
      statistic_at_ = first;
      tree_.statistics.emplace_back();
      tree_.windows.push_back({*RunningStatistic::named(token.text), begin, begin});
    }
    auto operands = arguments();
    if (inside || syntax_) return nothing();
    statistic_ = none;
    for (auto i = begin; i < tree_.nodes.size(); ++i) tree_.nodes[i].windowed = true;
    return finish_statistic(index, operands, begin, first);
  }

  std::size_t finish_statistic(std::size_t index, std::vector<std::size_t>& operands, std::size_t begin,
                               std::size_t first) {
    const auto& token = tokens_[first];
    auto& statistic = tree_.statistics[index];
    auto& window = tree_.windows[index];
    const std::size_t wanted = window.running.has_band() ? 2 : 1;
    if (operands.size() != wanted) {
      of_values_.push_back(
          {"expression.arguments"_code, token.offset,
           fmt::format("{} has {} arguments", token.text, operands.size()),
           wanted == 2 ? "write settling(AxisX.follerr, 10): the expression and its band" : "it takes one"});
      return nothing();
    }
    if (statistic.names.empty())
      of_values_.push_back({"expression.kind"_code, tokens_[first + 1].end,
                            "no channel and no event value is in it", "for example rms(AxisX.follerr)"});
    if (wanted == 2) {
      meet(operands[0], operands[1]);
      const auto& band = tree_.nodes[operands[1]];
      if (band.kind != Node::Kind::number || !(band.number >= 0))
        of_values_.push_back({"expression.kind"_code, tokens_[tree_.nodes[operands[0]].last].end,
                              "the band of settling is no number from 0 on",
                              "for example settling(AxisX.follerr, 10)"});
      window.running.set_band(band.number);
    }
    window.root = operands[0];
    const auto of = unit(operands[0]);
    const auto text = window.running.unit(of.text);
    Node node;
    node.kind = Node::Kind::name;
    node.slot = &statistic.value;
    // Numbers of it are counts or seconds, or in the unit of what it looks at.
    node.unit = text == of.text ? of : ExpressionUnit{ExpressionUnit::Kind::known, text};
    const auto made = add(std::move(node), begin, first);
    statistic.text = node_text(text_, tokens_, tree_.nodes[made]);
    statistic.unit = text;
    return made;
  }

  void look_at(const ExpressionToken& token) {
    auto& names = tree_.statistics[statistic_].names;
    const auto same = [&](const ExpressionStatistic::Name& name) { return name.text == token.text; };
    if (std::none_of(names.begin(), names.end(), same)) names.push_back({token.text, token.offset});
  }

  // ---- nodes ----

  [[nodiscard]] const ExpressionUnit& unit(std::size_t node) const { return tree_.nodes[node].unit; }

  /// Its own nodes are those from `begin` on, its tokens those from `first` to the present one.
  std::size_t add(Node node, std::size_t begin, std::size_t first) {
    node.begin = begin;
    node.first = first;
    node.last = at_;
    tree_.nodes.push_back(std::move(node));
    return tree_.nodes.size() - 1;
  }

  // Something to go on with after a fault.
  std::size_t nothing() {
    Node node;
    node.unit.kind = ExpressionUnit::Kind::untold;
    return add(std::move(node), tree_.nodes.size(), at_ == 0 ? 0 : at_ - 1);
  }

  std::size_t apply(double (*one)(double), std::size_t operand, ExpressionUnit unit, std::size_t begin,
                    std::size_t first) {
    Node node;
    node.unit = std::move(unit);
    const auto& of = tree_.nodes[operand];
    if (of.kind == Node::Kind::number) {
      node.number = one(of.number);
    } else {
      node.kind = Node::Kind::one;
      node.one = one;
      node.of[0] = operand;
    }
    return add(std::move(node), begin, first);
  }

  std::size_t two(double (*function)(double, double), std::size_t left, std::size_t right,
                  ExpressionUnit unit, std::size_t begin, std::size_t first) {
    Node node;
    node.kind = Node::Kind::two;
    node.two = function;
    node.of = {left, right, 0};
    node.unit = std::move(unit);
    return add(std::move(node), begin, first);
  }

  std::size_t join(const ExpressionOperator& by, std::size_t left, std::size_t right, std::size_t begin,
                   std::size_t first) {
    const auto unit = unit_of_joined(by, left, right);
    if (auto node = folded(by, tree_.nodes[left], tree_.nodes[right])) {
      node->unit = unit;
      return add(std::move(*node), begin, first);
    }
    const auto made =
        two(operation(by, tree_.nodes[left], tree_.nodes[right]), left, right, unit, begin, first);
    tree_.nodes[made].sign = by.sign;
    return made;
  }

  // ---- units ----

  ExpressionUnit unit_of_joined(const ExpressionOperator& by, std::size_t& left, std::size_t& right) {
    if (by.sign == "*" || by.sign == "/") return unit_of_product(unit(left), unit(right), by.sign == "/");
    if (by.sign == "^") {
      const auto& exponent = tree_.nodes[right];
      if (unit(left).kind == ExpressionUnit::Kind::any || exponent.kind == Node::Kind::number)
        return unit_of_power(unit(left), exponent.number);
      return {ExpressionUnit::Kind::mixed, "", unit(left).carries};
    }
    if (by.level < comparison_level) return {};
    const auto common = meet(left, right);
    return by.level == comparison_level ? ExpressionUnit{} : common;
  }

  // Two nodes that are added or compared: one with a number that has a unit is put into the other's unit.
  ExpressionUnit meet(std::size_t& left, std::size_t& right) {
    if (unit(right).carries)
      convert(right, unit(left), node_text(text_, tokens_, tree_.nodes[left]));
    else if (unit(left).carries)
      convert(left, unit(right), node_text(text_, tokens_, tree_.nodes[right]));
    return unit_of_sum(unit(left), unit(right));
  }

  // `met` is the text of what is in the unit `into`.
  void convert(std::size_t& node, ExpressionUnit into, const std::string& met) {
    using Kind = ExpressionUnit::Kind;
    const auto from = unit(node);
    if (from.kind == Kind::untold || into.kind == Kind::any || into.kind == Kind::untold) return;
    const auto own = node_text(text_, tokens_, tree_.nodes[node]);
    if (auto wrong = wrong_unit(own, from, met, into)) {
      wrong->offset = tokens_[tree_.nodes[node].first].offset;
      of_values_.push_back(std::move(*wrong));
      return;
    }
    if (from.text == into.text) return;
    const auto converted = [&](double number) { return from_si(to_si(number, from.text), into.text); };
    auto& present = tree_.nodes[node];
    into.carries = true;
    if (present.kind == Node::Kind::number) {
      present.number = converted(present.number);
      present.unit = into;
      return;
    }
    rescale(node, converted(0), converted(1) - converted(0), into);
  }

  void rescale(std::size_t& node, double offset, double factor, const ExpressionUnit& into) {
    const auto begin = tree_.nodes[node].begin;
    const auto first = tree_.nodes[node].first;
    const auto last = tree_.nodes[node].last;
    const auto constant = [&](double number) {
      Node made;
      made.number = number;
      return add(std::move(made), tree_.nodes.size(), first);
    };
    node = two([](double a, double b) { return a * b; }, node, constant(factor), into, begin, first);
    node = two([](double a, double b) { return a + b; }, node, constant(offset), into, begin, first);
    tree_.nodes[node].last = last;
  }

  static constexpr auto none = static_cast<std::size_t>(-1);
  std::string_view text_;
  const ExpressionTokens& tokens_;
  const ExpressionNames& names_;
  ExpressionTree tree_;
  std::size_t at_ = 0;             // token
  std::vector<std::size_t> open_;  // tokens ( that are not closed yet
  std::size_t statistic_ = none;   // the one whose arguments are read
  std::size_t statistic_at_ = 0;   // its token
  std::optional<ExpressionFault> syntax_;
  std::vector<ExpressionFault> of_names_;
  std::vector<ExpressionFault> of_values_;
};

}  // namespace

ExpressionTree build_tree(std::string_view text, const ExpressionTokens& tokens, const ExpressionNames& names,
                          std::vector<ExpressionFault>& faults) {
  return TreeBuilder(text, tokens, names).run(faults);
}

std::string node_text(std::string_view text, const ExpressionTokens& tokens, const Node& node) {
  const auto start = tokens[node.first].offset;
  return std::string(text.substr(start, tokens[node.last - 1].end - start));
}

}  // namespace drycut::sim::scenario
