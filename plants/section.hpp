#pragma once

namespace drycut::plants {

/// The cross-section of the material on a line: a strip, or a round tube that lies on the line.
struct Section {
  double width = 0;  ///< of the strip; outer diameter of the tube [m]
  double wall = 0;   ///< thickness of the strip or of the tube's wall [m]
  bool tube = false;
};

/// How high it stands over the line [m].
[[nodiscard]] double section_height(const Section& section);
/// Area of the material [m2].
[[nodiscard]] double section_area(const Section& section);
/// Its second moment about the axis across the line in its middle, against which a strip bends up [m4].
[[nodiscard]] double section_bending(const Section& section);
/// How much material a straight horizontal edge at `depth` below the top runs through [m]; 0 outside.
[[nodiscard]] double section_chord(const Section& section, double depth);

}  // namespace drycut::plants
