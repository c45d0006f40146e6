// Gear head of the saw: housing with ribs and cover screws, bore towards the blade at -x.
use <common.scad>
width = 80;
height = 120;
depth = 130;
block([width - 16, height - 8, depth], 8);
for (z = [-1, 0, 1]) translate([0, 0, z * depth * 0.36]) block([width - 8, height, 12], 3);
translate([-width / 2 + 4, 0, 0]) rotate([0, 90, 0]) cylinder(d = 96, h = 8, $fn = 40, center = true);
translate([width / 2 - 4, 0, 0]) rotate([0, 90, 0]) cylinder(d = 88, h = 8, $fn = 40, center = true);
