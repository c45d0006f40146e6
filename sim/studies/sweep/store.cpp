#include "sim/studies/sweep/store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <exception>
#include <functional>
#include <sstream>
#include <thread>

#include "sim/file.hpp"

namespace drycut::sim::studies {

namespace {

constexpr std::size_t key_digits = 16;

}  // namespace

PointStore::PointStore(const std::filesystem::path& file) {
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

void for_each_index(std::size_t count, int jobs, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr trouble;
  const auto run = [&] {
    for (auto i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!trouble) trouble = std::current_exception();
        next = count;
      }
    }
  };
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 1; i < std::min<std::size_t>(static_cast<std::size_t>(jobs), count); ++i)
      threads.emplace_back(run);
    run();
  }
  if (trouble) std::rethrow_exception(trouble);
}

}  // namespace drycut::sim::studies
