#include "renders/filmstrip.hpp"

#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "renders/png_image.hpp"
#include "renders/text.hpp"

namespace drycut::renders {
namespace {

constexpr int kFrameWidth = 320;
constexpr int kGap = 6;
constexpr int kLabelHeight = 30;
constexpr double kLabelSize = 15;

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

Surface surface(int width, int height) {
  Surface made(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height), cairo_surface_destroy);
  if (cairo_surface_status(made.get()) != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error("filmstrip: cairo cannot make a picture");
  return made;
}

/// The upper `height` rows of the image.
Surface surface_of(const Image& image, int height) {
  Surface made = surface(image.width, height);
  unsigned char* pixels = cairo_image_surface_get_data(made.get());
  const int stride = cairo_image_surface_get_stride(made.get());
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* from = image.row(y);
    unsigned char* to = pixels + static_cast<std::ptrdiff_t>(y) * stride;
    for (int x = 0; x < image.width; ++x, from += 3, to += 4) {
      to[0] = from[2];
      to[1] = from[1];
      to[2] = from[0];
      to[3] = 255;
    }
  }
  cairo_surface_mark_dirty(made.get());
  return made;
}

Image image_of(cairo_surface_t* from, int width, int height) {
  cairo_surface_flush(from);
  Image image(width, height);
  const unsigned char* pixels = cairo_image_surface_get_data(from);
  const int stride = cairo_image_surface_get_stride(from);
  for (int y = 0; y < height; ++y) {
    const unsigned char* row = pixels + static_cast<std::ptrdiff_t>(y) * stride;
    std::uint8_t* to = image.row(y);
    for (int x = 0; x < width; ++x, row += 4, to += 3) {
      to[0] = row[2];
      to[1] = row[1];
      to[2] = row[0];
    }
  }
  return image;
}

}  // namespace

void draw_filmstrip(const std::vector<StripFrame>& frames, int caption_height,
                    const std::filesystem::path& file) {
  if (frames.empty()) throw std::invalid_argument("filmstrip: no frames");
  const Image first = read_png(frames.front().png);
  const int shown = first.height - caption_height;
  if (shown < 1) throw std::invalid_argument("filmstrip: the caption covers the whole frame");
  const double scale = static_cast<double>(kFrameWidth) / first.width;
  const int frame_height = std::max(1, static_cast<int>(std::lround(shown * scale)));
  const int count = static_cast<int>(frames.size());
  const int width = count * kFrameWidth + (count + 1) * kGap;
  const int height = frame_height + kGap + kLabelHeight;

  const Surface strip = surface(width, height);
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> page(cairo_create(strip.get()), cairo_destroy);
  cairo_set_source_rgb(page.get(), 1, 1, 1);
  cairo_paint(page.get());
  cairo_select_font_face(page.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(page.get(), kLabelSize);
  for (int i = 0; i < count; ++i) {
    const StripFrame& frame = frames[static_cast<std::size_t>(i)];
    const Image image = read_png(frame.png);
    if (image.width != first.width || image.height != first.height)
      throw std::invalid_argument("filmstrip: " + frame.png.string() + " is of another size");
    const Surface picture = surface_of(image, shown);
    const int left = kGap + i * (kFrameWidth + kGap);
    cairo_save(page.get());
    cairo_rectangle(page.get(), left, kGap, kFrameWidth, frame_height);
    cairo_clip(page.get());
    cairo_translate(page.get(), left, kGap);
    cairo_scale(page.get(), scale, scale);
    cairo_set_source_surface(page.get(), picture.get(), 0, 0);
    cairo_pattern_set_filter(cairo_get_source(page.get()), CAIRO_FILTER_GOOD);
    cairo_pattern_set_extend(cairo_get_source(page.get()), CAIRO_EXTEND_PAD);
    cairo_paint(page.get());
    cairo_restore(page.get());
    const std::string label = fitted_text(one_line(frame.label), kLabelSize, kFrameWidth);
    cairo_set_source_rgb(page.get(), 0.12, 0.16, 0.20);
    cairo_move_to(page.get(), left + (kFrameWidth - text_width(label, kLabelSize)) / 2,
                  kGap + frame_height + 0.68 * kLabelHeight);
    cairo_show_text(page.get(), label.c_str());
  }
  write_file(file, png_bytes(image_of(strip.get(), width, height)));
}

}  // namespace drycut::renders
