#include "renders/png_image.hpp"

#include <libdeflate.h>
#include <png.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string_view>

namespace drycut::renders {
namespace {

void put_number(std::string& bytes, std::uint32_t number) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 255U);
}

/// Length, kind and data are there from `start` on: writes the length and what proves the rest.
void finish_chunk(std::string& bytes, std::size_t start) {
  constexpr std::size_t kLength = 4;
  constexpr std::size_t kKind = 4;
  std::string length;
  put_number(length, static_cast<std::uint32_t>(bytes.size() - start - kLength - kKind));
  bytes.replace(start, kLength, length);
  put_number(bytes, libdeflate_crc32(0, bytes.data() + start + kLength, bytes.size() - start - kLength));
}

std::size_t begin_chunk(std::string& bytes, const char* kind) {
  const std::size_t start = bytes.size();
  bytes += "    ";  // the length comes with the end
  bytes += kind;
  return start;
}

/// What PNG compresses: every row behind the number of its filter, here none.
std::string unfiltered_rows(const Image& image) {
  const std::size_t row = static_cast<std::size_t>(image.width) * 3;
  std::string rows((row + 1) * static_cast<std::size_t>(image.height), '\0');
  for (int y = 0; y < image.height; ++y)
    std::copy_n(image.row(y), row, rows.data() + static_cast<std::size_t>(y) * (row + 1) + 1);
  return rows;
}

using Compressor = std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)>;

}  // namespace

std::string png_bytes(const Image& image, int effort) {
  const Compressor compressor(libdeflate_alloc_compressor(effort), libdeflate_free_compressor);
  if (!compressor || image.rgb.empty()) throw std::runtime_error("pictures: a picture cannot be compressed");
  std::string bytes = "\x89PNG\r\n\x1a\n";
  const std::size_t header = begin_chunk(bytes, "IHDR");
  put_number(bytes, static_cast<std::uint32_t>(image.width));
  put_number(bytes, static_cast<std::uint32_t>(image.height));
  bytes += {8, PNG_COLOR_TYPE_RGB, PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE, PNG_INTERLACE_NONE};
  finish_chunk(bytes, header);

  const std::size_t text = begin_chunk(bytes, "tEXt");
  bytes += std::string_view("Software\0drycut", 15);
  finish_chunk(bytes, text);

  const std::size_t data = begin_chunk(bytes, "IDAT");
  const std::string rows = unfiltered_rows(image);
  const std::size_t before = bytes.size();
  bytes.resize(before + libdeflate_zlib_compress_bound(compressor.get(), rows.size()));
  bytes.resize(before + libdeflate_zlib_compress(compressor.get(), rows.data(), rows.size(),
                                                 bytes.data() + before, bytes.size() - before));
  finish_chunk(bytes, data);
  finish_chunk(bytes, begin_chunk(bytes, "IEND"));
  return bytes;
}

Image read_png(const std::filesystem::path& file) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&png, file.c_str()) == 0) {
    throw std::runtime_error(file.string() + ": not a PNG picture: " + png.message);
  }
  png.format = PNG_FORMAT_RGB;
  Image image(static_cast<int>(png.width), static_cast<int>(png.height));
  if (png_image_finish_read(&png, nullptr, image.rgb.data(), 0, nullptr) == 0) {
    throw std::runtime_error(file.string() + ": not a whole PNG picture: " + png.message);
  }
  return image;
}

std::string read_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw std::runtime_error(file.string() + ": cannot be read: " + std::strerror(errno));
  return bytes;
}

}  // namespace drycut::renders
