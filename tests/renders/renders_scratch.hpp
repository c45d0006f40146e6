#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "renders/plots.hpp"
#include "renders/png_image.hpp"
#include "tests/test_folder.hpp"

namespace drycut::renders {

using Scratch = TestFolder;

/// The plot as it is drawn.
inline Image drawn(const Plot& plot) {
  const Scratch scratch;
  return read_png(draw_plots({plot}, scratch.path).at(0));
}

/// Pixels of nearly that colour.
inline int pixels_like(const Image& image, int red, int green, int blue) {
  int count = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    const int off =
        std::abs(image.rgb[i] - red) + std::abs(image.rgb[i + 1] - green) + std::abs(image.rgb[i + 2] - blue);
    if (off < 40) ++count;
  }
  return count;
}

/// What `action` says when it throws an `Error`; fails the test if it does not.
template <typename Error, typename Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

}  // namespace drycut::renders
