// Crown of the press: two side plates with windows, closed above and below, boss for the nut.
use <common.scad>
width = 1040;
height = 160;
depth = 440;
for (z = [-1, 1]) translate([0, 0, z * (depth / 2 - 14)]) linear_extrude(28, center = true) difference() {
  polygon([[-width / 2, -height / 2], [width / 2, -height / 2], [width / 2, height * 0.1], [width * 0.42, height / 2],
           [-width * 0.42, height / 2], [-width / 2, height * 0.1]]);
  for (x = [-0.3, -0.1, 0.1, 0.3]) translate([x * width, 0]) rounded(width * 0.13, height * 0.44, 16);
}
translate([0, -height / 2 + 12, 0]) cube([width - 4, 24, depth - 20], center = true);
translate([0, height / 2 - 10, 0]) cube([width * 0.82, 20, depth - 20], center = true);
for (x = [-0.44, -0.2, 0, 0.2, 0.44]) translate([x * width, -6, 0]) cube([22, height - 30, depth - 20], center = true);
