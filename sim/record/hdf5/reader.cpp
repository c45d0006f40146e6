#include "sim/record/hdf5/faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "base/text.hpp"
#include "sim/record/hdf5/table.hpp"

namespace drycut::sim::record {

namespace {

/// What is wrong with a file, and what would be right.
struct Wrong {
  std::string what;
  std::string remedy = "run the scenario again: drycut run writes the file";
  Code code = "record.damaged"_code;
};

hdf5::Handle open_file(const std::filesystem::path& file) {
  for (const auto how : {H5F_ACC_RDONLY, H5F_ACC_RDONLY | H5F_ACC_SWMR_READ}) {  // the latter: it is written
    const hdf5::Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_file_locking(access, 1, 1);
    hdf5::Handle opened(H5Fopen(file.c_str(), how, access), H5Fclose);
    if (opened.good()) return opened;
  }
  throw Wrong{"HDF5 cannot open it: it is cut short or damaged"};
}

std::size_t size_of(hid_t data, const std::string& name) {
  const hdf5::Handle space(H5Dget_space(data), H5Sclose);
  hsize_t size = 0;
  if (H5Sget_simple_extent_ndims(space) != 1 || H5Sget_simple_extent_dims(space, &size, nullptr) != 1)
    throw Wrong{fmt::format("{} is not one row of values", in_quotes(name))};
  return size;
}

hdf5::Handle open_data(hid_t place, const std::string& name) {
  hdf5::Handle data;
  if (H5Lexists(place, name.c_str(), H5P_DEFAULT) > 0)
    data = {H5Dopen2(place, name.c_str(), H5P_DEFAULT), H5Dclose};
  if (!data.good())
    throw Wrong{fmt::format("there is no {} in it", in_quotes(name)),
                "name a file that drycut wrote: trace.h5"};
  return data;
}

std::optional<std::string> attribute_of(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return {};
  const hdf5::Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  const hdf5::Handle space(H5Aget_space(attribute), H5Sclose);
  if (H5Sget_simple_extent_npoints(space) != 1) return {};
  const hdf5::Handle type(H5Aget_type(attribute), H5Tclose);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0) return {};
  std::string text(H5Tget_size(type), '\0');
  if (H5Aread(attribute, type, text.data()) < 0) return {};
  text.resize(std::min(text.find('\0'), text.size()));
  return text;
}

std::vector<std::string> names_in(hid_t group) {
  std::vector<std::string> names;
  const hdf5::Handle list(H5Gget_create_plist(group), H5Pclose);
  unsigned order = 0;
  H5Pget_link_creation_order(list, &order);
  const auto by = (order & H5P_CRT_ORDER_INDEXED) != 0 ? H5_INDEX_CRT_ORDER : H5_INDEX_NAME;
  const auto take = [](hid_t, const char* name, const H5L_info_t*, void* names) -> herr_t {
    static_cast<std::vector<std::string>*>(names)->emplace_back(name);
    return 0;
  };
  if (H5Literate(group, by, H5_ITER_INC, nullptr, take, &names) < 0)
    throw Wrong{"its channels cannot be read"};
  return names;
}

struct StoredColumn {
  std::string name;
  hdf5::Handle data;
};

StoredColumn open_column(hid_t place, const std::string& name) {
  StoredColumn column{name, open_data(place, name)};
  const hdf5::Handle type(H5Dget_type(column.data), H5Tclose);
  if (H5Tget_class(type) != H5T_FLOAT) throw Wrong{fmt::format("{} are no numbers", in_quotes(name))};
  return column;
}

void read_numbers(const StoredColumn& column, hsize_t begin, hsize_t count, std::vector<double>& numbers) {
  const hdf5::Handle there(H5Dget_space(column.data), H5Sclose);
  const hdf5::Handle here(H5Screate_simple(1, &count, nullptr), H5Sclose);
  numbers.resize(count);
  H5Sselect_hyperslab(there, H5S_SELECT_SET, &begin, nullptr, &count, nullptr);
  if (H5Dread(column.data, H5T_NATIVE_DOUBLE, here, there, H5P_DEFAULT, numbers.data()) < 0)
    throw Wrong{fmt::format("{} cannot be read from row {} on: the file is damaged", in_quotes(column.name),
                            begin + 1)};
}

Time time_of(double number, const char* where, std::size_t row) {
  constexpr double longest = 1e9;  // [s]
  if (number >= 0 && number < longest) return std::llround(number * static_cast<double>(second));
  throw Wrong{fmt::format("{} in row {} of {} is no time of a run", number, row + 1, where)};
}

void read_channels(hid_t file, Recording& recording) {
  if (H5Lexists(file, hdf5::channels_name, H5P_DEFAULT) <= 0)
    throw Wrong{"there are no 'channels' in it", "name a file that drycut wrote: trace.h5"};
  const hdf5::Handle group(H5Gopen2(file, hdf5::channels_name, H5P_DEFAULT), H5Gclose);
  const auto time = open_column(file, hdf5::time_name);
  const auto rows = size_of(time.data, time.name);  // before the others, which may grow
  std::vector<StoredColumn> columns;
  for (const auto& name : names_in(group)) {
    columns.push_back(open_column(group, name));
    const auto size = size_of(columns.back().data, name);
    if (size < rows)
      throw Wrong{fmt::format("{} has {} rows, {} has {}", in_quotes(name), size, hdf5::time_name, rows)};
    recording.add(name, attribute_of(columns.back().data, hdf5::unit_name).value_or(""));
  }
  constexpr std::size_t block = 1U << 14U;
  std::vector<double> times;
  std::vector<std::vector<double>> numbers(columns.size());
  std::vector<double> row(columns.size());
  Time last = -1;
  for (std::size_t begin = 0; begin < rows; begin += block) {
    const auto count = std::min(block, rows - begin);
    read_numbers(time, begin, count, times);
    for (std::size_t i = 0; i < columns.size(); ++i) read_numbers(columns[i], begin, count, numbers[i]);
    for (std::size_t k = 0; k < count; ++k) {
      const auto now = time_of(times[k], hdf5::time_name, begin + k);
      if (now <= last) throw Wrong{fmt::format("the time does not rise in row {}", begin + k + 1)};
      for (std::size_t i = 0; i < columns.size(); ++i) row[i] = numbers[i][k];
      recording.append(last = now, row);
    }
  }
}

/// A table, whatever room its texts take. `fields` has the names and kinds.
hdf5::Hdf5Rows read_table(hid_t data, const std::string& name, std::vector<hdf5::RowField>& fields) {
  const hdf5::Handle type(H5Dget_type(data), H5Tclose);
  for (auto& field : fields) {
    const int number = H5Tget_class(type) == H5T_COMPOUND ? H5Tget_member_index(type, field.name) : -1;
    const auto kind = field.text_size == 0 ? H5T_FLOAT : H5T_STRING;
    if (number < 0 || H5Tget_member_class(type, static_cast<unsigned>(number)) != kind)
      throw Wrong{fmt::format("{} has no column {} of {}", in_quotes(name), in_quotes(field.name),
                              kind == H5T_FLOAT ? "numbers" : "texts")};
    if (kind == H5T_FLOAT) continue;
    const hdf5::Handle member(H5Tget_member_type(type, static_cast<unsigned>(number)), H5Tclose);
    if (H5Tis_variable_str(member) != 0)
      throw Wrong{fmt::format("the texts of {} are not of one length", in_quotes(field.name))};
    field.text_size = H5Tget_size(member);
  }
  hdf5::Hdf5Rows rows(fields);
  const auto count = size_of(data, name);
  rows.bytes().resize(count * hdf5::row_size(fields));
  const hsize_t size = count;
  const hdf5::Handle space(H5Dget_space(data), H5Sclose);
  const hdf5::Handle here(H5Screate_simple(1, &size, nullptr), H5Sclose);
  const hsize_t begin = 0;
  H5Sselect_hyperslab(space, H5S_SELECT_SET, &begin, nullptr, &size, nullptr);
  if (count > 0 && H5Dread(data, hdf5::row_type(fields), here, space, H5P_DEFAULT, rows.bytes().data()) < 0)
    throw Wrong{fmt::format("{} cannot be read: the file is damaged", in_quotes(name))};
  return rows;
}

void read_events(hid_t file, Recording& recording, const SeverityOf& severity_of) {
  using namespace hdf5::events;
  std::vector<hdf5::RowField> kinds(std::begin(fields), std::end(fields));
  const auto data = open_data(file, hdf5::events_name);
  const auto rows = read_table(data, hdf5::events_name, kinds);
  const auto count = rows.count();
  for (std::size_t row = 0; row < count;) {
    RecordedEvent told{time_of(rows.number(row, time), hdf5::events_name, row), 0, "", "", {}, ""};
    told.within = rows.number(row, time) - seconds(told.time);
    const double number = rows.number(row, id);
    bool first = true;
    do {
      RecordedEvent::Value given{"", rows.number(row, value), ""};
      std::string origin;
      std::string kind;
      do {  // the texts that go on below
        origin += rows.text(row, source);
        kind += rows.text(row, event);
        given.name += rows.text(row, name);
        given.unit += rows.text(row, unit);
        told.text += rows.text(row, text);
        ++row;
      } while (row < count && std::isnan(rows.number(row, time)));
      if (first) told.source = origin;
      if (first) told.event = kind;
      if (!given.name.empty()) told.values.push_back(std::move(given));
      first = false;
    } while (row < count && rows.number(row, id) == number);
    if (severity_of) told.severity = severity_of(told.event);
    recording.happened(told);
  }
}

/// The rows of a table, with those of its columns that the file has: an older drycut knew fewer.
Json read_rows(hid_t file, const hdf5::OutcomeTable& table) {
  auto items = Json::array();
  if (H5Lexists(file, table.name.c_str(), H5P_DEFAULT) <= 0) return items;
  const auto data = open_data(file, table.name);
  const hdf5::Handle type(H5Dget_type(data), H5Tclose);
  auto fields = table.fields();
  std::erase_if(fields, [&](const hdf5::RowField& field) {
    return H5Tget_class(type) == H5T_COMPOUND && H5Tget_member_index(type, field.name) < 0;
  });
  const auto rows = read_table(data, table.name, fields);
  for (std::size_t row = 0; row < rows.count(); ++row) {
    auto& item = items.emplace_back(Json::object());
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const auto& form = table.row.at(fields[i].name);
      auto& value = item[fields[i].name];
      if (form.is_string())
        value = rows.text(row, i);
      else if (fields[i].text_size > 0)
        value = json_from(rows.text(row, i));
      else if (form.is_boolean())
        value = rows.number(row, i) != 0;
      else if (!std::isnan(rows.number(row, i)))
        value = rows.number(row, i);
    }
  }
  return items;
}

