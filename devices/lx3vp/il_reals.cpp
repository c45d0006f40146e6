// Instructions on floating-point numbers: what each does, with its row in the table.
#include "devices/lx3vp/il_values.hpp"

namespace drycut::devices::lx3vp::il {

namespace {

using namespace form;

void to_integer(Call& call) {
  const auto real = static_cast<double>(call.registers().f32(call.number(0)));
  const double whole = std::trunc(real);
  auto& m = call.registers().m;
  if (std::isnan(whole)) throw IlError(bad_operand, "S is no floating-point number");
  m[borrow_flag] = whole < static_cast<double>(smallest(call.wide()));
  m[carry_flag] = whole > static_cast<double>(largest(call.wide()));
  if (m[borrow_flag] || m[carry_flag])
    throw IlError(bad_operand, fmt::format("{} does not fit the whole number", real));
  call.set(1, static_cast<std::int32_t>(whole));
  m[zero_flag] = whole == 0;
}

void divide_reals(Call& call) {
  if (call.finite(1) == 0) throw IlError(bad_operand, "division by 0");
  call.set_real(2, call.finite(0) / call.finite(1));
}

constexpr Mnemonic real_rows[] = {
    {"FLT", Op::action, "GF", nwp, 5, 9, "D = S as a floating-point number",
     [](Call& c) { c.registers().set_f32(c.number(1), static_cast<float>(c.value(0))); }},
    {"INT", Op::action, "Qi", nwp, 5, 9, "D = S without its decimals", to_integer},
    {"EMOV", Op::action, "fF", wp, 9, 9, "D = S, floating point",
     [](Call& c) { c.registers().set_f32(c.number(1), c.real(0)); }},
    {"EADD", Op::action, "ffF", wp, 13, 13, "D = S1 + S2, floating point",
     [](Call& c) { c.set_real(2, c.finite(0) + c.finite(1)); }},
    {"ESUB", Op::action, "ffF", wp, 13, 13, "D = S1 - S2, floating point",
     [](Call& c) { c.set_real(2, c.finite(0) - c.finite(1)); }},
    {"EMUL", Op::action, "ffF", wp, 13, 13, "D = S1 * S2, floating point",
     [](Call& c) { c.set_real(2, c.finite(0) * c.finite(1)); }},
    {"EDIV", Op::action, "ffF", wp, 13, 13, "D = S1 / S2, floating point", divide_reals},
    {"ECMP", Op::action, "ffB", wp, 13, 13, "CMP of floating-point numbers",
     [](Call& c) { c.set_order(2, c.finite(0), c.finite(1)); }},
    {"EZCP", Op::action, "fffB", wp, 17, 17, "ZCP of floating-point numbers",
     [](Call& c) { c.set_zone(3, c.finite(2), c.finite(0), c.finite(1)); }},
};

}  // namespace

std::span<const Mnemonic> real_mnemonics() { return real_rows; }

}  // namespace drycut::devices::lx3vp::il
