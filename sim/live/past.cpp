#include "sim/live/past.hpp"

#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>
#include <utility>

#include "sim/live/line.hpp"
#include "sim/loop/guests.hpp"

namespace drycut::sim::live {

namespace {

/// What a scan did is seen of scans that were watched: so much before the time that is looked at.
constexpr Time for_scans = 200 * millisecond;

}  // namespace

Past::Past(const scenario::Scenario& scenario, Problems& problems)
    : view_(std::make_unique<LineView>(scenario, problems)), step_(scenario.scene.step) {
  loop::refuse_guests_without_state(
      scenario, "drycut live keeps moments to go back to; drycut run does without", problems);
  // The first state says which files the scenario has: they may be edited while it runs.
  if (problems.empty()) static_cast<void>(view_->simulation().save());
}

Past::~Past() {
  rest();
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
}

void Past::keep(Moment moment) {
  const std::lock_guard lock(mutex_);
  moments_.keep(std::move(moment));
}

void Past::done(const scenario::Stimulus& act) {
  const std::lock_guard lock(mutex_);
  acts_.push_back(act);
}

void Past::try_acts(const std::vector<scenario::Stimulus>& acts, Problems& problems) {
  for (const auto& act : acts) view_->simulation().act(act, problems);
  added_ = good_ = acts.size();
}

void Past::refuse(const Asked& asked, const std::string& why) {
  asked.look.told({{"live.busy"_code, "look", 1, 1, why, "look again"}}, {});
}

void Past::look(Asker asker, int run, Look look) {
  const std::lock_guard lock(mutex_);
  // Who draws the time bar wants to see where it is, not where it was.
  const auto earlier = std::ranges::find(asked_, asker, &Asked::asker);
  if (earlier != asked_.end()) {
    refuse(*earlier, "a later look came before this one was done");
    asked_.erase(earlier);
  }
  asked_.push_back({asker, run, std::move(look)});
  if (!thread_.joinable()) {
    thread_ = std::thread([this] { work(); });
    pthread_setname_np(thread_.native_handle(), "past");
  }
  changed_.notify_all();
}

void Past::leave(Asker asker) {
  const std::lock_guard lock(mutex_);
  std::erase_if(asked_, [&](const Asked& one) { return one.asker == asker; });
}

void Past::work() {
  std::unique_lock lock(mutex_);
  while (!over_) {
    if (asked_.empty()) {
      changed_.wait(lock);
      continue;
    }
    const auto asked = std::move(asked_.front());
    asked_.pop_front();
    busy_ = true;
    lock.unlock();
    answer(asked);
    lock.lock();
    busy_ = false;
    changed_.notify_all();
  }
}

void Past::rest() {
  std::unique_lock lock(mutex_);
  for (const auto& asked : std::exchange(asked_, {})) refuse(asked, "the run that was looked at has ended");
  hurry_ = true;
  changed_.wait(lock, [this] { return !busy_; });
  hurry_ = false;
}

void Past::answer(const Asked& asked) {
  const auto& look = asked.look;
  const auto time = look.time / step_ * step_;
  Seen seen;
  Problems problems;
  try {
    view_->watch_programs(false);
    std::unique_lock lock(mutex_);
    const auto from = moments_.before(look.programs ? time - for_scans : time);
    lock.unlock();
    restore(from);
    view_->watch_programs(look.programs);
    go_on_to(time);
  } catch (const BadState& bad) {
    problems = {{"live.other-files"_code, "look", 1, 1,
                 fmt::format("the moment cannot be shown: {}", bad.what()), "restart the line"}};
  }
  if (hurry_) return refuse(asked, "the run that was looked at has ended");
  if (problems.empty()) problems = view_->values_of(look.names, seen.read);
  if (problems.empty()) {
    seen.run = asked.run;
    seen.time = view_->now();
    view_->look(seen);
    if (view_->watches_programs()) seen.programs = view_->simulation().controller()->positions(seen.time);
    seen.outcome = view_->simulation().outcome();
  }
  look.told(problems, seen);
}

// The timeline has what was done until then, in the same order, before it comes back: it is kept by number.
void Past::restore(const Moment& moment) {
  auto& simulation = view_->simulation();
  std::unique_lock lock(mutex_);
  if (good_ < added_) {
    const auto common = moments_.with_acts(good_);
    lock.unlock();
    simulation.restore(*common.state);
    added_ = good_ = common.acts;
    lock.lock();
  }
  while (added_ < moment.acts) {
    const auto act = acts_[added_];
    lock.unlock();
    Problems none;  // it fitted once
    simulation.act(act, none);
    good_ = ++added_;
    lock.lock();
  }
  lock.unlock();
  simulation.restore(*moment.state);
  added_ = good_ = moment.acts;
}

void Past::go_on_to(Time time) {
  auto& simulation = view_->simulation();
  while (!hurry_ && view_->now() < time) {
    {
      const std::lock_guard lock(mutex_);
      for (; added_ < acts_.size() && acts_[added_].at.value_or(0) <= view_->now(); good_ = ++added_) {
        Problems none;
        simulation.act(acts_[added_], none);
      }
    }
    const auto next = [&] {
      const std::lock_guard lock(mutex_);
      return added_ < acts_.size() ? std::min(time, acts_[added_].at.value_or(0)) : time;
    }();
    do {
      if (!simulation.advance()) return;
    } while (!hurry_ && view_->now() < next);
  }
}

Moment Past::come_before(Time time) {
  rest();
  view_->watch_programs(false);
  auto moment = moments_.before(time / step_ * step_);
  restore(moment);
  return moment;
}

std::vector<scenario::Stimulus> Past::swap(std::unique_ptr<LineView>& view, const Moment& moment, Time time) {
  std::swap(view_, view);
  view_->tell({});
  const std::lock_guard lock(mutex_);
  added_ = acts_.size();  // the view that was the present one has all that was done
  good_ = moment.acts;
  std::vector<scenario::Stimulus> again;
  for (auto act = good_; act < acts_.size() && acts_[act].at.value_or(0) < time; ++act)
    again.push_back(acts_[act]);
  acts_.resize(good_);
  moments_.cut(moment.time);
  return again;
}

}  // namespace drycut::sim::live
