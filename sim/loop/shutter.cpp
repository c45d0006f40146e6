#include "sim/loop/shutter.hpp"

#include <algorithm>
#include <cmath>

#include "base/state_archive.hpp"
#include "sim/loop/known_events.hpp"

namespace drycut::sim::loop {

Shutter::Shutter(const scenario::PicturesSection& pictures)
    : period_(pictures.every / pictures.slow),
      from_(pictures.from),
      until_(pictures.until),
      around_(pictures.around),
      next_(pictures.frames ? std::max(period_, pictures.from) : never) {}

void Shutter::close() {
  next_ = never;
  keys_.close();
}

Snapshot* Shutter::look(Time now, const std::vector<plants::Part>& parts) {
  keys_.look(now, parts);
  if (now < next_) return nullptr;
  auto* shot = take(now);
  if (shot == nullptr) return nullptr;
  shot->time = now;
  shot->poses = keys_.poses();
  keys_.begin_frame(shot->between, shot->turned);
  return shot;
}

Snapshot* Shutter::take(Time now) {
  next_ = std::max(now + period_, from_);
  if (around_ && !event_) return hold(now);
  const auto end = around_ ? std::optional(*event_ + around_->after) : until_;
  if (end && now > *end) {
    close();
    return nullptr;
  }
  return &kept_.emplace_back();
}

Snapshot* Shutter::hold(Time now) {
  if (held_.empty() || held_.front().time >= now - around_->before) return &held_.emplace_back();
  // The oldest gives its memory to the newest: holding on costs no allocation.
  held_.push_back(std::move(held_.front()));
  held_.pop_front();
  auto& shot = held_.back();
  shot.caption.clear();
  shot.callouts.clear();
  shot.quota.reset();
  return &shot;
}

void Shutter::happened(const record::RecordedEvent& event) {
  if (!around_ || event_ || !names_event(around_->event.text, event.source, event.event)) return;
  if (++seen_ != around_->number) return;
  event_ = event.time + static_cast<Time>(std::llround(event.within * 1e9));
  for (auto& shot : held_) {
    if (shot.time >= *event_ - around_->before) kept_.push_back(std::move(shot));
  }
  held_.clear();
}

void Snapshot::visit(StateArchive& archive) {
  STATE(archive, time, poses, caption, between, turned);
  archive.list("callouts", callouts,
               [&](plants::Callout& call) { STATE(archive, call.kind, call.text, call.at, call.to); });
  bool has_quota = quota.has_value();
  STATE(archive, has_quota);
  if (!has_quota) return quota.reset();
  if (!quota) quota = Quota{};
  STATE(archive, quota->line.left, quota->line.right, quota->line.miss, quota->place);
}

void Shutter::visit(StateArchive& archive) {
  STATE(archive, keys_, next_, held_, seen_, event_);
  archive.log("kept_", *this);
}

void Shutter::entries(StateArchive& archive, std::size_t from, std::size_t to) {
  if (archive.restores()) kept_.resize(to);
  for (std::size_t i = from; i < to; ++i) kept_[i].visit(archive);
}

}  // namespace drycut::sim::loop
