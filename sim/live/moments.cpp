#include "sim/live/moments.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <string_view>

#include "sim/loop/state_bytes.hpp"

namespace drycut::sim::live {

namespace fs = std::filesystem;

void Moments::keep(Moment moment) {
  next_ = (moment.time / apart_ + 1) * apart_;
  if (!kept_.empty() && moment.time <= kept_.back().time) return;
  bytes_ += moment.state->size();
  kept_.push_back(std::move(moment));
  thin();
}

// One by one, as there must be room: the line does not stop for it.
void Moments::thin() {
  while (bytes_ > most_ && kept_.size() > 1) {
    const auto between =
        std::ranges::find_if(kept_, [&](const Moment& moment) { return moment.time % apart_ != 0; });
    if (between == kept_.end()) {
      apart_ *= 2;
      next_ = (kept_.back().time / apart_ + 1) * apart_;
      continue;
    }
    bytes_ -= between->state->size();
    kept_.erase(between);
  }
}

const Moment& Moments::before(Time time) const {
  const auto behind = std::ranges::upper_bound(kept_, time, {}, &Moment::time);
  return *std::prev(std::max(behind, std::next(kept_.begin())));
}

const Moment& Moments::with_acts(std::size_t most) const {
  const auto behind = std::ranges::upper_bound(kept_, most, {}, &Moment::acts);
  return *std::prev(std::max(behind, std::next(kept_.begin())));
}

void Moments::cut(Time time) {
  while (kept_.size() > 1 && kept_.back().time > time) {
    bytes_ -= kept_.back().state->size();
    kept_.pop_back();
  }
  next_ = (kept_.back().time / apart_ + 1) * apart_;
}

namespace {

constexpr std::string_view mark = "drycut\x1aM";  // a terminal shows no more of it
constexpr std::uint32_t format = 1;

/// Stands before each state in the file.
struct ImageHead {
  char mark[8];
  std::uint32_t format;
  std::uint32_t unused;
  std::int64_t time;
  std::uint64_t acts;
  std::uint64_t session;
  std::uint64_t trace;
  std::uint64_t events;
  std::uint64_t session_sum;  // over so much of it
  std::uint64_t size;         // of the state
};
static_assert(sizeof(ImageHead) == 72 && mark.size() == sizeof ImageHead::mark);

/// Sums over the beginning of a session, each longer than the one before.
class SessionSum {
 public:
  explicit SessionSum(const fs::path& folder) : file_(folder / session_file, std::ios::binary) {}
  /// Nothing if it is not that long.
  std::optional<std::uint64_t> until(std::uint64_t end) {
    if (end < done_) return {};
    std::vector<char> bytes(static_cast<std::size_t>(end - done_));
    if (!file_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) return {};
    done_ = end;
    sum_ = StateArchive::sum_of(std::as_bytes(std::span(bytes)), sum_);
    return sum_;
  }

 private:
  std::ifstream file_;
  std::uint64_t done_ = 0;
  std::uint64_t sum_ = StateArchive::first_sum;
};

}  // namespace

void write_moments(const fs::path& folder, const Moments& moments) {
  const auto place = folder / moments_file;
  std::ofstream file(place, std::ios::binary);
  SessionSum session(folder);
  for (const auto& [time, acts, reach, state] : moments.all()) {
    if (!reach) continue;
    const auto sum = session.until(reach->session);
    if (!sum) break;
    ImageHead head{{},           format,        0,    time,         acts, reach->session,
                   reach->trace, reach->events, *sum, state->size()};
    std::ranges::copy(mark, head.mark);
    file.write(reinterpret_cast<const char*>(&head), sizeof head);
    file.write(reinterpret_cast<const char*>(state->data()), static_cast<std::streamsize>(state->size()));
  }
  file.close();
  std::error_code ignored;
  if (!file) fs::remove(place, ignored);
}

std::vector<Moment> read_moments(const fs::path& folder, Time until) {
  std::vector<Moment> moments;
  std::ifstream file(folder / moments_file, std::ios::binary);
  SessionSum session(folder);
  ImageHead head{};
  while (file.read(reinterpret_cast<char*>(&head), sizeof head) && head.time <= until) {
    if (std::string_view(head.mark, sizeof head.mark) != mark || head.format != format) break;
    if (head.size > Moments::most_bytes || session.until(head.session) != head.session_sum) break;
    auto state = std::make_shared<StateArchive::Bytes>(static_cast<std::size_t>(head.size));
    if (!file.read(reinterpret_cast<char*>(state->data()), static_cast<std::streamsize>(head.size))) break;
    try {
      if (loop::open_state(*state).head.time != head.time) break;
    } catch (const BadState&) {
      break;
    }
    moments.push_back({head.time, static_cast<std::size_t>(head.acts),
                       SessionRecord::Reach{head.session, head.trace, head.events}, std::move(state)});
  }
  if (moments.empty() || moments.front().time > 0) return {};
  return moments;
}

}  // namespace drycut::sim::live
