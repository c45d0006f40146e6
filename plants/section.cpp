#include "plants/section.hpp"

#include <cmath>
#include <numbers>

namespace drycut::plants {

namespace {

/// Chord of a circle at `height` over its middle [m].
double chord(double radius, double height) {
  return std::abs(height) < radius ? 2 * std::sqrt(radius * radius - height * height) : 0;
}

}  // namespace

double section_height(const Section& section) { return section.tube ? section.width : section.wall; }

double section_area(const Section& section) {
  if (!section.tube) return section.width * section.wall;
  return std::numbers::pi * section.wall * (section.width - section.wall);
}

double section_bending(const Section& section) {
  if (!section.tube) return section.width * std::pow(section.wall, 3) / 12;
  const double inner = section.width - 2 * section.wall;
  return std::numbers::pi / 64 * (std::pow(section.width, 4) - std::pow(inner, 4));
}

double section_chord(const Section& section, double depth) {
  if (depth <= 0 || depth >= section_height(section)) return 0;
  if (!section.tube) return section.width;
  const double radius = section.width / 2;
  const double height = radius - depth;
  return chord(radius, height) - chord(radius - section.wall, height);
}

}  // namespace drycut::plants