Outcome read_outcome(hid_t file) {
  Outcome outcome;
  try {
    for (const auto& table : hdf5::outcome_tables()) {
      const auto rows = read_rows(file, table);
      if (table.name != hdf5::outcome_name)
        take_json(Json{{table.name, rows}}, outcome);
      else if (!rows.empty())
        take_json(rows[0], outcome);
    }
  } catch (const Json::exception&) {
    throw Wrong{"what came of the run cannot be read: the file is damaged"};
  }
  return outcome;
}

About read_about(hid_t file) {
  About about;
  for (const auto* name : {"drycut", "step", "set", "scenario"})
    if (auto text = attribute_of(file, name)) about.emplace_back(name, std::move(*text));
  return about;
}

}  // namespace

bool says_drycut(const std::filesystem::path& file) {
  const hdf5::Hdf5Turn turn;
  try {
    return attribute_of(open_file(file), hdf5::writer_name) == hdf5::writer;
  } catch (const Wrong&) {
    return false;
  }
}

Record read_from(const std::filesystem::path& file, Problems& problems, const SeverityOf& severity_of) {
  Record record;
  const hdf5::Hdf5Turn turn;
  try {
    const auto opened = open_file(file);
    read_channels(opened, record.recording);
    read_events(opened, record.recording, severity_of);
    record.outcome = read_outcome(opened);
    record.about = read_about(opened);
  } catch (const Wrong& wrong) {
    problems.push_back({wrong.code, file.string(), 1, 1, wrong.what, wrong.remedy});
  }
  return record;
}

}  // namespace drycut::sim::record
