// The caption can be read: every text is read back from the picture by its
// letters' shapes, stands out from its ground, and is whole, apart from the
// others and between equal margins.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>

#include "renders/cairo_image.hpp"
#include "renders/caption_bar.hpp"

namespace drycut::renders {
namespace {

/// Pixels from left to right and top to bottom, the last ones included.
struct Box {
  int left = 1 << 30, top = 1 << 30, right = -1, bottom = -1;
  int width() const { return right - left + 1; }
  int height() const { return bottom - top + 1; }
  void take(int x, int y) {
    left = std::min(left, x);
    right = std::max(right, x);
    top = std::min(top, y);
    bottom = std::max(bottom, y);
  }
  bool touches(const Box& other) const {
    return left <= other.right && other.left <= right && top <= other.bottom && other.top <= bottom;
  }
};

/// Where two pictures differ by more than one can see.
Box changed(const Image& a, const Image& b) {
  Box box;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      for (int c = 0; c < 3; ++c)
        if (std::abs(a.row(y)[3 * x + c] - b.row(y)[3 * x + c]) > 40) box.take(x, y);
  return box;
}

/// Relative luminance by WCAG 2, 0 to 1.
double luminance(const std::uint8_t* pixel) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    const double v = pixel[c] / 255.0;
    sum += (v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4)) *
           std::array{0.2126, 0.7152, 0.0722}[c];
  }
  return sum;
}

/// How much of each pixel of the box is ink: 0 the ground at its corner's side,
/// 1 the brightest.
std::vector<double> ink_of(const Image& image, const Box& box) {
  const double ground = image.row(box.top)[3 * (box.left > 0 ? box.left - 1 : 0) + 1];
  std::vector<double> ink;
  double most = 1;
  for (int y = box.top; y <= box.bottom; ++y)
    for (int x = box.left; x <= box.right; ++x) {
      ink.push_back(std::max(0.0, image.row(y)[3 * x + 1] - ground));
      most = std::max(most, ink.back());
    }
  for (double& one : ink) one /= most;
  return ink;
}

/// Where a text stands in a box: its font size and the pen's place [pixels].
struct Fit {
  double size = 0, x = 0, y = 0;
  double likeness = -1;  ///< at most 1
};

/// `text` as it fills a box, in white on black. Written with cairo, as the
/// caption is, but from nothing that the caption knows.
Image written(const std::string& text, const Box& box, const Fit& fit, bool bold) {
  const CairoSurface surface = cairo_surface(box.width(), box.height());
  const Cairo pen = cairo_pen(surface.get());
  cairo_select_font_face(pen.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(pen.get(), fit.size);
  cairo_set_source_rgb(pen.get(), 1, 1, 1);
  cairo_move_to(pen.get(), fit.x, fit.y);
  cairo_show_text(pen.get(), text.c_str());
  Image image(box.width(), box.height());
  copy_rows(surface.get(), box.height(), image, 0);
  return image;
}

/// Extents of the text at font size 1.
cairo_text_extents_t extents_of(const std::string& text, bool bold) {
  constexpr double size = 256;
  const CairoSurface surface = cairo_surface(8, 8);
  const Cairo pen = cairo_pen(surface.get());
  cairo_select_font_face(pen.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(pen.get(), size);
  cairo_text_extents_t extents;
  cairo_text_extents(pen.get(), text.c_str(), &extents);
  for (double* one : {&extents.width, &extents.height, &extents.x_bearing, &extents.y_bearing}) *one /= size;
  return extents;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double sa = 0, sb = 0, aa = 0, bb = 0, ab = 0;
  const auto n = static_cast<double>(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    sa += a[i], sb += b[i];
    aa += a[i] * a[i], bb += b[i] * b[i], ab += a[i] * b[i];
  }
  const double spread = (aa - sa * sa / n) * (bb - sb * sb / n);
  return spread > 0 ? (ab - sa * sb / n) / std::sqrt(spread) : 0;
}

/// How well what is seen in the box looks like `text` at that place.
double likeness(const std::vector<double>& seen, const Box& box, const std::string& text, const Fit& fit,
                bool bold) {
  const Image wanted = written(text, box, fit, bold);
  std::vector<double> ink;
  for (std::size_t i = 1; i < wanted.rgb.size(); i += 3) ink.push_back(wanted.rgb[i] / 255.0);
  return correlation(seen, ink);
}

/// Size and place at which `text` fills the box from side to side, to a quarter
/// of a pixel.
Fit best_fit(const std::vector<double>& seen, const Box& box, const std::string& text, bool bold) {
  const auto extents = extents_of(text, bold);
  Fit best;
  for (const double width : {-1.2, -1.05, -0.9, -0.75, -0.6, -0.45, -0.3, -0.15, 0.0}) {
    Fit fit;
    fit.size = (box.width() + width) / extents.width;
    for (const double right : {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}) {
      for (const double down : {-0.5, 0.0, 0.5, 1.0}) {
        fit.x = right - extents.x_bearing * fit.size;
        fit.y = down - extents.y_bearing * fit.size;
        fit.likeness = likeness(seen, box, text, fit, bold);
        if (fit.likeness > best.likeness) best = fit;
      }
    }
  }
  return best;
}

/// Texts that differ from `text` in one digit.
std::vector<std::string> mistaken_for(const std::string& text) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < text.size(); ++i)
    for (char digit = '0'; std::isdigit(text[i]) != 0 && digit <= '9'; ++digit) {
      all.push_back(text);
      all.back()[i] = digit;
    }
  return all;
}

