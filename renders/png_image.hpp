#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace drycut::renders {

/// A picture in memory: rows from the top, three bytes (red, green, blue) a pixel.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;

  Image() = default;
  Image(int w, int h)
      : width(w), height(h), rgb(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * 3) {}
  std::uint8_t* row(int y) {
    return rgb.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width) * 3;
  }
  const std::uint8_t* row(int y) const {
    return rgb.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width) * 3;
  }
};

/// The image as a PNG file's bytes. `effort` is libdeflate's, from 1 to 12: tuned for speed unless it is said
/// otherwise, not for the last byte. Its chunk Software says drycut. Throws std::runtime_error.
std::string png_bytes(const Image& image, int effort = 1);

/// Reads a PNG file of any kind. Throws std::runtime_error if it is none.
Image read_png(const std::filesystem::path& file);

/// Throws std::runtime_error that names the file.
std::string read_file(const std::filesystem::path& file);

}  // namespace drycut::renders
