#include "renders/caption_bar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renders/cairo_image.hpp"
#include "renders/text.hpp"

namespace drycut::renders {
namespace {

constexpr const char* kFont = "DejaVu Sans";
constexpr double kLine = 1.5;       ///< line height / font size
constexpr double kValueGap = 0.55;  ///< between label and value / font size
constexpr double kColumnGap = 2.0;  ///< between columns / font size

constexpr Ink kRule = {0.92, 0.46, 0.10};
constexpr Ink kTitle = {0.97, 0.98, 0.99};
constexpr Ink kLabel = {0.62, 0.68, 0.74};
constexpr Ink kValue = {0.97, 0.98, 0.99};
constexpr Ink kLampOn = {0.25, 0.88, 0.35};
constexpr Ink kLampOff = {0.17, 0.20, 0.24};
constexpr double kLamp = 0.85;  ///< diameter / font size

/// A cairo picture to write on.
class Page {
 public:
  Page(int width, int height) : surface_(cairo_surface(width, height)), cairo_(cairo_pen(surface_.get())) {}

  void font(double size, bool bold = false) {
    cairo_select_font_face(cairo_.get(), kFont, CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo_.get(), size);
  }

  double width(const std::string& text) { return text_width(cairo_.get(), text); }
  std::string fitted(const std::string& text, double room) { return fitted_text(cairo_.get(), text, room); }

  void text(double x, double baseline, const std::string& words, const Ink& colour) {
    set_ink(cairo_.get(), colour);
    cairo_move_to(cairo_.get(), x, baseline);
    cairo_show_text(cairo_.get(), words.c_str());
  }

  void fill(double x, double y, double w, double h, const Ink& colour) {
    set_ink(cairo_.get(), colour);
    cairo_rectangle(cairo_.get(), x, y, w, h);
    cairo_fill(cairo_.get());
  }

  /// A lamp of that diameter; dark with a ring if it is off.
  void lamp(double x, double y, double diameter, bool on) {
    cairo_new_path(cairo_.get());  // words leave the pen where they end
    cairo_arc(cairo_.get(), x, y, diameter / 2, 0, 2 * std::numbers::pi);
    const Ink& colour = on ? kLampOn : kLampOff;
    set_ink(cairo_.get(), colour);
    cairo_fill_preserve(cairo_.get());
    set_ink(cairo_.get(), kLabel);
    cairo_set_line_width(cairo_.get(), diameter / 10);
    cairo_stroke(cairo_.get());
  }

  void copy_to(Image& image, int first_row, int rows) { copy_rows(surface_.get(), rows, image, first_row); }

