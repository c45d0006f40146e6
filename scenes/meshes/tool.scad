// Upper tool of the press: clamping plate, shank, hardened face.
use <common.scad>
width = 220;
height = 120;
depth = 220;
translate([0, height / 2 - 14, 0]) block([width, 28, depth], 3);
translate([0, 4, 0]) block([width * 0.62, height - 30, depth * 0.62], 4);
translate([0, -height / 2 + 14, 0]) block([width * 0.8, 28, depth * 0.8], 3);
translate([0, height / 2 - 30, 0]) rotate([90, 0, 0]) corners(width * 0.42, depth * 0.42) cylinder(d = 20, h = 8, $fn = 6);
