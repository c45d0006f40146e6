#include "sim/loop/played_cams.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/state_archive.hpp"
#include "devices/cam/table.hpp"

namespace drycut::sim::loop {

namespace {

constexpr std::ptrdiff_t most_samples = 100'000;  // of a cam at least, twice as many at most

}  // namespace

CamRecorder::CamRecorder(std::vector<devices::CamAxis> axes, const Deviation& deviation, bool keeps_samples)
    : keeps_samples_(keeps_samples) {
  for (auto& axis : axes) {
    Follower follower;
    if (axis.pulses) follower.deviation = deviation(*axis.pulses);
    follower.axis = std::move(axis);
    followers_.push_back(std::move(follower));
  }
}

void CamRecorder::step() {
  for (auto& follower : followers_) {
    const auto start = follower.axis.start();
    if (start == follower.start) continue;
    follower.start = start;
    follower.followed = false;
    if (start != 0) take_table(follower);
  }
}

void CamRecorder::take_table(Follower& follower) {
  constexpr std::size_t most_tables = 8;
  auto table = follower.axis.table();
  follower.now = none;
  if (table == nullptr) return;
  const auto same = [&](std::size_t cam) { return *played_[cam].table == *table; };
  const auto found = std::find_if(follower.cams.begin(), follower.cams.end(), same);
  if (found != follower.cams.end()) {
    follower.now = *found;
  } else if (follower.cams.size() == most_tables) {
    ++untold_;
  } else {
    follower.now = played_.size();
    follower.cams.push_back(follower.now);
    played_.push_back({follower.axis.name, std::move(table)});
  }
}

// Two samples that are near to each other tell more of the device's sampling than of the master.
void CamRecorder::take_speed(Follower& follower, Time time, double master, bool begins) {
  constexpr Time span = 20 * millisecond;
  auto& window = follower.window;
  if (begins) window.clear();
  window.emplace_back(time, master);
  while (window.size() > 2 && time - window[1].first >= span) window.pop_front();
  const auto [since, from] = window.front();
  if (time - since < span) return;
  auto& fastest = played_[follower.now].fastest;
  fastest = std::max(fastest, std::abs(master - from) / seconds(time - since));
}

void CamRecorder::sample(Time time) {
  for (auto& follower : followers_) {
    if (follower.now == none) continue;
    const auto moment = follower.axis.moment();
    const bool begins = !follower.followed;
    follower.followed = moment.follows;
    if (!moment.follows) continue;
    take_speed(follower, time, moment.master, begins);
    if (!keeps_samples_) continue;
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
    const double behind = moment.behind        ? *moment.behind
                          : follower.deviation ? follower.deviation()
                                               : nothing;
    played_[follower.now].take({time, begins, moment.master, moment.set, behind, moment.turn});
  }
}

std::vector<PlayedCam> CamRecorder::played() const {
  auto played = played_;
  for (const auto& follower : followers_)
    if (auto table = follower.cams.empty() ? follower.axis.table() : nullptr; table != nullptr)
      played.push_back({follower.axis.name, std::move(table)});
  return played;
}

void PlayedCam::take(const Sample& sample) {
  if (samples.size() == 2 * most_samples) {
    samples.erase(samples.begin(), samples.begin() + most_samples);
    left_out += most_samples;
  }
  samples.push_back(sample);
}

// Samples that are left out are gone for good.
void PlayedCam::shorten(std::size_t size) {
  if (size == 0) left_out = 0;
  samples.resize(size > left_out ? size - left_out : 0);
}

void PlayedCam::entries(StateArchive& archive, std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < to; ++i) {
    Sample sample;
    if (!archive.restores() && i >= left_out) sample = samples[i - left_out];
    STATE(archive, sample.time, sample.begins, sample.master, sample.set, sample.behind, sample.turn);
    if (archive.restores()) take(sample);
  }
}

void CamRecorder::visit(StateArchive& archive) {
  STATE(archive, untold_);
  archive.list("played_", played_, [&](PlayedCam& cam) { STATE(archive, cam.axis, cam.fastest); });
  archive.each("followers_", followers_, [&](Follower& follower) {
    STATE(archive, follower.start, follower.followed, follower.window, follower.cams, follower.now);
  });
  int number = 0;
  for (auto& cam : played_) {
    if (cam.table == nullptr || archive.restores()) {
      // It may be another one by now. All cams of a controller are of one kind.
      const auto axis = std::ranges::find(followers_, cam.axis, [](const auto& of) { return of.axis.name; });
      if (axis == followers_.end()) throw BadState("the cam of an axis that there is not");
      const auto now = cam.table != nullptr ? cam.table : axis->axis.table();
      if (now == nullptr) throw BadState("a cam whose axis has no table");
      auto table = std::make_shared<devices::CamTable>(*now);
      STATE(archive, *table);
      cam.table = std::move(table);
    } else {
      auto table = *cam.table;
      STATE(archive, table);
    }
    archive.log(fmt::format("samples {}", number++), cam);
  }
}

}  // namespace drycut::sim::loop
