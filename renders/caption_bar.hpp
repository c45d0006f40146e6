#pragma once
#include <string>
#include <vector>

#include "renders/png_image.hpp"
#include "renders/scene3d.hpp"

namespace drycut::renders {

/// The bar below the picture: title and time, then the numbers in columns that stay where they are over the
/// whole film. What does not fit in one row goes to more rows, then to a smaller font, and at last is
/// shortened with an ellipsis: nothing runs out of the picture.
class CaptionLayout {
 public:
  /// Measures all captions of the film.
  explicit CaptionLayout(const Film& film);

  int height() const { return height_; }  ///< pixels

  /// Draws the caption of `frame` into the lowest height() rows of `image`.
  void draw(const Frame& frame, Image& image) const;

 private:
  /// Widest label and value of an item over the film, at font size 1.
  struct Widths {
    double label = 0;
    double value = 0;
  };
  /// Where an item is [pixels]; the baseline counts from the top of the bar.
  struct Cell {
    double left = 0;
    double label_width = 0;
    double right = 0;
    double baseline = 0;
  };

  bool place(const std::vector<Widths>& items, std::size_t rows, double font_size, bool by_force);

  std::string title_;
  int time_digits_ = 3;  ///< what tells all frames' times in seconds apart
  int width_ = 0;
  int height_ = 0;
  double margin_ = 0;
  double title_size_ = 0;
  double font_size_ = 0;
  std::vector<Cell> cells_;
};

}  // namespace drycut::renders
