#pragma once
#include <cstdint>
#include <random>
#include <string_view>

namespace drycut {
class StateArchive;
}

namespace drycut::plants {

/// One source of random numbers: same seed and name, same draws, on every machine and standard library.
class Random {
 public:
  /// `occurrence` tells sources of one name apart.
  explicit Random(std::uint64_t seed = 1, std::string_view source = "", std::uint64_t occurrence = 0);

  /// Uniform in [0, 1), 53 bits.
  double uniform();
  /// Normal with mean 0 and standard deviation 1. std::normal_distribution is not the same in every library.
  double gaussian();

  void visit(StateArchive& archive);

 private:
  std::mt19937_64 engine_;
  double spare_ = 0;
  bool has_spare_ = false;
};

}  // namespace drycut::plants
