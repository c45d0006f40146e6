// Machine base of the knife: welded from hollow sections, on levelling feet.
use <common.scad>
width = 300;
height = 750;
depth = 400;
tube = 60;
foot = 40;
module post() { translate([0, foot / 2, 0]) block([tube, height - foot, tube], 4); }
for (x = [-1, 1], z = [-1, 1]) translate([x * (width - tube) / 2, 0, z * (depth - tube) / 2]) {
  post();
  translate([0, -height / 2, 0]) rotate([-90, 0, 0]) {
    cylinder(d = tube * 0.95, h = 12, $fn = 16);
    cylinder(d = 20, h = foot + 6, $fn = 8);
  }
}
for (x = [-1, 1], y = [height / 2 - tube / 2, -height / 2 + 160])
  translate([x * (width - tube) / 2, y, 0]) block([tube - 6, tube, depth - tube], 3);
for (z = [-1, 1], y = [height / 2 - tube / 2, -height / 2 + 160])
  translate([0, y, z * (depth - tube) / 2]) block([width - tube, tube, tube - 6], 3);
translate([0, 60, 0]) block([width - tube, height - 260, depth - tube], 2);
