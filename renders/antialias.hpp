#pragma once
#include "renders/png_image.hpp"

namespace drycut::renders {

/// Smooths the stairs of slanted edges in the upper `rows` rows: along every edge between bright and dark it
/// looks where the stair begins and ends and lets the two sides overlap by the share that the edge really
/// covers (after T. Lottes' FXAA). Far cheaper than more samples a pixel; flat areas stay as they are, byte
/// for byte.
void antialias(Image& image, int rows);

}  // namespace drycut::renders
