#include "renders/cairo_image.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "renders/text.hpp"

namespace drycut::renders {
namespace {

constexpr const char* kFont = "DejaVu Sans";

}  // namespace

CairoSurface cairo_surface(int width, int height) {
  CairoSurface made(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height), cairo_surface_destroy);
  if (cairo_surface_status(made.get()) != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error("pictures: cairo cannot make a picture");
  return made;
}

CairoSurface cairo_surface_of(const Image& image, int height) {
  CairoSurface made = cairo_surface(image.width, height);
  unsigned char* pixels = cairo_image_surface_get_data(made.get());
  const int stride = cairo_image_surface_get_stride(made.get());
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* from = image.row(y);
    unsigned char* to = pixels + static_cast<std::ptrdiff_t>(y) * stride;
    for (int x = 0; x < image.width; ++x, from += 3, to += 4) {
      const std::uint32_t pixel = 0xff000000U | static_cast<std::uint32_t>(from[0]) << 16U |
                                  static_cast<std::uint32_t>(from[1]) << 8U | from[2];
      std::memcpy(to, &pixel, sizeof pixel);
    }
  }
  cairo_surface_mark_dirty(made.get());
  return made;
}

void copy_rows(cairo_surface_t* from, int rows, Image& image, int first_row) {
  cairo_surface_flush(from);
  const unsigned char* pixels = cairo_image_surface_get_data(from);
  const int stride = cairo_image_surface_get_stride(from);
  for (int y = 0; y < rows; ++y) {
    const unsigned char* row = pixels + static_cast<std::ptrdiff_t>(y) * stride;
    std::uint8_t* to = image.row(first_row + y);
    for (int x = 0; x < image.width; ++x, row += 4, to += 3) {
      to[0] = row[2];
      to[1] = row[1];
      to[2] = row[0];
    }
  }
}

Cairo cairo_pen(cairo_surface_t* surface) {
  Cairo pen(cairo_create(surface), cairo_destroy);
  if (cairo_status(pen.get()) != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error("pictures: cairo cannot draw on a picture");
  const std::unique_ptr<cairo_font_options_t, decltype(&cairo_font_options_destroy)> options(
      cairo_font_options_create(), cairo_font_options_destroy);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(pen.get(), options.get());
  cairo_select_font_face(pen.get(), kFont, CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  return pen;
}

void set_font(cairo_t* pen, double size, bool bold) {
  cairo_select_font_face(pen, kFont, CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(pen, size);
}

void write_text(cairo_t* pen, double x, double baseline, const std::string& words) {
  cairo_move_to(pen, x, baseline);
  cairo_show_text(pen, words.c_str());
}

void fill_box(cairo_t* pen, double left, double top, double width, double height) {
  cairo_rectangle(pen, left, top, width, height);
  cairo_fill(pen);
}

double text_width(cairo_t* pen, const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(pen, text.c_str(), &extents);
  return extents.x_advance;
}

std::string fitted_text(cairo_t* pen, std::string text, double room) {
  if (text_width(pen, text) <= room) return text;
  while (!text.empty() && text_width(pen, text + "…") > room) drop_last_character(text);
  return text + "…";
}

double picture_scale(int height) { return std::clamp(height / 540.0, 0.5, 4.0); }

void set_ink(cairo_t* pen, const Ink& ink, double opacity) {
  cairo_set_source_rgba(pen, ink.red, ink.green, ink.blue, opacity);
}

}  // namespace drycut::renders
