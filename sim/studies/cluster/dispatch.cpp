#include "sim/studies/cluster/dispatch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <stdexcept>

#include "base/json.hpp"
#include "sim/interrupt.hpp"
#include "sim/parallel.hpp"
#include "sim/studies/cluster/bundle.hpp"

namespace drycut::sim::cluster {

namespace {

using Items = std::vector<std::size_t>;

constexpr int most_blank_ends = 4;  // chunks in a row that end before their first run: nothing runs there
constexpr std::size_t chunks_a_worker = 3;  // at least, so that all have something to the end
constexpr std::size_t most_in_a_chunk = 100'000;

class Dispatch {
 public:
  Dispatch(const Round& round, Engine& engine, int jobs) : round_(round), engine_(engine), jobs_(jobs) {}

  void run() {
    for (fill(); !out_.empty(); fill()) {
      for (const auto& news : engine_.wait()) {
        const auto chunk = out_.find(news.chunk);
        if (chunk == out_.end()) continue;
        if (!news.line.empty()) hear(chunk->second, news.line);
        if (news.ended) settle(news);
      }
    }
  }

 private:
  struct Sent {
    Items items;
    std::optional<std::size_t> begun = {};  ///< under way
    bool blank = true;                      ///< none has begun yet
  };
  struct Open {
    std::string text;
    int deaths = 0;
  };

  // Chunks.

  /// More to do, when half of what was given is done.
  void fill() {
    const bool probing = engine_.answered == 0;
    const auto room = probing ? static_cast<std::size_t>(std::min(engine_.workers(), 4)) : engine_.room();
    if (out_.size() > room / 2) return;
    std::vector<Chunk> chunks;
    while (out_.size() < room) {
      auto items = next();
      if (items.empty()) break;
      Chunk chunk{engine_.chunks++, ""};
      for (const auto i : items) {
        auto item = Json{{"item", i}};
        item["ask"] = open_.at(i).text;
        chunk.items += json_text(item) + "\n";
      }
      out_.emplace(chunk.number, Sent{std::move(items)});
      chunks.push_back(std::move(chunk));
    }
    if (chunks.empty()) return;
    if (engine_.files.size() != files_) {
      files_ = engine_.files.size();
      bundle_ = bundle_of(round_.kind, round_.question, engine_.files);
      name_ = name_of_bundle(bundle_);
    }
    engine_.submit(name_, bundle_, chunks);
  }

  /// What goes into the next chunk.
  Items next() {
    Items items;
    if (!again_.empty()) {
      items = std::move(again_.front());
      again_.pop_front();
      return items;
    }
    const auto size = chunk_size();
    while (items.size() < size && !rest_.empty()) {
      items.push_back(rest_.front());
      rest_.pop_front();
    }
    while (items.size() < size && read_ < round_.count) read(size - items.size(), items);
    return items;
  }

  [[nodiscard]] std::size_t chunk_size() const {
    if (engine_.answered == 0) return 1;
    const double cost = std::max(1e-6, engine_.run_seconds / static_cast<double>(engine_.answered));
    const auto left = round_.count - read_ + rest_.size();
    const auto share = left / (chunks_a_worker * static_cast<std::size_t>(engine_.workers())) + 1;
    const auto fit = static_cast<std::size_t>(std::max(1.0, engine_.chunk_seconds() / cost));
    return std::min({share, fit, most_in_a_chunk});
  }

  /// Reads the next `count` runs; what is not known yet is added to `items`.
  void read(std::size_t count, Items& items) {
    const auto first = read_;
    count = std::min(count, round_.count - first);
    read_ += count;
    std::vector<std::optional<Ask>> asks(count);
    for_each_index(count, jobs_, [&](std::size_t i) {
      InterruptWatch::check();
      const UseFiles use(engine_.files);
      asks[i] = round_.ask(first + i);
      if (asks[i]) asks[i]->here = nullptr;  // it may hold much
    });
    for (std::size_t i = 0; i < count; ++i) {
      if (!asks[i]) continue;
      open_.emplace(first + i, Open{std::move(asks[i]->text), 0});
      items.push_back(first + i);
    }
  }

  // What becomes of them.

  void hear(Sent& chunk, const std::string& line) {
    const auto said = json_or_null(line);
    if (said.is_null()) return;  // cut short by a kill: what it was to say is missing, and goes again
    if (said.contains("refused")) throw std::runtime_error(said.at("refused").get<std::string>());
    if (!said.contains("item")) return;
    const auto item = said.at("item").get<std::size_t>();
    blank_ends_ = 0;
    chunk.blank = false;
    if (!said.contains("answer")) {
      // The chunk has begun anew: the engine has started it elsewhere.
      if (chunk.begun) died(*chunk.begun, "its machine was lost");
      chunk.begun.reset();
      if (open_.contains(item)) chunk.begun = item;
      return;
    }
    chunk.begun.reset();
    if (open_.erase(item) == 0) return;
    engine_.run_seconds += said.at("seconds").get<double>();
    ++engine_.answered;
    round_.take(item, {said.at("answer").get<std::string>(), ""});
  }

  /// True if it is to be tried again.
  bool died(std::size_t item, const std::string& why) {
    const auto open = open_.find(item);
    if (open == open_.end()) return false;
    if (++open->second.deaths < most_deaths) return true;
    open_.erase(open);
    round_.take(item, {"", fmt::format("whoever ran it died, {} times: {}", most_deaths, why)});
    return false;
  }

  void settle(const WorkNews& news) {
    const auto chunk = std::move(out_.at(news.chunk));
    out_.erase(news.chunk);
    Items left;
    for (const auto item : chunk.items)
      if (open_.contains(item)) left.push_back(item);
    if (left.empty()) return;
    const auto why = news.why.empty() ? std::string("it ended before its end") : news.why;
    auto suspect = chunk.begun;
    if (!suspect && left.size() == 1) suspect = left.front();
    const bool nothing_runs = chunk.blank && (!suspect || engine_.answered == 0);
    if (nothing_runs && ++blank_ends_ >= most_blank_ends)
      throw std::runtime_error(
          fmt::format("{} chunks in a row ended before their first run: {}", blank_ends_, why));
    if (suspect) {
      std::erase(left, *suspect);
      if (died(*suspect, why)) again_.push_back({*suspect});
      rest_.insert(rest_.begin(), left.begin(), left.end());
    } else {
      const auto half = left.begin() + static_cast<std::ptrdiff_t>(left.size() / 2);
      again_.emplace_back(left.begin(), half);
      again_.emplace_back(half, left.end());
    }
  }

  const Round& round_;
  Engine& engine_;
  int jobs_;
  std::size_t read_ = 0;              ///< runs read so far
  std::map<std::size_t, Open> open_;  ///< read, not answered
  std::deque<std::size_t> rest_;      ///< of chunks that were lost, to go in others
  std::deque<Items> again_;           ///< to go as they are
  std::map<int, Sent> out_;           ///< by the chunk's number
  int blank_ends_ = 0;
  std::size_t files_ = static_cast<std::size_t>(-1);
  std::string bundle_;
  std::string name_;
};

}  // namespace

void dispatch(const Round& round, Engine& engine, int jobs) { Dispatch(round, engine, jobs).run(); }

}  // namespace drycut::sim::cluster
