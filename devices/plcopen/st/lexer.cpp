#include "devices/plcopen/st/lexer.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "devices/plcopen/st/clock_literals.hpp"
#include "devices/plcopen/st/pragmas.hpp"

namespace drycut::devices::plcopen::st {
namespace {

std::string without_underscores(std::string_view text) {
  std::string result(text);
  std::erase(result, '_');
  return result;
}

/// "a--b" is a difference, "a++b" a sum.
constexpr std::array<ForeignSign, 16> foreign_signs{{
    {"==", "'=' compares"},
    {"!=", "'<>' compares"},
    {"!", "NOT inverts"},
    {"&&", "AND combines, AND_THEN where the right side is only looked at when the left one is true"},
    {"||", "OR combines, OR_ELSE where the right side is only looked at when the left one is false"},
    {"++;", "write i := i + 1;"},
    {"--;", "write i := i - 1;"},
    {"+=", "write i := i + 1;"},
    {"-=", "write i := i - 1;"},
    {"*=", "write i := i * 2;"},
    {"/=", "write i := i / 2;"},
    {"<<", "SHL(word, bits) shifts to the left"},
    {">>", "SHR(word, bits) shifts to the right"},
    {"?", "SEL(condition, if FALSE, if TRUE) chooses"},
    {"%", "MOD gives the remainder"},
    {"->", "'^' follows a reference, '.' names a member"},
}};

class StLexer : public Lexer<StToken> {
 public:
  StLexer(std::string_view text, const std::string& file, Problems& problems, int line)
      : Lexer(without_byte_order_mark(text), file, problems, line), pragmas_(file, problems) {}

  std::vector<StToken> run() {
    while (skip_blank(), !at_end()) next();
    pragmas_.finish();
    add(Kind::end, 0);
    return std::move(tokens_);
  }

 private:
  StToken& literal(Basic basic, std::size_t size) {
    StToken& token = add(Kind::number, size);
    token.basic = basic;
    return token;
  }

  void skip_blank() {
    while (!at_end()) {
      const char c = peek();
      if (at_blank())
        advance(1);
      else if (starts("//"))
        advance(length([](char x) { return x != '\n'; }));
      else if (starts("(*"))
        skip_nested("(*", "*)");
      else if (starts("/*"))
        skip_nested("/*", "*/");
      else if (c == '{')
        pragma();
      else if (pragmas_.active())
        return;
      else
        // Texts may hold what looks like a comment or a pragma.
        advance(c == '\'' || c == '"' ? string_length().first : 1);
    }
  }

  void pragma() {
    const Place begin = place();
    const std::size_t from = at_ + 1;
    skip_nested("{", "}");
    if (text_[at_ - 1] == '}') pragmas_.read(text_.substr(from, at_ - from - 1), begin);
  }

  void skip_nested(std::string_view open, std::string_view close) {
    const Place begin = place();
    int depth = 0;
    while (!at_end()) {
      if (starts(open)) {
        ++depth;
        advance(open.size());
      } else if (starts(close)) {
        advance(close.size());
        if (--depth == 0) return;
      } else {
        advance(1);
      }
    }
    complain("st.syntax"_code, begin, fmt::format("'{}' is never closed", open),
             fmt::format("end it with '{}'", close));
    add(Kind::bad, 0);  // what should follow is not missed
  }

  void next() {
    const char c = peek();
    if (is_letter(c))
      word();
    else if (is_digit(c))
      number();
    else if (c == '\'' || c == '"')
      string();
    else if (c == '%' && is_letter(peek(1)))
      add(Kind::address, length([](char x) { return in_name(x) || x == '.' || x == '%'; }));
    else
      sign();
  }

  void sign() {
    // As other languages begin a comment; a typed value has its type before it: INT#5.
    if (peek() == '#' && (at_ == 0 || !in_name(text_[at_ - 1]))) {
      complain("st.syntax"_code, place(), "'#' begins no comment", "comments are (* ... *) or // ...");
      return advance(length([](char x) { return x != '\n'; }));
    }
    if (foreign_sign(foreign_signs, "st.syntax"_code)) return;
    constexpr std::array<std::string_view, 7> pairs{":=", "=>", "**", "<=", ">=", "<>", ".."};
    if (std::any_of(pairs.begin(), pairs.end(), [&](std::string_view pair) { return starts(pair); }))
      add(Kind::sign, 2);
    else if (std::string_view("()[],;:.+-*/<>=&#^").find(peek()) != std::string_view::npos)
      add(Kind::sign, 1);
    else
      stranger("comments are (* ... *) or // ...");
  }

