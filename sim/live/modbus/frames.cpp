#include "sim/live/modbus/frames.hpp"

#include <algorithm>

namespace drycut::sim::live::modbus {

namespace {

using devices::ModbusTable;
using Request = std::span<const std::uint8_t>;

constexpr std::size_t heading = 7;        ///< of a frame: transaction, protocol, length, unit
constexpr std::size_t longest_pdu = 253;  // §4.1
constexpr std::uint8_t of_exceptions = 0x80;
constexpr std::uint16_t whole_word = 0xFFFF;
// Most of a request, §6.
constexpr std::uint16_t most_read_bits = 2000;
constexpr std::uint16_t most_read_words = 125;
constexpr std::uint16_t most_written_bits = 1968;
constexpr std::uint16_t most_written_words = 123;
constexpr std::uint16_t most_exchanged_words = 121;

std::uint16_t word_at(Request bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] << 8 | bytes[at + 1]);
}

void add_word(Bytes& bytes, std::uint16_t word) {
  bytes.push_back(static_cast<std::uint8_t>(word >> 8));
  bytes.push_back(static_cast<std::uint8_t>(word));
}

std::vector<std::uint16_t> words_of(Request bytes) {
  std::vector<std::uint16_t> words;
  words.reserve(bytes.size() / 2);
  for (std::size_t at = 0; at + 1 < bytes.size(); at += 2) words.push_back(word_at(bytes, at));
  return words;
}

/// Either an answer or why there is none.
struct Reply {
  Exception exception = Exception::none;
  Bytes pdu = {};
};

bool fits(std::uint16_t address, std::uint16_t count) { return address + count <= 0x10000; }

Reply read(Request request, ModbusTable table, std::uint16_t most, Data& data) {
  constexpr std::size_t length = 5;
  if (request.size() != length) return {Exception::illegal_data_value};
  const auto address = word_at(request, 1);
  const auto count = word_at(request, 3);
  if (count == 0 || count > most) return {Exception::illegal_data_value};
  if (!fits(address, count)) return {Exception::illegal_data_address};
  std::vector<std::uint16_t> values(count);
  if (const auto wrong = data.read(table, address, values); wrong != Exception::none) return {wrong};
  Reply reply{Exception::none, {request[0]}};
  if (devices::has_bits(table)) {
    Bytes bits((count + 7U) / 8);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] != 0) bits[i / 8] |= static_cast<std::uint8_t>(1U << i % 8);
    reply.pdu.push_back(static_cast<std::uint8_t>(bits.size()));
    reply.pdu.insert(reply.pdu.end(), bits.begin(), bits.end());
  } else {
    reply.pdu.push_back(static_cast<std::uint8_t>(2 * values.size()));
    for (const auto value : values) add_word(reply.pdu, value);
  }
  return reply;
}

/// The answer repeats so much of the request.
Reply written(Exception wrong, Request request, std::size_t repeated) {
  if (wrong != Exception::none) return {wrong};
  const auto kept = request.first(repeated);
  return {Exception::none, Bytes(kept.begin(), kept.end())};
}

Reply write_coil(Request request, Data& data) {
  constexpr std::size_t length = 5;
  constexpr std::uint16_t on = 0xFF00;
  if (request.size() != length) return {Exception::illegal_data_value};
  const auto value = word_at(request, 3);
  if (value != 0 && value != on) return {Exception::illegal_data_value};
  const std::uint16_t bit = value == on ? 1 : 0;
  return written(data.write(ModbusTable::coils, word_at(request, 1), {&bit, 1}, whole_word), request, length);
}

Reply write_register(Request request, Data& data) {
  constexpr std::size_t length = 5;
  if (request.size() != length) return {Exception::illegal_data_value};
  const auto value = word_at(request, 3);
  return written(data.write(ModbusTable::holding_registers, word_at(request, 1), {&value, 1}, whole_word),
                 request, length);
}

Reply mask_register(Request request, Data& data) {
  constexpr std::size_t length = 7;
  if (request.size() != length) return {Exception::illegal_data_value};
  const auto kept = word_at(request, 3);
  const auto value = word_at(request, 5);
  return written(data.write(ModbusTable::holding_registers, word_at(request, 1), {&value, 1},
                            static_cast<std::uint16_t>(~kept)),
                 request, length);
}

