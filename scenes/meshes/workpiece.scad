// Workpiece under the press: a flanged hub.
use <common.scad>
width = 300;
height = 100;
depth = 260;
translate([0, -height / 2 + 15, 0]) block([width, 30, depth], 4);
scale([1, 1, depth / width]) rotate([-90, 0, 0]) {
  translate([0, 0, -height / 2 + 20]) cylinder(d = width * 0.7, h = height * 0.4, $fn = 32);
  translate([0, 0, -height / 2 + 20]) cylinder(d = width * 0.5, h = height - 20, $fn = 32);
}
