// Upright of the press: H-section with ribs.
use <common.scad>
width = 100;
height = 970;
depth = 300;
ribs = 4;
block([width * 0.36, height, depth - 10], 2);
for (z = [-1, 1]) translate([0, 0, z * (depth / 2 - 15)]) block([width, height, 30], 3);
for (i = [0:ribs]) translate([0, (height - 24) * (i / ribs - 0.5), 0]) cube([width * 0.9, 22, depth - 40], center = true);
