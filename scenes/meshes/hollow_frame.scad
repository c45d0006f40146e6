// Longitudinal frame of a line: two side walls with cut-outs between cross members.
use <common.scad>
length = 1400;
height = 220;
width = 240;
wall = 14;
windows = 4;
for (side = [-1, 1]) translate([0, 0, side * (width - wall) / 2]) {
  linear_extrude(wall, center = true) difference() {
    square([length, height], center = true);
    for (i = [0:windows - 1]) translate([length * ((i + 0.5) / windows - 0.5), -height * 0.05])
      rounded(length / windows * 0.66, height * 0.48, 20);
  }
  for (y = [-1, 1]) translate([0, y * (height / 2 - 8), -side * 12]) block([length, 16, 36], 2);
}
for (i = [0:windows]) translate([(length - 40) * (i / windows - 0.5), -height * 0.1, 0])
  cube([24, height * 0.6, width - 2 * wall + 2], center = true);
