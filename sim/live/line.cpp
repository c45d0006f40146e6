#include "sim/live/line.hpp"

#include <sched.h>

#include <algorithm>
#include <cmath>

#include "sim/live/line_run.hpp"

namespace drycut::sim::live {

namespace {

constexpr auto between_news = std::chrono::milliseconds(33);
constexpr auto not_made_good = std::chrono::milliseconds(200);  ///< who is so late begins anew
constexpr int news_an_outcome = 15;

/// This thread before the others of the machine, where the system lets us; it does when we are root, or have
/// been given CAP_SYS_NICE or a limit of rtprio.
void be_first(bool first) {
  const sched_param priority{first ? 1 : 0};
  sched_setscheduler(0, (first ? SCHED_RR : SCHED_OTHER) | SCHED_RESET_ON_FORK, &priority);
}

}  // namespace

Line::Line(Options options, Problems& problems)
    : options_(std::move(options)), running_(options_.running), pace_(options_.pace) {
  run_ = std::make_unique<LineRun>(options_, 1, problems);
}

Line::~Line() = default;

void Line::stop() {
  const std::lock_guard lock(inbox_.mutex);
  stopped_ = true;
  has_mail_ = true;
  inbox_.changed.notify_all();
}

void Line::ask(Request request) {
  const std::lock_guard lock(inbox_.mutex);
  inbox_.requests.push_back(std::move(request));
  has_mail_ = true;
  inbox_.changed.notify_all();
}

void Line::run(const Listener& listener, const Describe& describe) {
  listener_ = listener;
  describe_ = describe;
  run_->begin(options_.record, stopped_);
  describe_(run_->describe());
  begin_pace();
  next_news_ = Clock::now();
  while (take_mail()) {
    if (running_ && run_->failure().empty()) {
      cycle();
      keep_pace();
    } else {
      wait_for_mail();
    }
    if (Clock::now() >= next_news_) tell();
  }
  be_first(false);
  tell();
  run_->end();
}

const std::filesystem::path& Line::record() const { return run_->record(); }

bool Line::take_mail() {
  if (!has_mail_.exchange(false)) return true;
  if (stopped_) return false;
  std::deque<Request> mail;
  {
    const std::lock_guard lock(inbox_.mutex);
    mail.swap(inbox_.requests);
  }
  for (const auto& request : mail) act_on(request);
  return true;
}

void Line::wait_for_mail() {
  std::unique_lock lock(inbox_.mutex);
  inbox_.changed.wait_until(lock, next_news_, [this] { return has_mail_.load(); });
}

void Line::act_on(const Request& request) {
  Problems problems;
  const auto& what = request.what;
  if (const auto* done = std::get_if<Act>(&what)) {
    problems = run_->act(done->text);
  } else if (const auto* on = std::get_if<Go>(&what)) {
    until_.reset();
    until_event_.reset();
    go(on->on);
  } else if (const auto* advance = std::get_if<Advance>(&what)) {
    until_event_.reset();
    until_ = run_->now() + std::max(run_->step(), advance->by);
    go(true);
  } else if (const auto* event = std::get_if<UntilEvent>(&what)) {
    problems = run_->await(event->name);
    if (problems.empty()) {
      until_.reset();
      until_event_ = event->name;
      go(true);
    }
  } else if (const auto* pace = std::get_if<Pace>(&what)) {
    pace_ = pace->value;
    begin_pace();
  } else if (std::holds_alternative<Restart>(what)) {
    problems = restart();
  } else if (const auto* sampled = std::get_if<Sample>(&what)) {
    tell();  // what has been sampled until now
    problems = run_->want(request.asker, *sampled);
  } else if (const auto* read = std::get_if<Read>(&what)) {
    std::vector<double> values;
    problems = run_->values_of(read->names, values);
    read->told(problems, values);
    return;
  } else if (const auto* visit = std::get_if<Visit>(&what)) {
    visit->visit(*run_);
    return;
  } else {
    tell();
    run_->leave(request.asker);
    return;
  }
  if (request.asker != 0) answers_.push_back({request.asker, std::move(problems)});
  next_news_ = Clock::now();
}

void Line::go(bool on) {
  running_ = on && run_->failure().empty();
  begin_pace();
}

Problems Line::restart() {
  Problems problems;
  run_->keep_retentive();
  auto fresh = std::make_unique<LineRun>(options_, run_->number() + 1, problems);
  if (!problems.empty()) return problems;
  run_->end();
  for (const auto& [asker, sample] : run_->wanted()) fresh->want(asker, sample);
  run_ = std::move(fresh);
  be_first(false);  // to where a session is gone on from is no matter of the clock
  run_->begin(options_.record, stopped_);
  until_.reset();
  until_event_.reset();
  describe_(run_->describe());
  begin_pace();
  return {};
}

Time Line::cycle_time() const {
  constexpr Time at_full_speed = 10 * millisecond;
  const auto fitting =
      keeps_pace() ? static_cast<Time>(std::llround(static_cast<double>(millisecond) * std::max(1.0, pace_)))
                   : at_full_speed;
  const Time step = run_->step();
  return std::max(step, fitting / step * step);
}

void Line::cycle() {
  auto end = run_->now() + cycle_time();
  if (until_) end = std::min(end, *until_);
  bool sound = true;
  while (sound && run_->now() < end && !(until_event_ && run_->seen())) sound = run_->advance();
  run_->take_samples();
  const bool there = (until_ && run_->now() >= *until_) || (until_event_ && run_->seen());
  if (sound && !there) return;
  until_.reset();
  until_event_.reset();
  running_ = false;
  next_news_ = Clock::now();
}

void Line::begin_pace() {
  be_first(keeps_pace());
  begun_ = Clock::now();
  begun_at_ = run_->now();
  punctuality_ = {};
}

void Line::keep_pace() {
  if (!keeps_pace()) return;
  const auto due = begun_ + std::chrono::nanoseconds(static_cast<std::int64_t>(
                                static_cast<double>(run_->now() - begun_at_) / pace_));
  const auto late = Clock::now() - due;
  ++punctuality_.cycles;
  if (late > std::chrono::milliseconds(1)) ++punctuality_.late;
  punctuality_.worst = std::max(punctuality_.worst, std::chrono::duration<double>(late).count());
  if (late > not_made_good) {
    punctuality_.dropped += std::chrono::duration<double>(late).count();
    begun_ += late;
    return;
  }
  // A request wakes it, but waits for the next cycle: the line goes by its clock.
  if (late < std::chrono::nanoseconds(0)) std::this_thread::sleep_until(due);
}

void Line::tell() {
  auto news = std::make_shared<News>();
  if (!running_) run_->take_samples();  // what was written is seen
  run_->tell(*news);
  news->running = running_;
  news->pace = pace_;
  news->punctuality = punctuality_;
  news->answers = std::exchange(answers_, {});
  if (news_++ % news_an_outcome == 0 || !running_) news->outcome = run_->outcome();
  listener_(std::move(news));
  next_news_ = Clock::now() + between_news;
}

}  // namespace drycut::sim::live
