#pragma once
#include <cstdint>
#include <initializer_list>
#include <numbers>
#include <ostream>
#include <vector>

#include "devices/camming4/cam.hpp"

namespace drycut::devices::camming4 {

inline constexpr double pi = std::numbers::pi;

inline void PrintTo(const CamEvent& event, std::ostream* out) {
  *out << event.code << " in row " << event.row;
}

inline constexpr double tolerance = 1e-9;
/// Units of a hundredth of a count.
inline constexpr CamSettings hundredths{.master = {1, 100}, .slave = {1, 100}, .decpt = 0};

/// A cam with the counters that a device would keep: positm and posit in grains, counter shifts applied, the
/// slave exactly on its theoretical whole bit.
class CamBench {
 public:
  explicit CamBench(std::initializer_list<Row> rows, const CamSettings& settings = {}) : settings_(settings) {
    cam.set(settings);
    int number = 1;
    for (const Row& row : rows) put(number++, row);
  }

  void put(int number, const Row& row) {
    cam.write(number, Column::codeG, row.codeG);
    cam.write(number, Column::codeQm, row.codeQm);
    cam.write(number, Column::codeQs, row.codeQs);
    cam.write(number, Column::codeQma, row.codeQma);
    cam.write(number, Column::codeQsa, row.codeQsa);
    cam.write(number, Column::codeM, row.codeM);
  }

  void start() { cam.start({.master_count = master, .slave_bits = slave}); }

  /// The master moves to `count`, in one sampling.
  const CamStep& to(std::int64_t count) {
    master_grains += (count - master) * settings_.master.measure;
    master = count;
    const CamStep& step = cam.advance({master, master_grains, slave, slave_grains, master_speed});
    master_grains -= step.master_shift;
    slave_grains += (step.slave_bits - slave) * settings_.slave.measure - step.slave_shift;
    slave = step.slave_bits;
    if (step.error.code != 0) errors.push_back(step.error);
    for (int i = 0; i < step.warning_count; ++i)
      warnings.push_back(step.warnings[static_cast<std::size_t>(i)]);
    return step;
  }
  /// The master moves to `count` in steps of `stride` counts, forwards or backwards, while the cam runs.
  const CamStep& run(std::int64_t count, std::int64_t stride = 1) {
    while (master != count && cam.running()) {
      if (master < count)
        to(master + stride < count ? master + stride : count);
      else
        to(master - stride > count ? master - stride : count);
    }
    return cam.step();
  }

  /// The same; the slave's position there [Um].
  double slave_at(std::int64_t count, std::int64_t stride = 1) {
    run(count, stride);
    return slave_um();
  }

  /// Theoretical slave position from the start of the counts [Um].
  [[nodiscard]] double slave_um() const {
    return (static_cast<double>(cam.step().slave_bits) + cam.step().slave_fraction) *
           static_cast<double>(settings_.slave.measure) / static_cast<double>(settings_.slave.pulse);
  }
  [[nodiscard]] std::int64_t positm() const { return master_grains / settings_.master.pulse; }
  [[nodiscard]] std::int64_t posit() const { return slave_grains / settings_.slave.pulse; }

  Cam cam;
  std::int64_t master = 0;
  std::int64_t master_grains = 0;
  std::int64_t slave = 0;
  std::int64_t slave_grains = 0;
  double master_speed = 0;
  std::vector<CamEvent> errors;
  std::vector<CamEvent> warnings;

 private:
  CamSettings settings_;
};

/// A cam that begins at count 0 of its master.
inline CamBench started(std::initializer_list<Row> rows, const CamSettings& settings = {}) {
  CamBench bench(rows, settings);
  bench.start();
  return bench;
}

inline constexpr Row end_row{.codeG = 136};

}  // namespace drycut::devices::camming4
