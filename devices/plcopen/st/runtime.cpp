#include "devices/plcopen/st/runtime.hpp"

#include <algorithm>
#include <cmath>

#include "devices/plcopen/st/machine.hpp"

namespace drycut::devices::plcopen::st {

struct Runtime::State {
  State(Program of, MotionKernel& kernel) : program(std::move(of)), machine(program.compiled(), kernel) {}
  Program program;
  Machine machine;
  std::optional<Fault> fault;
};

Runtime::Runtime(Program program, MotionKernel& kernel)
    : state_(std::make_unique<State>(std::move(program), kernel)) {
  cold_start(true);
}
Runtime::~Runtime() = default;

void Runtime::cold_start(bool all) {
  state_->fault.reset();
  state_->machine.start(all);
}

void Runtime::scan(std::int64_t time_ns) {
  if (state_->fault) return;
  constexpr std::int64_t ns_per_ms = 1'000'000;
  try {
    state_->machine.run(time_ns / ns_per_ms);
  } catch (const RuntimeError& error) {
    state_->fault = Fault{error.line, error.column, error.what()};
  }
}

std::span<const Symbol> Runtime::symbols() const { return state_->program.compiled().symbols; }

double Runtime::read(std::size_t symbol) const {
  const SymbolPlace& place = state_->program.compiled().places.at(symbol);
  const Cell cell = state_->machine.cell(place.cell);
  if (is_real(place.basic)) return real_of(cell);
  return place.basic == Basic::time ? static_cast<double>(cell) / 1000 : static_cast<double>(cell);
}

void Runtime::write(std::size_t number, double value) {
  const Compiled& code = state_->program.compiled();
  const SymbolPlace& place = code.places.at(number);
  const Symbol& symbol = code.symbols[number];
  if (!symbol.writable || std::isnan(value)) return;
  value = std::clamp(value, symbol.min, symbol.max);
  if (is_real(place.basic)) {
    state_->machine.set_cell(place.cell, cell_of(rounded(place.basic, value)));
    return;
  }
  // The largest LINT is no double: the one above it is meant for it.
  const double whole = std::nearbyint(place.basic == Basic::time ? value * 1000 : value);
  const Range range = range_of(place.basic);
  state_->machine.set_cell(place.cell,
                           whole >= 9223372036854775807.0 ? range.high : static_cast<Cell>(whole));
}

bool Runtime::located(std::size_t i) const {
  return state_->machine.cell(state_->program.compiled().located_cells.at(i)) != 0;
}
void Runtime::set_located(std::size_t i, bool level) {
  state_->machine.set_cell(state_->program.compiled().located_cells.at(i), level ? 1 : 0);
}
const std::optional<Fault>& Runtime::fault() const { return state_->fault; }

}  // namespace drycut::devices::plcopen::st
