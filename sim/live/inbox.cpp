#include "sim/live/inbox.hpp"

#include <algorithm>

namespace drycut::sim::live {

bool Inbox::has_room(const Request& request) const {
  if (std::holds_alternative<Leave>(request.what) || std::holds_alternative<Visit>(request.what)) return true;
  const auto own = queues_.find(request.asker);
  if (own == queues_.end()) return true;
  const auto& [requests, bytes] = own->second;
  return requests.size() < most_of_one && bytes + request.bytes <= most_bytes_of_one &&
         waiting_ < most_of_all;
}

bool Inbox::put(Request request) {
  const std::lock_guard lock(mutex_);
  if (!has_room(request)) return false;
  auto& queue = queues_[request.asker];
  if (queue.requests.empty()) turns_.push_back(request.asker);
  queue.bytes += request.bytes;
  queue.requests.push_back(std::move(request));
  ++waiting_;
  changed_.notify_all();
  return true;
}

Request Inbox::take_first(std::map<Asker, Queue>::iterator of) {
  auto& [requests, bytes] = of->second;
  auto request = std::move(requests.front());
  requests.pop_front();
  bytes -= request.bytes;
  --waiting_;
  if (requests.empty()) queues_.erase(of);
  return request;
}

std::optional<Request> Inbox::take() {
  if (stopped_ || waiting_ == 0) return {};
  const std::lock_guard lock(mutex_);
  const auto asker = turns_.front();
  turns_.pop_front();
  auto request = take_first(queues_.find(asker));
  if (queues_.contains(asker)) turns_.push_back(asker);
  return request;
}

std::vector<Asker> Inbox::take_restarts() {
  const std::lock_guard lock(mutex_);
  std::vector<Asker> askers;
  for (auto queue = queues_.begin(); queue != queues_.end();) {
    const auto of = queue++;
    const auto asker = of->first;
    for (auto left = of->second.requests.size();
         left > 0 && std::holds_alternative<Restart>(of->second.requests.front().what); --left) {
      take_first(of);
      askers.push_back(asker);
      if (left == 1) std::erase(turns_, asker);
    }
  }
  return askers;
}

void Inbox::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  changed_.notify_all();
}

void Inbox::wait_until(std::chrono::steady_clock::time_point then) {
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, then, [this] { return has_mail(); });
}

}  // namespace drycut::sim::live
