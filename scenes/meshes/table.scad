// Slide plate under the web, its edges turned down.
use <common.scad>
length = 1450;
height = 20;
width = 330;
translate([0, height / 2 - 3, 0]) block([length, 6, width], 1.5);
for (z = [-1, 1]) translate([0, 0, z * (width / 2 - 3)]) block([length, height, 6], 1.5);
for (i = [-3:3]) translate([i * length / 7, -2, 0]) cube([18, height - 8, width - 8], center = true);