/// What cannot be read there, "" if all is well.
std::string trouble(const Image& image, const Box& box, const std::string& text, bool bold = false) {
  if (box.right < 0) return text + " is not there";
  double dark = 1, bright = 0;
  for (int y = box.top; y <= box.bottom; ++y)
    for (int x = box.left; x <= box.right; ++x) {
      dark = std::min(dark, luminance(image.row(y) + 3 * x));
      bright = std::max(bright, luminance(image.row(y) + 3 * x));
    }
  if ((bright + 0.05) / (dark + 0.05) < 4.5) return text + " does not stand out";
  const auto seen = ink_of(image, box);
  const Fit own = best_fit(seen, box, text, bold);
  for (const auto& candidate : mistaken_for(text))
    if (likeness(seen, box, candidate, own, bold) > own.likeness) return text + " reads as " + candidate;
  return own.likeness > 0.85 ? "" : text + " is blurred or cut: " + std::to_string(own.likeness);
}

/// A film of three items, and its bar with everything, and with less of it.
struct Bar {
  Film film;
  std::vector<CaptionItem> items = {
      {"web.speed", "61.47 m/min"}, {"AxisX.follerr", "2358 bits x4"}, {"knife.cut.length", "799.06 mm"}};
  std::optional<CaptionLayout> layout;

  Bar(int width, int height) {
    film.title = "Rotary knife, 800 mm pieces";
    film.width = width;
    film.height = height;
    film.frames.resize(1);
    film.frames[0].caption = items;
    film.frames[0].time_s = 1.234;
    layout.emplace(film);
  }
  Image with(std::vector<CaptionItem> shown, bool title = true) const {
    Film same = film;
    if (!title) same.title.clear();
    Frame frame = film.frames[0];
    frame.caption = std::move(shown);
    Image image(film.width, layout->height());
    CaptionLayout(same).draw(frame, image);
    return image;
  }
  Image whole() const { return with(items); }

  struct Text {
    std::string text;
    Box box;
    bool bold = false;
  };
  /// Every text of the bar and where it is, found by leaving it out.
  std::vector<Text> texts() const {
    std::vector<Text> all;
    std::vector<CaptionItem> shown;
    for (const auto& item : items) {
      const auto before = with(shown);
      shown.push_back({item.label});
      const auto label = with(shown);
      shown.back().value = item.value;
      all.push_back({item.label, changed(before, label)});
      all.push_back({item.value, changed(label, with(shown))});
    }
    const auto bare = with({}, false);
    all.push_back({film.title, changed(bare, with({})), true});
    // The time alone is left on the bare bar, below the rule.
    Image ground = bare;
    const int rule = static_cast<int>(std::ceil(film.height / 540.0 * 2)) + 1;
    for (int y = 0; y < ground.height; ++y)
      for (int x = 0; x < 3 * ground.width; ++x)
        if (y >= rule) ground.row(y)[x] = ground.row(ground.height - 1)[x % 3];
    all.push_back({"t = 1.234 s", changed(bare, ground), true});
    return all;
  }
};

