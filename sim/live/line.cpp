#include "sim/live/line.hpp"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "sim/live/line_run.hpp"

namespace drycut::sim::live {

namespace {

constexpr auto between_news = std::chrono::milliseconds(33);
constexpr auto least_between_news = std::chrono::milliseconds(10);
constexpr auto not_made_good = std::chrono::milliseconds(200);  ///< who is so late begins anew
constexpr int news_an_outcome = 15;
/// Requests have so much of the time between two cycles; the others wait for the next one.
constexpr auto for_mail = std::chrono::microseconds(400);
constexpr auto in_time = std::chrono::milliseconds(1);

}  // namespace

Line::Line(Options options, Problems& problems)
    : options_(std::move(options)), running_(options_.running), pace_(options_.pace) {
  run_ = std::make_unique<LineRun>(options_, problems);
}

Line::~Line() = default;

void Line::run(Listener listener) {
  listener_ = std::move(listener);
  run_->begin(options_.record, inbox_);
  listener_.described(run_->describe());
  begin_pace();
  next_news_ = Clock::now();
  while (take_mail()) {
    if (!running_ || !run_->failure().empty()) {
      inbox_.wait_until(next_news_);
    } else if (Clock::now() >= due_) {
      cycle();
      keep_pace();
    } else {
      await_cycle();
    }
    if (!answers_.empty()) answer();
    if (Clock::now() >= next_news_) tell();
  }
  be_first(false);
  tell();
  end_run();
}

const std::filesystem::path& Line::record() const { return run_->record(); }

bool Line::take_mail() {
  if (!inbox_.has_mail()) return true;
  const auto enough = Clock::now() + for_mail;
  // Who is late runs first, but nobody waits for ever.
  while (const auto request = inbox_.take()) {
    act_on(*request);
    if ((keeps_pace() && behind_) || Clock::now() >= enough) break;
  }
  return !inbox_.stopped();
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
    answers_.push_back({request.asker, problems});
    for (const auto asker : inbox_.take_restarts()) answers_.push_back({asker, problems});
    return tell_soon();
  } else if (const auto* sampled = std::get_if<Sample>(&what)) {
    problems = run_->want(request.asker, *sampled);
  } else if (const auto* read = std::get_if<Read>(&what)) {
    std::vector<double> values;
    problems = run_->values_of(read->names, values);
    read->told(problems, values);
    return;
  } else if (const auto* look = std::get_if<Look>(&what)) {
    run_->look(request.asker, *look);
    return;
  } else if (const auto* on_from = std::get_if<GoOn>(&what)) {
    problems = go_on(on_from->from);
  } else if (const auto* visit = std::get_if<Visit>(&what)) {
    visit->visit(*run_);
    return;
  } else {
    run_->leave(request.asker);
    return;
  }
  if (request.asker != 0) answers_.push_back({request.asker, std::move(problems)});
  if (!running_ || !std::holds_alternative<Act>(what)) tell_soon();
}

void Line::go(bool on) {
  running_ = on && run_->failure().empty();
  begin_pace();
}

Problems Line::keep_retentive(const char* asked) {
  try {
    run_->keep_retentive();
  } catch (const std::runtime_error& not_kept) {
    return {{"file.not-writable"_code, asked, 1, 1, not_kept.what(),
             "make room for it; the line goes on as it is"}};
  }
  return {};
}

Problems Line::restart() {
  auto problems = keep_retentive("restart");
  if (!problems.empty()) return problems;
  auto fresh = std::make_unique<LineRun>(options_, *run_, problems);
  if (!problems.empty()) return problems;
  end_run();
  for (const auto& [asker, sample] : run_->wanted()) fresh->want(asker, sample);
  run_ = std::move(fresh);
  be_first(false);  // to where a session is gone on from is no matter of the clock
  run_->begin(options_.record, inbox_);
  begin_again();
  return {};
}

Problems Line::go_on(Time from) {
  auto problems = keep_retentive("go_on");
  if (problems.empty()) problems = run_->come_back(from);
  if (!problems.empty()) return problems;
  end_run();
  be_first(false);
  run_->go_on(from, options_.record, inbox_);
  running_ = running_ && run_->failure().empty();
  begin_again();
  return {};
}

void Line::begin_again() {
  until_.reset();
  until_event_.reset();
  listener_.described(run_->describe());
  begin_pace();
}

Time Line::cycle_time() const {
  constexpr double at_full_speed = 10;  // [ms]; of a slow machine that is a while
  const auto fitting =
      static_cast<Time>(std::llround(static_cast<double>(millisecond) *
                                     (keeps_pace() ? std::clamp(pace_, 1.0, at_full_speed) : at_full_speed)));
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
  tell_soon();
}

void Line::begin_pace() {
  be_first(keeps_pace());
  begun_ = due_ = Clock::now();
  begun_at_ = run_->now();
  behind_ = false;
  punctuality_ = {};
}

void Line::keep_pace() {
  if (!keeps_pace()) return;
  due_ = begun_ + std::chrono::nanoseconds(
                      static_cast<std::int64_t>(static_cast<double>(run_->now() - begun_at_) / pace_));
  const auto late = Clock::now() - due_;
  behind_ = late > in_time;
  ++punctuality_.cycles;
  if (behind_) ++punctuality_.late;
  punctuality_.worst = std::max(punctuality_.worst, std::chrono::duration<double>(late).count());
  if (late <= not_made_good) return;
  punctuality_.dropped += std::chrono::duration<double>(late).count();
  begun_ += late;
  due_ += late;
  be_first(false);  // it never sleeps: nobody else would come to that core
}

// A request does not wake it where the cycles are short: the line goes by its clock.
void Line::await_cycle() {
  constexpr auto is_short = std::chrono::milliseconds(2);
  if (keeps_pace()) be_first(true);
  if (due_ - Clock::now() < is_short)
    std::this_thread::sleep_until(due_);
  else
    inbox_.wait_until(std::min(due_, next_news_));
}

/// This thread before the others of the machine, where the system lets us; it does when we are root, or have
/// been given CAP_SYS_NICE or a limit of rtprio.
void Line::be_first(bool first) {
  if (first == first_) return;
  first_ = first;
  const sched_param priority{first ? 1 : 0};
  sched_setscheduler(0, (first ? SCHED_RR : SCHED_OTHER) | SCHED_RESET_ON_FORK, &priority);
}

void Line::tell() {
  auto news = std::make_shared<News>();
  if (!running_) run_->take_samples();  // what was written is seen
  run_->tell(*news);
  news->running = running_;
  news->pace = pace_;
  news->punctuality = punctuality_;
  if (news_++ % news_an_outcome == 0 || !running_) news->outcome = run_->outcome();
  listener_.news(std::move(news));
  next_news_ = Clock::now() + between_news;
}

// Who asks again and again does not have everybody told each time.
void Line::tell_soon() {
  next_news_ = std::max(Clock::now(), next_news_ - between_news + least_between_news);
}

void Line::answer() { listener_.answered(std::exchange(answers_, {})); }

void Line::end_run() {
  run_->end();
  if (record_lost_.empty()) record_lost_ = run_->record_lost();
}

}  // namespace drycut::sim::live
