#pragma once
#include "renders/plot_layout.hpp"
#include "renders/png_image.hpp"

namespace drycut::renders {

/// The picture of a plot. With log_x the plot's x are logarithms already. Same plot, same bytes.
Image painted(const Plot& plot, const PlotLayout& layout);

}  // namespace drycut::renders
