#include "tests/bench/recording.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <ctime>
#include <filesystem>
#include <vector>

#include "sim/record/hdf5_file.hpp"

namespace drycut::bench {

namespace {

constexpr int rows = 1'000'000;
constexpr std::size_t channels = 30;

/// What a line records: positions in counts and in units, speeds, oscillations, switches, settings.
void set_row(int row, std::vector<double>& numbers) {
  const double t = row * 1e-4;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto k = static_cast<double>(i + 1);
    switch (i % 6) {
      case 0:
        numbers[i] = 100 * std::sin(t * k);
        break;
      case 1:
        numbers[i] = std::floor(t * 8192 * k);
        break;
      case 2:
        numbers[i] = row / 5000 % 2;
        break;
      case 3:
        numbers[i] = std::floor(20 * std::sin(3 * t + k)) / 10;
        break;
      case 4:
        numbers[i] = t * 1000 / 3 + 0.01 * std::sin(40 * t) + k;
        break;
      default:
        numbers[i] = 1.5 * k;
    }
  }
}

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

double write_hdf5() {
  std::vector<double> numbers(channels);
  sim::record::Recording recording;
  for (std::size_t i = 0; i < channels; ++i)
    recording.add(fmt::format("line.channel{}", i), "mm").slot = &numbers[i];
  const auto begin = processor_seconds();
  for (int row = 0; row < rows; ++row) set_row(row, numbers);
  const auto made = processor_seconds();
  const auto file = std::filesystem::temp_directory_path() / fmt::format("drycut_bench_{}.h5", getpid());
  {
    const auto writer = sim::record::hdf5_writer(recording, file, {});
    auto& out = *writer;
    for (int row = 0; row < rows; ++row) {
      set_row(row, numbers);
      out.sample(sim::Time{row} * 100 * sim::microsecond);
    }
    out.finish();
  }
  const auto written = processor_seconds();
  std::filesystem::remove(file);
  return written - made - (made - begin);
}

}  // namespace drycut::bench