  void word() {
    const std::size_t size = length(in_name);
    const std::string_view name = text_.substr(at_, size);
    Basic basic = peek(size) == '#' ? clock_type(name) : Basic::unknown;
    // A program may have a type of that name of its own: LT#Left.
    const char first = peek(size + 1);
    if (is_clock(basic) && long_clock(basic) == basic && !is_digit(first) && first != '-')
      basic = Basic::unknown;
    if (basic == Basic::unknown)
      add(Kind::name, size);
    else
      clock(basic, size + 1);
  }

  /// TIME, TOD, DATE or DT before a '#', by their short names too.
  static Basic clock_type(std::string_view name) {
    if (same_word(name, "T")) return Basic::time;
    if (same_word(name, "D")) return Basic::date;
    if (same_word(name, "LT")) return Basic::ltime;
    if (same_word(name, "LD")) return Basic::ldate;
    const Type* type = elementary_type(name);
    return type != nullptr && is_clock(type->basic) ? type->basic : Basic::unknown;
  }

  void number() {
    const auto digit = [](char x) { return is_digit(x) || x == '_'; };
    if (const std::size_t base = length(digit); peek(base) == '#') return based(base);
    const Number found = number_ahead(digit, true);
    StToken& token = literal(Basic::lreal, found.whole);
    const std::string digits = without_underscores(token.text);
    if (found.whole != found.size) {
      complain("st.literal"_code, token, in_quotes(token.text) + " is neither a number nor a name",
               milliseconds(digits) ? fmt::format("a TIME is written T#{}", token.text)
                                    : "names begin with a letter; 16#FF is hexadecimal");
    } else if (found.real) {
      double value = 0;
      read(token, digits, value, "an LREAL goes to 1.8e308");
      token.value = cell_of(value);
    } else {
      read_integer(token, digits, 10);
    }
  }

  void based(std::size_t base_size) {
    const std::string base = without_underscores(text_.substr(at_, base_size));
    StToken& token = literal(Basic::lint, length(in_name, base_size + 1));
    if (base != "2" && base != "8" && base != "16")
      complain("st.literal"_code, token, in_quotes(token.text) + " has no base that is known",
               "2#1010, 8#17 or 16#FF");
    else
      read_integer(token, without_underscores(token.text.substr(base_size + 1)), std::stoi(base));
  }

  void read_integer(StToken& token, const std::string& digits, int base) {
    std::uint64_t number = 0;
    const char* const end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, number, base);
    if (digits.empty())
      complain("st.literal"_code, token, in_quotes(token.text) + " has no digits", "16#FF");
    else if (error == std::errc::result_out_of_range)
      complain("st.literal"_code, token, in_quotes(token.text) + " is out of range",
               "a ULINT goes to 18446744073709551615");
    else if (stop != end)
      complain("st.literal"_code, token,
               fmt::format("{} has a digit that base {} does not have", in_quotes(token.text), base),
               "2#1010, 8#17 or 16#FF");
    token.value = static_cast<Cell>(number);
    token.basic = token.value < 0 ? Basic::ulint : Basic::lint;
  }

  // T#1s500ms, D#1996-08-15, TOD#15:36:55.36, DT#1996-08-15-15:36:55.
  void clock(Basic basic, std::size_t prefix) {
    const bool time = is_span(basic);
    // T#5s-e is a difference: only dates have a '-' within them.
    const Basic kind = long_clock(basic);
    int dashes = kind == Basic::ldate ? 2 : kind == Basic::ldt ? 3 : 0;
    const auto belongs = [&](char x) {
      return in_name(x) || x == '.' || (x == '-' && dashes-- > 0) || (x == ':' && !time);
    };
    StToken& token = literal(basic, length(belongs, peek(prefix) == '-' ? prefix + 1 : prefix));
    const std::string text = without_underscores(token.text.substr(prefix));
    if (basic == Basic::ltime)
      read_long_time(token, text);
    else if (time)
      read_time(token, text);
    else if (const auto number = kind == basic ? long_clock_number(basic, text) : clock_number(basic, text))
      token.value = *number;
    else
      complain("st.literal"_code, token, in_quotes(token.text) + " is no " + type_of(basic)->name,
               basic == Basic::tod     ? "TOD#00:00:00 to TOD#23:59:59.999"
               : basic == Basic::date  ? "D#1970-01-01 to D#2106-02-06"
               : basic == Basic::dt    ? "DT#1970-01-01-00:00:00 to DT#2106-02-06-06:28:15"
               : basic == Basic::ltod  ? "LTOD#00:00:00 to LTOD#23:59:59.999999999"
               : basic == Basic::ldate ? "LDATE#1970-01-01 to LDATE#2262-04-11"
                                       : "LDT#1970-01-01-00:00:00 to LDT#2262-04-11-23:47:16.854775807");
  }

