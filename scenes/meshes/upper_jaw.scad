// Upper jaw of a clamp: pad with grooves below, bridge and boss for the rod.
use <common.scad>
width = 60;
height = 50;
depth = 80;
translate([0, -height / 2 + 10, 0]) difference() {
  block([width, 20, depth], 2);
  for (x = [-2:2]) translate([x * 11, -10, 0]) cube([4, 4, depth + 2], center = true);
}
translate([0, 0, 0]) block([width * 0.6, 24, depth * 0.7], 4);
translate([0, height / 2 - 13, 0]) rotate([-90, 0, 0]) cylinder(d = 30, h = 13, $fn = 24);
