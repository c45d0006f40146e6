#include "renders/caption_bar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renders/cairo_image.hpp"
#include "renders/text.hpp"

namespace drycut::renders {
namespace {

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

void write_in(cairo_t* pen, const Ink& colour, double x, double baseline, const std::string& words) {
  set_ink(pen, colour);
  write_text(pen, x, baseline, words);
}

/// A lamp of that diameter; dark with a ring if it is off.
void draw_lamp(cairo_t* pen, double x, double y, double diameter, bool on) {
  cairo_new_path(pen);  // words leave the pen where they end
  cairo_arc(pen, x, y, diameter / 2, 0, 2 * std::numbers::pi);
  set_ink(pen, on ? kLampOn : kLampOff);
  cairo_fill_preserve(pen);
  set_ink(pen, kLabel);
  cairo_set_line_width(pen, diameter / 10);
  cairo_stroke(pen);
}

}  // namespace

CaptionLayout::CaptionLayout(const Film& film) : title_(one_line(film.title)), width_(film.width) {
  const double scale = picture_scale(film.height);
  margin_ = 16 * scale;
  title_size_ = 16 * scale;

  const CairoSurface nowhere = cairo_surface(16, 16);
  const Cairo pen = cairo_pen(nowhere.get());
  constexpr double kMeasure = 64;
  set_font(pen.get(), kMeasure);
  const auto width_of = [&](const std::string& words) {
    return text_width(pen.get(), one_line(words)) / kMeasure;
  };
  std::vector<Widths> items;
  for (const Frame& frame : film.frames) {
    if (std::abs(frame.time_s * 1e3 - std::round(frame.time_s * 1e3)) > 1e-4) time_digits_ = 4;
    if (frame.caption.size() > items.size()) items.resize(frame.caption.size());
    for (std::size_t i = 0; i < frame.caption.size(); ++i) {
      items[i].label = std::max(items[i].label, width_of(frame.caption[i].label));
      const double value = frame.caption[i].lamp ? kLamp : width_of(frame.caption[i].value);
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
  const CairoSurface surface = cairo_surface(width_, height_);
  const Cairo owned = cairo_pen(surface.get());
  cairo_t* const pen = owned.get();
  set_ink(pen, kGround);
  fill_box(pen, 0, 0, width_, height_);
  set_ink(pen, kRule);
  fill_box(pen, 0, 0, width_, std::max(1.0, std::round(margin_ / 8)));

  const double baseline = 0.45 * margin_ + 0.85 * kLine * title_size_ * 0.92;
  set_font(pen, title_size_, true);
  const std::string time = fmt::format("t = {:.{}f} s", frame.time_s, time_digits_);
  const double time_width = text_width(pen, time);
  write_in(pen, kTitle, margin_, baseline, fitted_text(pen, title_, width_ - 3 * margin_ - time_width));
  write_in(pen, kTitle, width_ - margin_ - time_width, baseline, time);

  set_font(pen, font_size_);
  for (std::size_t i = 0; i < std::min(frame.caption.size(), cells_.size()); ++i) {
    const Cell& cell = cells_[i];
    const double value_room = cell.right - cell.left - cell.label_width - kValueGap * font_size_;
    const std::string label = fitted_text(pen, one_line(frame.caption[i].label), cell.label_width + 0.01);
    const std::string value = fitted_text(pen, one_line(frame.caption[i].value), value_room + 0.01);
    write_in(pen, kLabel, cell.left, cell.baseline, label);
    if (const auto lamp = frame.caption[i].lamp) {
      const double diameter = kLamp * font_size_;
      draw_lamp(pen, cell.right - diameter / 2, cell.baseline - 0.36 * font_size_, diameter, *lamp);
      continue;
    }
    write_in(pen, kValue, cell.right - text_width(pen, value), cell.baseline, value);
  }
  copy_rows(surface.get(), height_, image, image.height - height_);
}

}  // namespace drycut::renders