 private:
  CairoSurface surface_;
  Cairo cairo_;
};

}  // namespace

CaptionLayout::CaptionLayout(const Film& film) : title_(one_line(film.title)), width_(film.width) {
  const double scale = picture_scale(film.height);
  margin_ = 16 * scale;
  title_size_ = 16 * scale;

  Page page(16, 16);
  constexpr double kMeasure = 64;
  page.font(kMeasure);
  std::vector<Widths> items;
  for (const Frame& frame : film.frames) {
    if (std::abs(frame.time_s * 1e3 - std::round(frame.time_s * 1e3)) > 1e-4) time_digits_ = 4;
    if (frame.caption.size() > items.size()) items.resize(frame.caption.size());
    for (std::size_t i = 0; i < frame.caption.size(); ++i) {
      items[i].label = std::max(items[i].label, page.width(one_line(frame.caption[i].label)) / kMeasure);
      const double value =
          frame.caption[i].lamp ? kLamp : page.width(one_line(frame.caption[i].value)) / kMeasure;
      items[i].value = std::max(items[i].value, value);
    }
  }

  // Rather a little smaller than one row more, rather one row more than hard to read.
  constexpr double kSmallest = 10.5;
  struct Attempt {
    std::size_t rows;
    double largest, smallest;
  };
  bool placed = false;
  for (const Attempt& attempt : {Attempt{1, 15, 13}, Attempt{2, 15, 12}, Attempt{3, 14, kSmallest}}) {
    for (double size = attempt.largest; !placed && size >= attempt.smallest; size -= 0.5) {
      placed = place(items, attempt.rows, size * scale, false);
    }
  }
  if (!placed) place(items, 4, kSmallest * scale, true);
}

bool CaptionLayout::place(const std::vector<Widths>& items, std::size_t rows, double font_size,
                          bool by_force) {
  const std::size_t columns = (items.size() + rows - 1) / rows;
  std::vector<Widths> widest(columns);
  for (std::size_t i = 0; i < items.size(); ++i) {
    Widths& column = widest[i % columns];
    column.label = std::max(column.label, items[i].label);
    column.value = std::max(column.value, items[i].value);
  }
  const double room = width_ - 2 * margin_;
  double used = 0;
  for (const Widths& column : widest) used += (column.label + kValueGap + column.value) * font_size;
  if (columns > 1) used += static_cast<double>(columns - 1) * kColumnGap * font_size;
  if (used > room && !by_force) return false;

  font_size_ = font_size;
  cells_.clear();
  const double share = columns > 0 ? (room + kColumnGap * font_size) / static_cast<double>(columns)
                                   : 0;  // of a column, when by force
  double left = margin_;
  std::vector<Cell> line;
  for (const Widths& column : widest) {
    Cell cell;
    cell.left = left;
    cell.label_width = column.label * font_size;
    cell.right = left + (column.label + kValueGap + column.value) * font_size;
    if (by_force) {
      cell.right = left + share - kColumnGap * font_size;
      const double value = std::min(column.value * font_size, 0.6 * share);
      cell.label_width = std::max(0.0, cell.right - left - value - kValueGap * font_size);
      left += share;
    } else {
      left = cell.right + kColumnGap * font_size;
    }
    line.push_back(cell);
  }
  const double first_line = 0.45 * margin_ + kLine * title_size_;
  const std::size_t across = std::max<std::size_t>(1, columns);
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::size_t row = i / across;
    Cell cell = line[i % across];
    cell.baseline = first_line + (static_cast<double>(row) + 0.72) * kLine * font_size;
    cells_.push_back(cell);
  }
  const std::size_t lines = (items.size() + across - 1) / across;
  height_ = static_cast<int>(
      std::ceil(first_line + static_cast<double>(lines) * kLine * font_size + 0.45 * margin_));
  return true;
}

void CaptionLayout::draw(const Frame& frame, Image& image) const {
  Page page(width_, height_);
  page.fill(0, 0, width_, height_, kGround);
  page.fill(0, 0, width_, std::max(1.0, std::round(margin_ / 8)), kRule);

  const double baseline = 0.45 * margin_ + 0.85 * kLine * title_size_ * 0.92;
  page.font(title_size_, true);
  const std::string time = fmt::format("t = {:.{}f} s", frame.time_s, time_digits_);
  const double time_width = page.width(time);
  page.text(margin_, baseline, page.fitted(title_, width_ - 3 * margin_ - time_width), kTitle);
  page.text(width_ - margin_ - time_width, baseline, time, kTitle);

  page.font(font_size_);
  for (std::size_t i = 0; i < std::min(frame.caption.size(), cells_.size()); ++i) {
    const Cell& cell = cells_[i];
    const double value_room = cell.right - cell.left - cell.label_width - kValueGap * font_size_;
    const std::string label = page.fitted(one_line(frame.caption[i].label), cell.label_width + 0.01);
    const std::string value = page.fitted(one_line(frame.caption[i].value), value_room + 0.01);
    page.text(cell.left, cell.baseline, label, kLabel);
    if (const auto lamp = frame.caption[i].lamp) {
      const double diameter = kLamp * font_size_;
      page.lamp(cell.right - diameter / 2, cell.baseline - 0.36 * font_size_, diameter, *lamp);
      continue;
    }
    page.text(cell.right - page.width(value), cell.baseline, value, kValue);
  }
  page.copy_to(image, image.height - height_, height_);
}

}  // namespace drycut::renders
