// Cross-beam of a machine frame: a plate with cut-outs between two flanges.
use <common.scad>
width = 400;
height = 150;
depth = 50;
linear_extrude(depth * 0.4, center = true) difference() {
  square([width, height], center = true);
  for (x = [-1, 1]) translate([x * width * 0.29, 0]) rounded(width * 0.26, height * 0.5, 14);
}
for (y = [-1, 1]) translate([0, y * (height / 2 - 7), 0]) block([width, 14, depth], 2);
for (x = [-1, 0, 1]) translate([x * width * 0.46, 0, 0]) cube([12, height - 20, depth * 0.8], center = true);