Reply write_several(Request request, ModbusTable table, Data& data) {
  constexpr std::size_t before_values = 6;
  if (request.size() < before_values) return {Exception::illegal_data_value};
  const bool bits = devices::has_bits(table);
  const auto address = word_at(request, 1);
  const auto count = word_at(request, 3);
  const auto most = bits ? most_written_bits : most_written_words;
  const std::size_t bytes = bits ? (count + 7U) / 8 : 2U * count;
  if (count == 0 || count > most || request[5] != bytes || request.size() != before_values + bytes)
    return {Exception::illegal_data_value};
  if (!fits(address, count)) return {Exception::illegal_data_address};
  const auto given = request.subspan(before_values);
  std::vector<std::uint16_t> values;
  if (bits) {
    values.reserve(count);
    for (std::size_t i = 0; i < count; ++i) values.push_back(given[i / 8] >> i % 8 & 1);
  } else {
    values = words_of(given);
  }
  constexpr std::size_t repeated = 5;
  return written(data.write(table, address, values, whole_word), request, repeated);
}

// Writes first, then reads (§6.17).
Reply exchange(Request request, Data& data) {
  constexpr std::size_t before_values = 10;
  if (request.size() < before_values) return {Exception::illegal_data_value};
  const auto read_count = word_at(request, 3);
  const auto address = word_at(request, 5);
  const auto count = word_at(request, 7);
  if (read_count == 0 || read_count > most_read_words || count == 0 || count > most_exchanged_words ||
      request[9] != 2 * count || request.size() != before_values + 2U * count)
    return {Exception::illegal_data_value};
  if (!fits(word_at(request, 1), read_count) || !fits(address, count))
    return {Exception::illegal_data_address};
  // What cannot be read is not written either.
  constexpr std::size_t reading = 5;
  const auto first = request.first(reading);
  auto reply = read(first, ModbusTable::holding_registers, most_read_words, data);
  if (reply.exception != Exception::none) return reply;
  const auto wrong = data.write(ModbusTable::holding_registers, address,
                                words_of(request.subspan(before_values)), whole_word);
  if (wrong != Exception::none) return {wrong};
  return read(first, ModbusTable::holding_registers, most_read_words, data);
}

Reply reply_to(Request request, Data& data) {
  switch (request[0]) {
    case 1:
      return read(request, ModbusTable::coils, most_read_bits, data);
    case 2:
      return read(request, ModbusTable::discrete_inputs, most_read_bits, data);
    case 3:
      return read(request, ModbusTable::holding_registers, most_read_words, data);
    case 4:
      return read(request, ModbusTable::input_registers, most_read_words, data);
    case 5:
      return write_coil(request, data);
    case 6:
      return write_register(request, data);
    case 15:
      return write_several(request, ModbusTable::coils, data);
    case 16:
      return write_several(request, ModbusTable::holding_registers, data);
    case 22:
      return mask_register(request, data);
    case 23:
      return exchange(request, data);
    default:
      return {Exception::illegal_function};
  }
}

}  // namespace

Bytes answer(Request request, Data& data) {
  if (request.empty()) return refusal(request, Exception::illegal_function);
  auto reply = reply_to(request, data);
  return reply.exception == Exception::none ? std::move(reply.pdu) : refusal(request, reply.exception);
}

Bytes refusal(Request request, Exception exception) {
  const unsigned function = request.empty() ? 0 : request[0];
  return {static_cast<std::uint8_t>(function | of_exceptions), static_cast<std::uint8_t>(exception)};
}

std::size_t cost_of(Request request) {
  constexpr std::size_t counted = 5;
  constexpr std::size_t a_write = 8;  // each is an act, an event and a line of the record
  if (request.size() < counted) return 1;
  switch (request[0]) {
    case 1:
    case 2:
    case 3:
    case 4:
      return std::min(word_at(request, 3), most_read_bits);
    case 15:
    case 16:
      return a_write * std::min(word_at(request, 3), most_read_bits);
    case 23:
      return most_read_words + a_write * most_exchanged_words;
    default:
      return a_write;
  }
}

Bytes bytes_of(const ModbusFrame& frame) {
  Bytes bytes;
  bytes.reserve(heading + frame.pdu.size());
  add_word(bytes, frame.transaction);
  add_word(bytes, 0);
  add_word(bytes, static_cast<std::uint16_t>(1 + frame.pdu.size()));
  bytes.push_back(frame.unit);
  bytes.insert(bytes.end(), frame.pdu.begin(), frame.pdu.end());
  return bytes;
}

void FrameReader::take(std::span<const std::uint8_t> bytes) {
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

std::optional<ModbusFrame> FrameReader::next() {
  constexpr std::size_t with_length = 6;
  if (broken_ || bytes_.size() < with_length) return {};
  const std::size_t length = word_at(bytes_, 4);
  broken_ = word_at(bytes_, 2) != 0 || length < 2 || length > 1 + longest_pdu;
  if (broken_ || bytes_.size() < with_length + length) return {};
  const auto end = bytes_.begin() + static_cast<std::ptrdiff_t>(with_length + length);
  ModbusFrame frame{word_at(bytes_, 0), bytes_[6], Bytes(bytes_.begin() + heading, end)};
  bytes_.erase(bytes_.begin(), end);
  return frame;
}

}  // namespace drycut::sim::live::modbus
