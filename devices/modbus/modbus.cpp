#include "devices/modbus/modbus.hpp"

#include <fmt/format.h>

#include "base/state_archive.hpp"

namespace drycut::devices::modbus {

namespace {

constexpr int no_answer_ms = 1000;
constexpr int word_bits = 16;

/// The device MODBUS of the QMOVE: two tables that the program and whoever is on the wire share. What comes
/// over the wire is written by name, like anything from outside.
class ModbusDevice final : public TableDevice<modbus_type> {
 public:
  explicit ModbusDevice(int period_ms) : period_ms_(period_ms) { command(CommandRow("INIT")); }

  [[nodiscard]] int period_ms() const override { return period_ms_; }
  void power_up() override {
    Device::power_up();
    waited_ms_ = 0;
    command(CommandRow("INIT"));
  }
  void visit(StateArchive& archive) override {
    Device::visit(archive);
    STATE(archive, waited_ms_);
  }

 protected:
  void latch() override {}
  void initialise() override {}
  void execute(int given) override {
    set_state("wcmd", false);
    const bool sends = given == CommandRow("SEND") || given == CommandRow("SENDSYC");
    if (!sends) return;
    waited_ms_ = 0;
    set_state("err", false);
  }
  bool may_execute(int given) override {
    if (given != CommandRow("SEND") && given != CommandRow("SENDSYC")) return true;
    constexpr int most = 128;
    return value("mode") == 0 && value("num") > 0 && value("num") <= most;
  }
  void refused(int) override { set_state("wcmd", true); }
  void step() override {
    if (state("st_sended")) return;
    waited_ms_ += period_ms_;
    if (waited_ms_ < no_answer_ms) return;
    set_state("st_sended", true);
    set_state("err", true);
  }
  void written(Symbol symbol, std::int32_t new_value) override {
    Device::written(symbol, new_value);
    const auto& variable = type().variables[static_cast<std::size_t>(symbol.index)];
    set_state("wdata", new_value < variable.min || new_value > variable.max);
    if (symbol.index == VariableRow("iword")) join("ilong", "iword", symbol.row / 2);
    if (symbol.index == VariableRow("oword")) join("olong", "oword", symbol.row / 2);
    if (symbol.index == VariableRow("ilong")) split("ilong", "iword", symbol.row);
    if (symbol.index == VariableRow("olong")) split("olong", "oword", symbol.row);
    const bool comes_in = symbol.index == VariableRow("iword") || symbol.index == VariableRow("ilong");
    if (comes_in && state("st_opencom") && value("mode") != 0) set_state("st_msgrx", true);
  }

 private:
  void join(VariableRow wide, VariableRow word, int row) {
    const auto high = static_cast<std::uint32_t>(value(word, 2 * row)) << word_bits;
    const auto low = static_cast<std::uint16_t>(value(word, 2 * row + 1));
    value(wide, row) = static_cast<std::int32_t>(high | low);
  }
  void split(VariableRow wide, VariableRow word, int row) {
    const std::int32_t both = value(wide, row);
    value(word, 2 * row) = static_cast<std::int16_t>(both >> word_bits);
    value(word, 2 * row + 1) = static_cast<std::int16_t>(both);
  }

  const int period_ms_;
  int waited_ms_ = 0;
};

}  // namespace

std::unique_ptr<Device> make_modbus(const Resources& resources, Cards&) {
  return std::make_unique<ModbusDevice>(resources.front().number);
}

std::optional<ModbusPlace> ExchangeFace::read(ModbusTable table, std::uint16_t address) const {
  return place(table, address, "oword");
}

std::optional<ModbusPlace> ExchangeFace::written(ModbusTable table, std::uint16_t address) const {
  return place(table, address, "iword");
}

std::optional<ModbusPlace> ExchangeFace::place(ModbusTable of, std::uint16_t address,
                                               std::string_view word) const {
  const int each = has_bits(of) ? word_bits : 1;
  if (address >= table::words * each) return std::nullopt;
  constexpr std::int64_t ns_per_ms = 1'000'000;
  return ModbusPlace{fmt::format("{}.{}{}", name_, word, address / each + 1), ModbusFormat::int16,
                     address % each, device_.period_ms() * ns_per_ms};
}

bool ExchangeFace::answers(std::uint8_t unit) const {
  const auto now = [this](std::string_view symbol) {
    return device_.read(*find_symbol(modbus_type, symbol));
  };
  constexpr std::uint8_t any = 255;
  return powered_ && now("st_opencom") != 0 && now("mode") != 0 &&
         (unit == 0 || unit == any || unit == now("idcard"));
}

}  // namespace drycut::devices::modbus
