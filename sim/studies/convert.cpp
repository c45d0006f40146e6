#include "sim/studies/convert.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "base/json.hpp"
#include "base/text.hpp"
#include "sim/record/hdf5_file.hpp"
#include "sim/record/json.hpp"
#include "sim/record/mcap_file.hpp"
#include "sim/record/trace_files.hpp"

namespace drycut::sim::studies {

namespace fs = std::filesystem;

namespace {

/// Channels that are told again, a row after the other.
struct Channels {
  explicit Channels(const record::Recording& of) : numbers(of.columns().size()) {
    for (std::size_t i = 0; i < numbers.size(); ++i)
      recording.add(of.columns()[i].name, of.columns()[i].unit).slot = &numbers[i];
  }
  record::Recording recording;
  std::vector<double> numbers;
};

/// Rows and events in the order of their times.
void tell(const record::Recording& recording, std::vector<double>& numbers, record::Observer& to) {
  std::size_t event = 0;
  const auto& events = recording.events();
  for (std::size_t row = 0; row < recording.times().size(); ++row) {
    const Time now = recording.times()[row];
    for (; event < events.size() && events[event].time <= now; ++event) to.happened(events[event]);
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = recording.columns()[i].values[row];
    to.sample(now);
  }
  for (; event < events.size(); ++event) to.happened(events[event]);
  to.finish();
}

/// A file under another name until it is whole.
class Part {
 public:
  explicit Part(fs::path file) : file_(std::move(file)), part_(file_.string() + ".part") {}
  ~Part() {
    std::error_code ignored;
    fs::remove(part_, ignored);
  }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;
  [[nodiscard]] const fs::path& path() const { return part_; }
  void finish() const {
    std::error_code error;
    fs::rename(part_, file_, error);
    if (error) throw std::runtime_error(fmt::format("cannot write {}: {}", file_.string(), error.message()));
  }

 private:
  fs::path file_;
  fs::path part_;
};

}  // namespace

void write_record(const record::Record& record, RecordFormat format, const fs::path& file) {
  const auto& recording = record.recording;
  Channels channels(recording);
  const Part part(file);
  const auto told = [&](auto&& to) { tell(recording, channels.numbers, to); };
  switch (format) {
    case RecordFormat::csv: {
      const Part events(record::events_beside(file));
      told(record::TraceFiles(channels.recording, part.path(), events.path()));
      events.finish();
      break;
    }
    case RecordFormat::hdf5:
      told(*record::hdf5_writer(channels.recording, part.path(), record.about));
      if (!record.outcome.checks.empty()) record::add_outcome(part.path(), record.outcome);
      break;
    case RecordFormat::mcap: {
      auto about = record.about;
      if (!record.outcome.checks.empty())
        about.emplace_back("outcome", json_text(record::json_of(record.outcome)));
      told(record::McapFile(channels.recording, part.path(), about));
      break;
    }
  }
  part.finish();
}

void check_names(const record::Record& record, const fs::path& run, Problems& problems) {
  for (const auto& column : record.recording.columns())
    if (column.name == "." || column.name.find('/') != std::string::npos)
      problems.push_back({"record.channel-name"_code, run.string(), 1, 1,
                          fmt::format("HDF5 can have no channel {}", in_quotes(column.name)),
                          "rename it, or convert to csv or mcap"});
}

}  // namespace drycut::sim::studies
