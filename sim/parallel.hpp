#pragma once
#include <cstddef>
#include <functional>

namespace drycut::sim {

/// Runs `work(i)` for 0 <= i < count on `jobs` threads, this one among them. The first exception ends it and
/// is thrown on.
void for_each_index(std::size_t count, int jobs, const std::function<void(std::size_t)>& work);

}  // namespace drycut::sim
