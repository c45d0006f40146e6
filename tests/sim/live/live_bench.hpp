#pragma once
#include <gmock/gmock.h>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "sim/live/line.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim::live {

/// A web whose speed an operator sets, and a check of it.
inline const std::string web_alone = R"(scene: {title: A web, step: 1 ms, duration: 2 s}
plants: {web: {type: web, speed: 60 m/min}}
record: {every: 10 ms, channels: [web.speed, web.position]}
timeline: [{at: 0.1 s, set: {web.speed: 30 m/min}}]
checks: [{name: slow enough, always: web.speed <= 62}]
)";

/// A line in a thread of its own, and all that it told.
class RunningLine {
 public:
  explicit RunningLine(Line::Options options) {
    Problems problems;
    line = std::make_unique<Line>(std::move(options), problems);
    EXPECT_EQ(lines_of(problems), "");
    thread_ = std::thread([this] {
      line->run({[this](auto news) { take(std::move(news)); }, [this](auto told) { take(std::move(told)); },
                 [this](auto answers) { take(std::move(answers)); }});
    });
  }
  ~RunningLine() { stop(); }
  RunningLine(const RunningLine&) = delete;
  RunningLine& operator=(const RunningLine&) = delete;

  void stop() {
    line->stop();
    if (thread_.joinable()) thread_.join();
  }

  /// What became of it.
  Problems ask(decltype(Request::what) what) {
    std::unique_lock lock(mutex_);
    const Asker asker = ++askers_;
    EXPECT_TRUE(line->ask({asker, std::move(what)}));
    if (!wait(lock, [&] { return answers_.contains(asker); })) return {};
    return answers_.at(asker);
  }
  /// The first news from now on, or of those not looked at yet, for which `wanted` holds.
  std::shared_ptr<const News> until(const std::function<bool(const News&)>& wanted) {
    std::unique_lock lock(mutex_);
    for (;;) {
      while (seen_ < news_.size())
        if (wanted(*news_[seen_++])) return news_[seen_ - 1];
      if (!wait(lock, [this] { return seen_ < news_.size(); })) return std::make_shared<News>();
    }
  }
  std::shared_ptr<const LineDescription> description() {
    until([](const News&) { return true; });
    const std::lock_guard lock(mutex_);
    return description_;
  }

  std::unique_ptr<Line> line;

 private:
  template <typename Told>
  bool wait(std::unique_lock<std::mutex>& lock, const Told& told) {
    const bool came = told_.wait_for(lock, std::chrono::seconds(60), told);
    EXPECT_TRUE(came) << "the line told nothing for a minute";
    return came;
  }
  void take(std::shared_ptr<const News> news) {
    const std::lock_guard lock(mutex_);
    news_.push_back(std::move(news));
    told_.notify_all();
  }
  void take(std::vector<Answer> answers) {
    const std::lock_guard lock(mutex_);
    for (auto& answer : answers) answers_[answer.asker] = std::move(answer.problems);
    told_.notify_all();
  }
  void take(std::shared_ptr<const LineDescription> description) {
    const std::lock_guard lock(mutex_);
    description_ = std::move(description);
  }

  std::mutex mutex_;
  std::condition_variable told_;
  std::vector<std::shared_ptr<const News>> news_;
  std::map<Asker, Problems> answers_;
  std::size_t seen_ = 0;
  std::shared_ptr<const LineDescription> description_;
  Asker askers_ = 0;
  std::thread thread_;
};

}  // namespace drycut::sim::live
