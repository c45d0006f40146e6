#include "sim/cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "sim/interrupt.hpp"

namespace drycut::sim::cli {

ProgressBar::ProgressBar(bool wanted) : terminal_(wanted && isatty(STDERR_FILENO) != 0) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::show(const std::string& label, double done) {
  InterruptWatch::check_progress();
  constexpr int width = 30;
  if (!terminal_) return;
  const std::lock_guard lock(mutex_);
  const int thousandths = static_cast<int>(std::clamp(done, 0.0, 1.0) * 1000);
  if (thousandths == shown_ && label == label_) return;
  shown_ = thousandths;
  label_ = label;
  const int filled = thousandths * width / 1000;
  fmt::print(stderr, "\r\x1b[K[{}{}] {:3}% {}", std::string(filled, '#'), std::string(width - filled, '.'),
             thousandths / 10, label);
  std::fflush(stderr);
}

void ProgressBar::clear() {
  if (!terminal_) return;
  const std::lock_guard lock(mutex_);
  if (shown_ < 0) return;
  fmt::print(stderr, "\r\x1b[K");
  std::fflush(stderr);
  shown_ = -1;
}

}  // namespace drycut::sim::cli
