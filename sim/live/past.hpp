#pragma once
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "sim/live/line_view.hpp"
#include "sim/live/moments.hpp"
#include "sim/live/request.hpp"

namespace drycut::sim::live {

/// What a run has behind it: moments that are kept, what was done to it, and another simulation of the same
/// scenario, which comes to any time of it, in a thread of its own: the line does not wait. All functions are
/// for the line's thread.
class Past {
 public:
  /// May be used if there are no problems.
  Past(const scenario::Scenario& scenario, Problems& problems);
  ~Past();
  Past(const Past&) = delete;
  Past& operator=(const Past&) = delete;

  [[nodiscard]] Time next_moment() const { return moments_.next(); }
  void keep(Moment moment);
  void done(const scenario::Stimulus& act);
  /// How many were done.
  [[nodiscard]] std::size_t acts() const { return acts_.size(); }
  [[nodiscard]] const Moments& moments() const { return moments_; }
  /// Whether they fit, which are to be done later.
  void try_acts(const std::vector<scenario::Stimulus>& acts, Problems& problems);

  /// Has it told what was to be seen then, from the thread of this; `time` is not behind the present.
  void look(Asker asker, int run, Look look);
  /// Who asked is gone.
  void leave(Asker asker);

  /// Nobody is told any more what it was asked before.
  void rest();
  /// Comes to the newest moment at or before `time`, which it returns, and rests there. Throws BadState.
  Moment come_before(Time time);
  /// The run is now the one that has come to that moment, and `view` has it. Gives what was done from there
  /// until `time`: all that was done since is forgotten.
  std::vector<scenario::Stimulus> swap(std::unique_ptr<LineView>& view, const Moment& moment, Time time);

 private:
  struct Asked {
    Asker asker;
    int run;
    Look look;
  };
  void work();
  void answer(const Asked& asked);
  void restore(const Moment& moment);
  void go_on_to(Time time);
  static void refuse(const Asked& asked, const std::string& why);

  std::unique_ptr<LineView> view_;
  Time step_;
  std::size_t added_ = 0;  ///< acts that its timeline has ...
  std::size_t good_ = 0;   ///< ... of which so many are still the run's

  std::mutex mutex_;  ///< of what follows
  std::condition_variable changed_;
  Moments moments_;
  std::deque<scenario::Stimulus> acts_;  ///< by the step at which they were done
  std::deque<Asked> asked_;              ///< one of each asker
  bool busy_ = false;                    ///< with one of them
  bool over_ = false;
  std::atomic<bool> hurry_ = false;  ///< what it does is wanted no more
  std::thread thread_;               ///< from the first look on
};

}  // namespace drycut::sim::live
