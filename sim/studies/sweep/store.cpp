#include "sim/studies/sweep/store.hpp"

#include <fmt/format.h>

#include <atomic>
#include <charconv>
#include <sstream>

#include "sim/file.hpp"
#include "sim/parallel.hpp"

namespace drycut::sim::studies {

namespace {

constexpr std::size_t key_digits = 16;

}  // namespace

PointStore::PointStore(const std::filesystem::path& file, int jobs) : jobs_(jobs) {
  std::string kept;
  std::ifstream old(file, std::ios::binary);
  for (std::string line; std::getline(old, line) && !old.eof();) {
    std::uint64_t key = 0;
    if (line.size() <= key_digits || line[key_digits] != ',') continue;
    const auto read = std::from_chars(line.data(), line.data() + key_digits, key, 16);
    const auto row = line.substr(key_digits + 1);
    if (read.ec != std::errc() || read.ptr != line.data() + key_digits || !parse_row(row)) continue;
    rows_[key] = row;
    kept += line + "\n";
  }
  old.close();
  write_file(file, kept);
  stream_.exceptions(std::ios::failbit | std::ios::badbit);
  stream_.open(file, std::ios::binary | std::ios::app);
}

std::vector<PointRow> PointStore::rows(const PointQuestion& question,
                                       const std::vector<std::vector<scenario::Override>>& points,
                                       const StudyProgress& progress) {
  std::vector<PointRow> rows(points.size());
  std::atomic<std::size_t> done = 0;
  for_each_index(points.size(), jobs_, [&](std::size_t i) {
    rows[i] = row(question, points[i]);
    progress(++done, points.size());
  });
  return rows;
}

PointRow PointStore::row(const PointQuestion& question, const std::vector<scenario::Override>& overrides) {
  const auto point = read_point(question, overrides);
  {
    const std::lock_guard lock(mutex_);
    const auto known = rows_.find(point.fingerprint);
    if (known != rows_.end()) return parse_row(known->second).value();
  }
  // As it is read back: numbers of as many digits, whoever has run it.
  const auto text = row_text(run_point(question, point));
  const std::lock_guard lock(mutex_);
  if (rows_.emplace(point.fingerprint, text).second) {
    stream_ << fmt::format("{:0{}x},{}\n", point.fingerprint, key_digits, text) << std::flush;
    ++simulated_;
  }
  return parse_row(text).value();
}

}  // namespace drycut::sim::studies
