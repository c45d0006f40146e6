#pragma once
#include <mutex>
#include <string>

namespace drycut::sim::cli {

/// A progress bar on standard error, where that is a terminal; nothing elsewhere. Safe to use from several
/// threads.
class ProgressBar {
 public:
  /// `wanted`: else nothing anywhere.
  explicit ProgressBar(bool wanted = true);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Draws the bar: `done` 0..1 of what `label` says.
  void show(const std::string& label, double done);
  /// Takes the bar off the terminal, so that a line can be printed.
  void clear();

 private:
  std::mutex mutex_;
  bool terminal_;
  int shown_ = -1;  ///< per mille; a bar is drawn only when it changes
  std::string label_;
};

}  // namespace drycut::sim::cli
