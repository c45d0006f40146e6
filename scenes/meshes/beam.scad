// Extruded beam along x with T-slots above, below and at the sides.
use <common.scad>
length = 1000;
height = 120;
width = 340;
module slot(depth) { translate([-4, 0]) square([8, depth]); translate([-8, 0]) translate([0, depth - 7]) square([16, 7]); }
rotate([0, 90, 0]) linear_extrude(length, center = true) difference() {
  rounded(width, height, 5);
  for (x = [-0.36, -0.18, 0, 0.18, 0.36], side = [0, 1])
    mirror([0, side]) translate([x * width, -height / 2 - 1]) scale([2, 1]) slot(20);
  for (y = [-0.25, 0.25], side = [0, 1])
    mirror([side, 0]) translate([-width / 2 - 1, y * height]) rotate(-90) slot(22);
}
