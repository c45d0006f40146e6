// Belt of the outfeed: an endless band, rounded at its ends.
use <common.scad>
length = 2000;
height = 110;
width = 345;
thick = 4;
linear_extrude(width, center = true) difference() {
  hull() for (x = [-1, 1]) translate([x * (length - height) / 2, 0]) circle(d = height, $fn = 24);
  hull() for (x = [-1, 1]) translate([x * (length - height) / 2, 0]) circle(d = height - 2 * thick, $fn = 24);
}