class Caption : public ::testing::TestWithParam<std::pair<int, int>> {
 protected:
  Bar bar{GetParam().first, GetParam().second};
};
INSTANTIATE_TEST_SUITE_P(Of, Caption,
                         ::testing::Values(std::pair(640, 360), std::pair(960, 540), std::pair(1920, 1080)),
                         [](const auto& size) { return std::to_string(size.param.first); });

TEST_P(Caption, EveryTextReadsBackAndStandsOut) {
  const auto image = bar.whole();
  for (const auto& [text, box, bold] : bar.texts()) EXPECT_EQ(trouble(image, box, text, bold), "");
}

TEST_P(Caption, TextsAreApartAndBetweenEqualMargins) {
  const auto texts = bar.texts();
  Box all;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    all.take(texts[i].box.left, texts[i].box.top);
    all.take(texts[i].box.right, texts[i].box.bottom);
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_FALSE(texts[i].box.touches(texts[k].box)) << texts[i].text << " and " << texts[k].text;
  }
  const double scale = bar.film.height / 540.0;
  EXPECT_NEAR(all.left, 16 * scale, 2 * scale);
  EXPECT_NEAR(bar.film.width - 1 - all.right, 16 * scale, 2 * scale);
  EXPECT_GE(all.top, 4 * scale) << "below the rule";
  EXPECT_GE(bar.layout->height() - 1 - all.bottom, 4 * scale) << "above the lower edge";
}

TEST_P(Caption, AnotherValueChangesNothingButItself) {
  const auto texts = bar.texts();
  const auto before = bar.whole();
  for (std::size_t i = 0; i < bar.items.size(); ++i) {
    auto items = bar.items;
    auto& value = items[i].value;
    for (char& letter : value)
      if (std::isdigit(letter) != 0) letter = letter == '8' ? '3' : '8';
    const auto change = changed(before, bar.with(items));
    const Box& own = texts[2 * i + 1].box;
    EXPECT_GE(change.left, own.left - own.width() / 4);
    EXPECT_LE(change.right, own.right + 1);
    EXPECT_GE(change.top, own.top - 1);
    EXPECT_LE(change.bottom, own.bottom + 1);
    EXPECT_GT(change.width(), own.width() / 8);
  }
}

TEST_P(Caption, WhatCannotBeReadIsNoticed) {
  const auto image = bar.whole();
  for (const auto& [what, where, strong] : bar.texts()) {
    const auto& text = what;  // clang 14 takes no binding into a lambda
    const auto& box = where;
    const bool bold = strong;
    const auto spoilt = [&](const auto& change) {
      Image made = image;
      for (int y = box.top; y <= box.bottom; ++y)
        for (int x = box.left; x <= box.right; ++x)
          for (int c = 0; c < 3; ++c) made.row(y)[3 * x + c] = change(x, y, c);
      return trouble(made, box, text, bold);
    };
    const std::uint8_t* const ground = image.row(image.height - 1);
    EXPECT_NE(spoilt([&](int, int, int c) { return ground[c]; }), "") << "in the colour of its ground";
    EXPECT_NE(spoilt([&](int x, int y, int c) {
                return static_cast<std::uint8_t>((3 * ground[c] + image.row(y)[3 * x + c]) / 4);
              }),
              "")
        << "faint";
    EXPECT_NE(spoilt([&](int x, int y, int c) {
                return y > box.bottom - box.height() / 2 ? ground[c] : image.row(y)[3 * x + c];
              }),
              "")
        << "its lower half cut off";
    EXPECT_NE(spoilt([&](int x, int y, int c) {
                const int from = x - box.height() / 2;
                return from < box.left ? ground[c] : image.row(y)[3 * from + c];
              }),
              "")
        << "moved by half a letter";
  }
}

}  // namespace
}  // namespace drycut::renders
