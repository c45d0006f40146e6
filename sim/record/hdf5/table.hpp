#pragma once
#include <hdf5.h>

#include <cstddef>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/record/json.hpp"

// What writer and reader of HDF5 have in common. Of its library only C's interface is used.
namespace drycut::sim::record::hdf5 {

/// Debian's library serves one thread at a time: whoever calls it has one of these.
class Hdf5Turn {
 public:
  Hdf5Turn();
  ~Hdf5Turn();
  Hdf5Turn(const Hdf5Turn&) = delete;
  Hdf5Turn& operator=(const Hdf5Turn&) = delete;
};

/// Something of the library that is given back.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  ~Handle() { release(); }
  Handle(Handle&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = H5I_INVALID_HID; }
  Handle& operator=(Handle&& other) noexcept;
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): it is one
  [[nodiscard]] bool good() const { return id_ >= 0; }
  void release();

 private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

/// A column of a table: a number (double), or a text of so many bytes at most, filled up with zeros.
struct RowField {
  const char* name;
  std::size_t text_size = 0;  ///< 0 = a number
  [[nodiscard]] std::size_t size() const { return text_size == 0 ? sizeof(double) : text_size; }
};
using Fields = std::span<const RowField>;

inline constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// A text of so many bytes, UTF-8.
Handle text_type(std::size_t size);
/// A row of these.
Handle row_type(Fields fields);
std::size_t row_size(Fields fields);

/// Rows as they lie in a file.
class Hdf5Rows {
 public:
  explicit Hdf5Rows(Fields fields) : fields_(fields), size_(row_size(fields)) {}
  /// One more, all zeros.
  void add();
  void set(std::size_t field, double number);
  /// As much of the text as there is room for, whole characters; returns the rest.
  std::string_view set(std::size_t field, std::string_view text);
  [[nodiscard]] double number(std::size_t row, std::size_t field) const;
  [[nodiscard]] std::string text(std::size_t row, std::size_t field) const;

  [[nodiscard]] Fields fields() const { return fields_; }
  [[nodiscard]] std::size_t count() const { return bytes_.size() / size_; }
  [[nodiscard]] std::vector<char>& bytes() { return bytes_; }
  [[nodiscard]] const std::vector<char>& bytes() const { return bytes_; }

 private:
  [[nodiscard]] std::size_t place(std::size_t row, std::size_t field) const;

  Fields fields_;
  std::size_t size_;
  std::vector<char> bytes_;
};

// The layout (docs/records.md): channels/NAME and time, a number a row, with the attribute `unit`; events,
// checks, tables; what is known of the run, attributes of the file.
inline constexpr auto* time_name = "time";
inline constexpr auto* channels_name = "channels";
inline constexpr auto* events_name = "events";
inline constexpr auto* unit_name = "unit";
inline constexpr auto* writer_name = "written_by";  ///< of the file: `writer`
inline constexpr auto* writer = "drycut";

/// Of an event a row a value, one at least. Where a text is longer than its field, it goes on in the row
/// below, which has no time.
namespace events {
enum : std::size_t { time, id, source, event, name, value, unit, text };
inline constexpr RowField fields[] = {{"time"},     {"id"},    {"source", 32}, {"event", 24},
                                      {"name", 24}, {"value"}, {"unit", 16},   {"text", 64}};
}  // namespace events

/// What came of a run: a table for each of its lists, and of one row for the rest. Columns are the keys of
/// the row's JSON; lists inside are JSON themselves.
struct OutcomeTable {
  std::string name;  ///< of the list, or outcome_name
  Json row;          ///< with all defaults
  [[nodiscard]] std::vector<RowField> fields() const;
};
inline constexpr auto* outcome_name = "outcome";
std::vector<OutcomeTable> outcome_tables();

}  // namespace drycut::sim::record::hdf5
