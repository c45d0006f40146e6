// Press bed: box section with ribs and T-slots along its top.
use <common.scad>
width = 1040;
height = 220;
depth = 560;
rotate([0, 90, 0]) linear_extrude(width, center = true) difference() {
  translate([-depth / 2, -height / 2]) square([depth, height]);
  for (side = [-1, 1]) translate([side * depth / 2, -10]) rounded(60, height - 90, 8);
}
for (x = [-0.47, -0.235, 0, 0.235, 0.47]) translate([x * width, 0, 0]) cube([26, height - 30, depth - 6], center = true);
