#include "sim/loop/shutter.hpp"

#include <algorithm>
#include <cmath>

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

}  // namespace drycut::sim::loop
