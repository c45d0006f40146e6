#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace drycut::renders {

/// One picture of a strip.
struct StripFrame {
  std::filesystem::path png;
  std::string label;  ///< "4.218 s"
};

/// Writes the frames side by side, smaller, without the lowest `caption_height` pixels, each with its label
/// below. All frames are of one size. Throws std::runtime_error that names the file that cannot be read or
/// written, std::invalid_argument for no frames or frames of different sizes.
void draw_filmstrip(const std::vector<StripFrame>& frames, int caption_height,
                    const std::filesystem::path& file);

}  // namespace drycut::renders
