// Post of a machine frame: square section, foot plate with bolts.
use <common.scad>
width = 60;
height = 400;
depth = 50;
translate([0, 4, 0]) block([width * 0.76, height - 8, depth * 0.8], 4);
translate([0, -height / 2 + 6, 0]) block([width, 12, depth], 2);
translate([0, height / 2 - 4, 0]) block([width * 0.9, 8, depth * 0.9], 2);
