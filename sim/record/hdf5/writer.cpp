#include "sim/record/hdf5/faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "sim/record/hdf5/deflate.hpp"
#include "sim/record/hdf5/table.hpp"

namespace drycut::sim::record {

namespace {

constexpr std::size_t block_rows = 4096;
constexpr std::size_t stride = block_rows + 9;  // so that columns do not share lines of the cache
constexpr hsize_t event_block = 64;             // rows of the table of events that are written at once

[[noreturn]] void fail(const std::filesystem::path& file) {
  throw std::runtime_error(fmt::format("cannot write {}: {}", file.string(),
                                       errno == 0 ? "HDF5 refuses it" : std::strerror(errno)));
}

/// Without the time of day.
hdf5::Handle creation(hid_t of) {
  hdf5::Handle list(H5Pcreate(of), H5Pclose);
  H5Pset_obj_track_times(list, 0);
  return list;
}

hdf5::Handle access() {
  hdf5::Handle list(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(list, H5F_LIBVER_V110, H5F_LIBVER_V110);  // the first with SWMR, whatever is installed
  H5Pset_file_locking(list, 1, 1);                               // file systems that have no locks do, too
  return list;
}

hdf5::Handle growing(hsize_t begin) {
  const hsize_t most = H5S_UNLIMITED;
  return {H5Screate_simple(1, &begin, &most), H5Sclose};
}

bool put_attribute(hid_t object, const char* name, const std::string& text) {
  const hdf5::Handle type = hdf5::text_type(std::max<std::size_t>(1, text.size()));
  const hdf5::Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const hdf5::Handle made(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return made.good() && H5Awrite(made, type, text.c_str()) >= 0;
}

std::string text_in(const Json& value) {
  return value.is_string() ? value.get<std::string>() : json_text(value);
}

/// A row an item.
bool put_table(hid_t file, const hdf5::OutcomeTable& table, const Json& items) {
  auto fields = table.fields();
  for (auto& field : fields)
    if (field.text_size > 0)
      for (const auto& item : items)
        field.text_size = std::max(field.text_size, text_in(item.value(field.name, Json())).size());
  hdf5::Hdf5Rows rows(fields);
  for (const auto& item : items) {
    rows.add();
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const auto value = item.value(fields[i].name, Json());
      if (fields[i].text_size > 0)
        rows.set(i, text_in(value));
      else
        rows.set(i, value.is_null()      ? hdf5::no_number
                    : value.is_boolean() ? static_cast<double>(value.get<bool>())
                                         : value.get<double>());
    }
  }
  const hsize_t count = rows.count();
  const hdf5::Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  const auto type = hdf5::row_type(fields);
  const hdf5::Handle made(H5Dcreate2(file, table.name.c_str(), type, space, H5P_DEFAULT,
                                     creation(H5P_DATASET_CREATE), H5P_DEFAULT),
                          H5Dclose);
  return made.good() &&
         (count == 0 || H5Dwrite(made, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.bytes().data()) >= 0);
}

hdf5::Handle make_column(hid_t group, const std::string& name, const std::string& unit) {
  const hsize_t rows = block_rows;
  const auto list = creation(H5P_DATASET_CREATE);
  H5Pset_chunk(list, 1, &rows);
  H5Pset_shuffle(list);
  H5Pset_deflate(list, 1);
  hdf5::Handle made(
      H5Dcreate2(group, name.c_str(), H5T_IEEE_F64LE, growing(0), H5P_DEFAULT, list, H5P_DEFAULT), H5Dclose);
  if (made.good() && !put_attribute(made, hdf5::unit_name, unit)) made.release();
  return made;
}

class Hdf5File : public Observer {
 public:
  Hdf5File(const Recording& recording, const std::filesystem::path& file, const About& about);
  ~Hdf5File() override;
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  /// The present values of the recording's channels.
  void sample(Time time) override;
  void happened(const RecordedEvent& event) override;
  /// Everything is in the file, and it is closed.
  void finish() override;

 private:
  struct Open;
  void put_block();
  void put_column(std::size_t number);
  void put_events();
  void require(bool good) const;

  std::filesystem::path file_;
  std::vector<const double*> slots_;
  std::vector<double> block_;   ///< the channels' columns, then the time's
  std::size_t filled_ = 0;      ///< rows in it
  std::size_t written_ = 0;     ///< rows in the file
  std::size_t events_ = 0;      ///< told so far
  std::size_t event_rows_ = 0;  ///< in the file
  Time events_due_ = 0;
  Deflate deflate_;
  std::unique_ptr<Open> open_;  ///< nullptr once finished
};

struct Hdf5File::Open {
  hdf5::Handle file;
  std::vector<hdf5::Handle> columns;  ///< as in the block
  hdf5::Handle event_type;
  hdf5::Handle events;
  hdf5::Hdf5Rows rows{hdf5::events::fields};  ///< that are not written yet
};

void Hdf5File::require(bool good) const {
  if (!good) fail(file_);
}

Hdf5File::Hdf5File(const Recording& recording, const std::filesystem::path& file, const About& about)
    : file_(file) {
  const hdf5::Hdf5Turn turn;
  errno = 0;
  auto made = std::make_unique<Open>();
  auto& open = *made;
  const auto list_of_file = creation(H5P_FILE_CREATE);
  H5Pset_attr_phase_change(list_of_file, 0, 0);  // attributes may be longer than 64 KB
  open.file = {H5Fcreate(file.c_str(), H5F_ACC_TRUNC, list_of_file, access()), H5Fclose};
  require(open.file.good());
  require(put_attribute(open.file, hdf5::writer_name, hdf5::writer));
  for (const auto& [name, text] : about) require(put_attribute(open.file, name.c_str(), text));
  {
    const auto list = creation(H5P_GROUP_CREATE);
    H5Pset_link_creation_order(list, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    const hdf5::Handle group(H5Gcreate2(open.file, hdf5::channels_name, H5P_DEFAULT, list, H5P_DEFAULT),
                             H5Gclose);
    require(group.good());
    for (const auto& column : recording.columns()) {
      slots_.push_back(column.slot);
      open.columns.push_back(make_column(group, column.name, column.unit));
      require(open.columns.back().good());
    }
  }
  open.columns.push_back(make_column(open.file, hdf5::time_name, "s"));
  require(open.columns.back().good());
  open.event_type = hdf5::row_type(hdf5::events::fields);
  const auto list = creation(H5P_DATASET_CREATE);
  H5Pset_chunk(list, 1, &event_block);
  open.events = {
      H5Dcreate2(open.file, hdf5::events_name, open.event_type, growing(0), H5P_DEFAULT, list, H5P_DEFAULT),
      H5Dclose};
  require(open.events.good());
  require(H5Fstart_swmr_write(open.file) >= 0);
  block_.resize(stride * open.columns.size());
  open_ = std::move(made);
}

Hdf5File::~Hdf5File() {
  const hdf5::Hdf5Turn turn;
  open_.reset();
}

void Hdf5File::sample(Time time) {
  auto* at = block_.data() + filled_;
  for (const auto* slot : slots_) {
    *at = *slot;
    at += stride;
  }
  *at = seconds(time);
  if (++filled_ == block_rows) put_block();
}

void Hdf5File::put_column(std::size_t number) {
  auto* const begin = block_.data() + number * stride;
  std::fill(begin + filled_, begin + block_rows, 0.0);
  const auto& bytes = deflate_(begin, block_rows);
  const hdf5::Hdf5Turn turn;
  const hsize_t place = written_;
  const hsize_t rows = written_ + filled_;
  const auto& column = open_->columns[number];
  errno = 0;
  require(H5Dset_extent(column, &rows) >= 0 &&
          H5Dwrite_chunk(column, H5P_DEFAULT, 0, &place, bytes.size(), bytes.data()) >= 0);
}

void Hdf5File::put_block() {
  if (!open_) return;
  put_events();
  if (filled_ == 0) return;
  const auto time = slots_.size();
  for (std::size_t i = 0; i < time; ++i) put_column(i);
  const auto flush = [&](herr_t (*flushed)(hid_t), hid_t what) {
    const hdf5::Hdf5Turn turn;
    errno = 0;
    require(flushed(what) >= 0);
  };
  // The time last: rows that it does not have are none.
  flush([](hid_t file) { return H5Fflush(file, H5F_SCOPE_LOCAL); }, open_->file);
  put_column(time);
  flush(H5Dflush, open_->columns[time]);
  written_ += filled_;
  filled_ = 0;
}

void Hdf5File::happened(const RecordedEvent& event) {
  using namespace hdf5::events;
  if (!open_) return;
  auto& rows = open_->rows;
  const auto id_number = static_cast<double>(events_++);
  for (std::size_t i = 0; i < std::max<std::size_t>(1, event.values.size()); ++i) {
    const auto* given = i < event.values.size() ? &event.values[i] : nullptr;
    std::array<std::string_view, std::size(fields)> rest{};
    rest[source] = event.source;
    rest[hdf5::events::event] = event.event;
    if (given != nullptr) rest[name] = given->name;
    if (given != nullptr) rest[unit] = given->unit;
    if (i == 0) rest[text] = event.text;
    bool goes_on = false;
    do {
      rows.add();
      rows.set(time, goes_on ? hdf5::no_number : event.at_seconds());
      rows.set(id, id_number);
      rows.set(value, goes_on || given == nullptr ? hdf5::no_number : given->number);
      for (const auto field : {source, hdf5::events::event, name, unit, text})
        rest[field] = rows.set(field, rest[field]);
      goes_on = std::any_of(rest.begin(), rest.end(), [](const auto& left) { return !left.empty(); });
    } while (goes_on);
  }
  if (event.time < events_due_ && rows.count() < event_block) return;
  put_events();
  events_due_ = event.time + second;
}

void Hdf5File::put_events() {
  auto& rows = open_->rows;
  if (rows.count() == 0) return;
  const hdf5::Hdf5Turn turn;
  errno = 0;
  const hsize_t begin = event_rows_;
  const hsize_t count = rows.count();
  const hsize_t all = begin + count;
  require(H5Dset_extent(open_->events, &all) >= 0);
  const hdf5::Handle there(H5Dget_space(open_->events), H5Sclose);
  const hdf5::Handle here(H5Screate_simple(1, &count, nullptr), H5Sclose);
  H5Sselect_hyperslab(there, H5S_SELECT_SET, &begin, nullptr, &count, nullptr);
  require(H5Dwrite(open_->events, open_->event_type, here, there, H5P_DEFAULT, rows.bytes().data()) >= 0);
  require(H5Dflush(open_->events) >= 0);
  event_rows_ = all;
  rows.bytes().clear();
}

void Hdf5File::finish() {
  if (!open_) return;
  put_block();
  const hdf5::Hdf5Turn turn;
  errno = 0;
  const bool flushed = H5Fflush(open_->file, H5F_SCOPE_LOCAL) >= 0;
  open_.reset();
  require(flushed);
}

}  // namespace

std::unique_ptr<Observer> write_hdf5(const Recording& recording, const std::filesystem::path& file,
                                     const About& about) {
  return std::make_unique<Hdf5File>(recording, file, about);
}

void add_outcome_to(const std::filesystem::path& file, const Outcome& outcome) {
  const auto json = json_of(outcome);
  const hdf5::Hdf5Turn turn;
  errno = 0;
  const hdf5::Handle opened(H5Fopen(file.c_str(), H5F_ACC_RDWR, access()), H5Fclose);
  if (!opened.good()) fail(file);
  for (const auto& table : hdf5::outcome_tables())
    if (!put_table(opened, table,
                   table.name == hdf5::outcome_name ? Json::array({json}) : json.at(table.name)))
      fail(file);
  if (H5Fflush(opened, H5F_SCOPE_LOCAL) < 0) fail(file);
}

}  // namespace drycut::sim::record
