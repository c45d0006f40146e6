#include "sim/live/record.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "sim/report/results.hpp"

namespace drycut::sim::live {

namespace fs = std::filesystem;

namespace {

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw std::runtime_error(fmt::format("cannot make {}: {}", folder.string(), error.message()));
}

/// Nothing that is there is touched: each run takes the next number.
fs::path next_in(const fs::path& folder) {
  make_folder(folder);
  for (int number = 1;; ++number) {
    auto next = folder / std::to_string(number);
    std::error_code error;
    if (fs::create_directory(next, error)) return next;
    if (error) throw std::runtime_error(fmt::format("cannot make {}: {}", next.string(), error.message()));
  }
}

}  // namespace

SessionRecord::SessionRecord(const fs::path& folder, const scenario::Scenario& scenario, std::uint64_t fingerprint,
                      const record::Recording& recording) {
  write([&] {
    folder_ = next_in(folder);
    session_.emplace(folder_ / session_file, scenario, fingerprint);
    files_.emplace(recording, folder_ / report::trace_file, folder_ / report::events_file);
  });
}

void SessionRecord::write(const std::function<void()>& what) {
  if (!lost_.empty()) return;
  try {
    what();
  } catch (const std::runtime_error& error) {
    lost_ = error.what();
  }
}

void SessionRecord::sample(Time time) {
  write([&] { files_->sample(time); });
}

void SessionRecord::happened(const record::RecordedEvent& event) {
  write([&] { files_->happened(event); });
}

void SessionRecord::finish() {
  write([&] { files_->finish(); });
}

void SessionRecord::add(const scenario::Stimulus& act) {
  write([&] { session_->add(act); });
}

void SessionRecord::reached(Time now) {
  write([&] { session_->reached(now); });
}

}  // namespace drycut::sim::live
