#include "plants/random.hpp"

#include <cmath>

#include "base/state_archive.hpp"

namespace drycut::plants {

namespace {

/// FNV-1a over the name, then splitmix64 so that near seeds give unrelated streams.
std::uint64_t mix(std::uint64_t seed, std::string_view source, std::uint64_t occurrence) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : source) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  std::uint64_t z = seed * 0x9E3779B97F4A7C15ULL + hash + occurrence * 0xD1B54A32D192ED03ULL;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

}  // namespace

Random::Random(std::uint64_t seed, std::string_view source, std::uint64_t occurrence)
    : engine_(mix(seed, source, occurrence)) {}

double Random::uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }

double Random::gaussian() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  // Polar method of Marsaglia: two normals from a point inside the unit circle.
  double u = 0;
  double v = 0;
  double s = 0;
  do {
    u = 2 * uniform() - 1;
    v = 2 * uniform() - 1;
    s = u * u + v * v;
  } while (s >= 1 || s == 0);
  const double factor = std::sqrt(-2 * std::log(s) / s);
  spare_ = v * factor;
  has_spare_ = true;
  return u * factor;
}

void Random::visit(StateArchive& archive) {
  archive.plain("engine_", engine_);
  STATE(archive, spare_, has_spare_);
}

}  // namespace drycut::plants
