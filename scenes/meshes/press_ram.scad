// Ram of the press: a ribbed beam between two guide bosses, deeper in the middle.
use <common.scad>
width = 800;
height = 180;
depth = 300;
for (z = [-1, 1]) translate([0, 0, z * (depth / 2 - 12)]) linear_extrude(24, center = true) difference() {
  polygon([[-width / 2, -height * 0.3], [-width * 0.2, -height / 2], [width * 0.2, -height / 2], [width / 2, -height * 0.3],
           [width / 2, height / 2], [-width / 2, height / 2]]);
  for (x = [-0.19, 0.19]) translate([x * width, 4]) rounded(width * 0.16, height * 0.44, 16);
}
translate([0, height / 2 - 12, 0]) cube([width - 4, 24, depth - 20], center = true);
translate([0, -height / 2 + 14, 0]) cube([width * 0.4, 28, depth - 20], center = true);
for (x = [-0.41, -0.06, 0.06]) translate([x * width, 8, 0]) cube([20, height * 0.7, depth - 20], center = true);
translate([0.41 * width, 8, 0]) cube([20, height * 0.7, depth - 20], center = true);
