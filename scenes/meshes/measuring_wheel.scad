// Measuring wheel: tyre, rim, five spokes, hub.
use <common.scad>
diameter = 159;
width = 30;
lathe([[diameter / 2 - 9, -width / 2], [diameter / 2 - 2, -width / 2], [diameter / 2, -width / 2 + 2],
       [diameter / 2, width / 2 - 2], [diameter / 2 - 2, width / 2], [diameter / 2 - 9, width / 2],
       [diameter / 2 - 13, width / 2 - 5], [diameter / 2 - 13, -width / 2 + 5]], 36);
linear_extrude(12, center = true) for (i = [0:4]) rotate(72 * i) translate([0, -7]) square([diameter / 2 - 11, 14]);
rod(40, width, 2, 20);
