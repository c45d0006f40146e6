// Leg pair: two square posts, a rail between them, levelling feet.
use <common.scad>
width = 90;
height = 750;
depth = 210;
post = 56;
foot = 46;
for (z = [-1, 1]) translate([0, 0, z * (depth - post) / 2]) {
  translate([0, foot / 2, 0]) block([post, height - foot, post], 4);
  translate([0, height / 2 - 5, 0]) block([width, 10, post], 2);
  translate([0, -height / 2, 0]) rotate([-90, 0, 0]) {
    cylinder(d1 = width, d2 = width * 0.7, h = 14, $fn = 24);
    cylinder(d = 20, h = foot + 4, $fn = 12);
  }
}
translate([0, -height / 2 + 150, 0]) block([post * 0.7, post * 0.7, depth - post], 3);
