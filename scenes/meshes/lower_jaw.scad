// Lower jaw of a clamp: block with a V for the tube and side lugs.
use <common.scad>
width = 60;
height = 90;
depth = 80;
rotate([0, 90, 0]) linear_extrude(width, center = true)
  polygon([[-depth / 2 + 3, -height / 2], [depth / 2 - 3, -height / 2], [depth / 2 - 3, -height / 2 + 26], [depth / 2 - 14, -height / 2 + 32],
           [depth / 2 - 14, height / 2 - 22], [depth / 2, height / 2 - 16], [depth / 2, height / 2], [-depth / 2, height / 2],
           [-depth / 2, height / 2 - 16], [-depth / 2 + 14, height / 2 - 22], [-depth / 2 + 14, -height / 2 + 32], [-depth / 2 + 3, -height / 2 + 26]]);
for (z = [-1, 1]) translate([0, -height / 2 + 12, z * (depth / 2 - 1.5)]) rotate([0, 0, 0]) cylinder(d = 12, h = 3, center = true, $fn = 6);
