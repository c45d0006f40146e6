#include "renders/filmstrip.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/output_file.hpp"
#include "renders/cairo_image.hpp"
#include "renders/png_image.hpp"
#include "renders/text.hpp"

namespace drycut::renders {
namespace {

constexpr int kFrameWidth = 320;
constexpr int kGap = 6;
constexpr int kLabelHeight = 30;
constexpr double kLabelSize = 15;
constexpr int kLabelLine = 19;  ///< more for each further line of words
constexpr std::size_t kMostLabelLines = 4;

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
  std::vector<std::vector<std::string>> labels;
  int most = 1;
  for (const StripFrame& frame : frames) {
    labels.push_back(wrapped_text(one_line(frame.label), kLabelSize, kFrameWidth, kMostLabelLines));
    most = std::max(most, static_cast<int>(labels.back().size()));
  }
  const int height = frame_height + kGap + kLabelHeight + (most - 1) * kLabelLine;

  const CairoSurface strip = cairo_surface(width, height);
  const Cairo page = cairo_pen(strip.get());
  cairo_set_source_rgb(page.get(), 1, 1, 1);
  cairo_paint(page.get());
  cairo_set_font_size(page.get(), kLabelSize);
  for (int i = 0; i < count; ++i) {
    const StripFrame& frame = frames[static_cast<std::size_t>(i)];
    const Image image = read_png(frame.png);
    if (image.width != first.width || image.height != first.height)
      throw std::invalid_argument("filmstrip: " + frame.png.string() + " is of another size");
    const CairoSurface picture = cairo_surface_of(image, shown);
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
    cairo_set_source_rgb(page.get(), 0.12, 0.16, 0.20);
    double baseline = kGap + frame_height + 0.68 * kLabelHeight;
    for (const std::string& line : labels[static_cast<std::size_t>(i)]) {
      write_text(page.get(), left + (kFrameWidth - text_width(page.get(), line)) / 2, baseline, line);
      baseline += kLabelLine;
    }
  }
  Image picture(width, height);
  copy_rows(strip.get(), height, picture, 0);
  write_file(file, png_bytes(picture));
}

}  // namespace drycut::renders