  /// T#-5s is of IEC 61131-3; who reads the token knows whether it may be.
  static bool take_minus(std::string_view& text) {
    const bool minus = text.starts_with('-');
    if (minus) text.remove_prefix(1);
    return minus;
  }

  void read_long_time(StToken& token, std::string_view text) {
    const bool minus = take_minus(text);
    bool fits = true;
    const auto ns = nanoseconds(text, fits);
    if (!ns)
      complain("st.literal"_code, token, in_quotes(token.text) + " is no time",
               "parts with d, h, m, s, ms, us or ns, the largest first: LTIME#1s500us");
    else if (!fits)
      complain("st.literal"_code, token, in_quotes(token.text) + " is out of range, or finer than an LTIME",
               "an LTIME counts nanoseconds, to LTIME#106751d23h47m16s854ms775us807ns");
    else
      token.value = minus ? -*ns : *ns;
  }

  void read_time(StToken& token, std::string_view text) {
    const bool minus = take_minus(text);
    const std::optional<double> ms = milliseconds(text);
    if (!ms)
      complain("st.literal"_code, token, in_quotes(token.text) + " is no time",
               "parts with d, h, m, s or ms, the largest first: T#1s500ms");
    else if (*ms > std::numeric_limits<std::uint32_t>::max())
      complain("st.literal"_code, token, in_quotes(token.text) + " is out of range",
               "a TIME goes to T#49d17h2m47s295ms");
    else if (std::abs(*ms - std::round(*ms)) > 1e-6)
      complain("st.literal"_code, token, in_quotes(token.text) + " is finer than a TIME",
               "a TIME counts whole milliseconds");
    else
      token.value = std::llround(minus ? -*ms : *ms);
  }

  /// With its quotes, and whether it has both.
  [[nodiscard]] std::pair<std::size_t, bool> string_length() const {
    std::size_t size = 1;
    const char quote = peek();
    // 'it''s': a quote that is written twice.
    const auto doubled = [&] { return peek(size) == quote && peek(size + 1) == quote; };
    while (at_ + size < text_.size() && (peek(size) != quote || doubled()) && peek(size) != '\n')
      size += doubled() || (peek(size) == '$' && peek(size + 1) != '\n') ? 2 : 1;
    const bool closed = peek(size) == quote;
    return {std::min(size + (closed ? 1 : 0), text_.size() - at_), closed};
  }

  void string() {
    const Place begin = place();
    const auto [whole, closed] = string_length();
    const std::size_t size = whole - 1;
    StToken& token = add(Kind::string, whole);
    if (!closed) {
      complain("st.syntax"_code, token, "a string is not closed on its line",
               fmt::format("end it with {}", token.text.front()));
      return;
    }
    token.wide = token.text.front() == '"';
    unescape(token, token.text.substr(1, size - 1), begin);
  }

  void unescape(StToken& token, std::string_view text, Place begin) {
    constexpr std::string_view names = "$'\"LlNnPpRrTt";
    constexpr std::string_view values = "$'\"\n\n\n\n\f\f\r\r\t\t";
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] != '$') {
        token.string += text[i];
        if (text[i] == token.text.front()) ++i;  // the second one
        continue;
      }
      const char c = i + 1 < text.size() ? text[i + 1] : '\0';
      const auto code = parsed<unsigned char>(text.substr(i + 1, 2), 16);
      const std::size_t known = c == '\0' ? std::string_view::npos : names.find(c);
      if (known != std::string_view::npos) {
        token.string += values[known];
        ++i;
      } else if (code && i + 2 < text.size()) {
        token.string += static_cast<char>(*code);
        i += 2;
      } else {
        const Place at{begin.line, begin.column + 1 + static_cast<int>(i)};
        token.kind = Kind::bad;
        complain("st.syntax"_code, at, "'$' begins no character that is known",
                 "$$, $', $L, $N, $P, $R, $T or $41");
        return;
      }
    }
  }

  Pragmas pragmas_;
};

}  // namespace

std::vector<StToken> tokens_of(std::string_view text, const std::string& file, Problems& problems,
                               int first_line) {
  return StLexer(text, file, problems, first_line).run();
}

}  // namespace drycut::devices::plcopen::st
