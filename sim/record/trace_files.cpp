#include "sim/record/trace_files.hpp"

#include <fcntl.h>
#include <fmt/compile.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <exception>
#include <stdexcept>

#include "base/text.hpp"

namespace drycut::sim::record {

namespace {

constexpr std::size_t enough = 1U << 16U;  // [bytes] held back at most

[[noreturn]] void fail(const std::filesystem::path& file, int error) {
  throw std::runtime_error(fmt::format("cannot write {}: {}", file.string(), std::strerror(error)));
}

/// As fmt writes it; what is whole is written as an integer, which is quicker.
char* put_number(char* to, double number) {
  constexpr double most = 1e15;  // below it none has an exponent
  if (std::abs(number) < most) {
    const auto whole = static_cast<std::int64_t>(number);
    if (std::bit_cast<std::uint64_t>(static_cast<double>(whole)) == std::bit_cast<std::uint64_t>(number))
      return fmt::format_to(to, FMT_COMPILE("{}"), whole);
  }
  return fmt::format_to(to, FMT_COMPILE("{}"), number);
}

}  // namespace

GrowingFile::GrowingFile(std::filesystem::path file, bool goes_on)
    : file_(std::move(file)),
      descriptor_(open(file_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | (goes_on ? 0 : O_TRUNC), 0666)) {
  if (descriptor_ < 0) fail(file_, errno);
  if (goes_on) end_ = static_cast<std::uint64_t>(std::max<off_t>(0, lseek(descriptor_, 0, SEEK_END)));
}

GrowingFile::~GrowingFile() {
  try {
    flush();
  } catch (const std::exception&) {  // flush() before has told it
  }
  close(descriptor_);
}

void GrowingFile::write(std::string_view lines) {
  lines_ += lines;
  end_ += lines.size();
  if (lines_.size() >= enough) flush();
}

void GrowingFile::flush() {
  // On a full disk nothing more is tried, and what is there ends with a line.
  const auto lines = std::exchange(lines_, {});
  std::size_t done = 0;
  while (done < lines.size()) {
    const auto written = ::write(descriptor_, lines.data() + done, lines.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written > 0) {
      done += static_cast<std::size_t>(written);
      continue;
    }
    const int error = errno;
    const auto whole = lines.rfind('\n', done == 0 ? 0 : done - 1);
    const auto kept = done == 0 || whole == std::string::npos ? 0 : whole + 1;
    const auto end = lseek(descriptor_, 0, SEEK_CUR) - static_cast<off_t>(done - kept);
    if (ftruncate(descriptor_, end) == 0) lseek(descriptor_, end, SEEK_SET);
    fail(file_, error);
  }
}

TraceFiles::TraceFiles(const Recording& recording, const std::filesystem::path& trace,
                       const std::filesystem::path& events, bool goes_on)
    : recording_(recording),
      trace_(trace, goes_on),
      events_(events, goes_on),
      cells_(recording.columns().size()),
      row_((cells_.size() + 2) * longest, ' ') {
  if (goes_on) return;
  std::string heads = "time [s]";
  for (const auto& column : recording.columns())
    heads += ',' + csv_cell(fmt::format("{} [{}]", column.name, column.unit.empty() ? "-" : column.unit));
  trace_.write(heads += '\n');
  events_.write("time [s],source,event,values\n");
}

void TraceFiles::sample(Time time) {
  const auto at = seconds_text(time);
  char* end = std::copy(at.begin(), at.end(), row_.data());
  auto cell = cells_.begin();
  for (const auto& column : recording_.columns()) {
    auto& [bits, size, text] = *cell++;
    // Many values of a row are those of the row before.
    if (const auto now = std::bit_cast<std::uint64_t>(*column.slot); now != bits || size == 0) {
      bits = now;
      text[0] = ',';
      size = static_cast<std::size_t>(put_number(text.data() + 1, *column.slot) - text.data());
    }
    std::memcpy(end, text.data(), longest);  // all of it: as much as a processor copies at once
    end += size;
  }
  *end++ = '\n';
  trace_.write({row_.data(), static_cast<std::size_t>(end - row_.data())});
  flush_at(time);
}

void TraceFiles::happened(const RecordedEvent& event) {
  events_.write(fmt::format("{:.9f},{},{},{}\n", event.at_seconds(), csv_cell(event.source),
                            csv_cell(event.event), csv_cell(values_text(event))));
  flush_at(event.time);
}

void TraceFiles::flush_at(Time time) {
  if (time < next_flush_) return;
  finish();
  next_flush_ = time + second;
}

void TraceFiles::finish() {
  trace_.flush();
  events_.flush();
}

}  // namespace drycut::sim::record
