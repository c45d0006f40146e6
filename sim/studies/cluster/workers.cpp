#include "sim/studies/cluster/workers.hpp"

#include <mutex>

#include "sim/parallel.hpp"
#include "sim/studies/cluster/dispatch.hpp"

namespace drycut::sim::cluster {

void Workers::run(const Round& round) const {
  if (engine_) return dispatch(round, *engine_, jobs_);
  std::mutex mutex;
  for_each_index(round.count, jobs_, [&](std::size_t i) {
    const auto ask = round.ask(i);
    if (!ask) return;
    const WorkerAnswer answer{ask->here(), ""};
    const std::lock_guard lock(mutex);
    round.take(i, answer);
  });
}

}  // namespace drycut::sim::cluster
