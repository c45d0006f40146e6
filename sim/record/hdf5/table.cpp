#include "sim/record/hdf5/table.hpp"

#include <algorithm>
#include <cstring>
#include <mutex>
#include <numeric>
#include <utility>

#include "sim/record/outcome.hpp"

namespace drycut::sim::record::hdf5 {

namespace {

/// One item in every list, and every part that may be missing.
struct FillParts {
  template <typename T>
  void operator()(const char*, T&& member) {
    using Member = std::remove_cvref_t<T>;
    if constexpr (is_table<Member>) member.emplace_back();
    if constexpr (is_optional<Member>) member.emplace();
  }
};

std::mutex& library() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

std::vector<RowField> OutcomeTable::fields() const {
  std::vector<RowField> fields;
  for (const auto& [key, value] : row.items()) {
    const bool is_number = value.is_number() || value.is_boolean() || value.is_null();
    fields.push_back({key.c_str(), is_number ? 0U : 1U});
  }
  return fields;
}

std::vector<OutcomeTable> outcome_tables() {
  Outcome outcome;
  FillParts fill;
  Outcome::visit(fill, outcome);
  std::vector<OutcomeTable> tables = {{outcome_name, Json::object()}};
  const auto json = json_of(outcome);
  for (const auto& [key, value] : json.items()) {
    if (value.is_array() && !value.empty())
      tables.push_back({key, value[0]});
    else
      tables[0].row[key] = value;
  }
  return tables;
}

Hdf5Turn::Hdf5Turn() {
  library().lock();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // what fails is told in our words
}

Hdf5Turn::~Hdf5Turn() { library().unlock(); }

Handle& Handle::operator=(Handle&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(close_, other.close_);
  return *this;
}

void Handle::release() {
  if (id_ >= 0) close_(id_);
  id_ = H5I_INVALID_HID;
}

Handle text_type(std::size_t size) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, size);
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

std::size_t row_size(Fields fields) {
  return std::accumulate(fields.begin(), fields.end(), std::size_t{0},
                         [](std::size_t sum, const RowField& field) { return sum + field.size(); });
}

Handle row_type(Fields fields) {
  Handle type(H5Tcreate(H5T_COMPOUND, row_size(fields)), H5Tclose);
  std::size_t at = 0;
  for (const auto& field : fields) {
    if (field.text_size == 0)
      H5Tinsert(type, field.name, at, H5T_IEEE_F64LE);
    else
      H5Tinsert(type, field.name, at, text_type(field.text_size));
    at += field.size();
  }
  return type;
}

void Hdf5Rows::add() { bytes_.resize(bytes_.size() + size_); }

std::size_t Hdf5Rows::place(std::size_t row, std::size_t field) const {
  return row * size_ + row_size(fields_.first(field));
}

void Hdf5Rows::set(std::size_t field, double number) {
  std::memcpy(bytes_.data() + place(count() - 1, field), &number, sizeof(number));
}

std::string_view Hdf5Rows::set(std::size_t field, std::string_view text) {
  auto taken = std::min(text.size(), fields_[field].text_size);
  const auto goes_on = [&](std::size_t at) {
    return (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U;
  };
  while (taken < text.size() && taken > 1 && goes_on(taken)) --taken;
  std::copy_n(text.begin(), taken, bytes_.begin() + static_cast<std::ptrdiff_t>(place(count() - 1, field)));
  return text.substr(taken);
}

double Hdf5Rows::number(std::size_t row, std::size_t field) const {
  double number = 0;
  std::memcpy(&number, bytes_.data() + place(row, field), sizeof(number));
  return number;
}

std::string Hdf5Rows::text(std::size_t row, std::size_t field) const {
  const std::string_view all(bytes_.data() + place(row, field), fields_[field].text_size);
  return std::string(all.substr(0, all.find('\0')));
}

}  // namespace drycut::sim::record::hdf5
