#include "sim/live/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <vector>

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

/// The first bytes of a file as another one.
void copy_begin(const fs::path& from, const fs::path& to, std::uint64_t size) {
  constexpr std::uint64_t block = 1U << 20U;
  std::ifstream source(from, std::ios::binary);
  std::ofstream copy(to, std::ios::binary);
  std::vector<char> bytes(static_cast<std::size_t>(std::min(size, block)));
  for (; size > 0 && source && copy; size -= std::min(size, block)) {
    const auto part = static_cast<std::streamsize>(std::min(size, block));
    source.read(bytes.data(), part);
    if (source) copy.write(bytes.data(), part);
  }
  copy.close();
  if (!source) throw std::runtime_error(fmt::format("{} is shorter than it was", from.string()));
  if (!copy) throw std::runtime_error(fmt::format("cannot write {}", to.string()));
}

}  // namespace

SessionRecord::SessionRecord(const fs::path& folder, const Past& past, const record::Recording& recording) {
  write([&] {
    if (!past.reach)
      throw std::runtime_error(
          fmt::format("the record {} that it would begin with had ended before", past.folder.string()));
    folder_ = next_in(folder);
    const auto& [session, trace, events] = *past.reach;
    copy_begin(past.folder / session_file, folder_ / session_file, session);
    copy_begin(past.folder / report::trace_file, folder_ / report::trace_file, trace);
    copy_begin(past.folder / report::events_file, folder_ / report::events_file, events);
    if (fs::exists(past.folder / retentive_copy)) {
      std::error_code error;
      fs::copy_file(past.folder / retentive_copy, folder_ / retentive_copy, error);
      if (error)
        throw std::runtime_error(
            fmt::format("cannot write {}: {}", (folder_ / retentive_copy).string(), error.message()));
    }
    session_.emplace(folder_ / session_file);
    files_.emplace(recording, folder_ / report::trace_file, folder_ / report::events_file, true);
  });
}

SessionRecord::SessionRecord(const fs::path& folder, const scenario::Scenario& scenario,
                             std::uint64_t fingerprint, const record::Recording& recording) {
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

std::optional<SessionRecord::Reach> SessionRecord::reach() const {
  if (!lost_.empty()) return {};
  const auto [trace, events] = files_->ends();
  return Reach{session_->end(), trace, events};
}

void SessionRecord::reached(Time now) {
  write([&] { session_->reached(now); });
}

}  // namespace drycut::sim::live
