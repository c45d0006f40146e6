// Pneumatic cylinder: profiled barrel between two covers with tie rods; the axis is z.
use <common.scad>
diameter = 50;
length = 100;
linear_extrude(length - 30, center = true) difference() {
  rounded(diameter - 6, diameter - 6, 10);
  for (a = [0:90:270]) rotate(a) translate([diameter / 2 - 3, 0]) square([7, 9], center = true);
}
for (z = [-1, 1]) translate([0, 0, z * (length / 2 - 9)]) block([diameter, diameter, 18], 2.5);
corners(diameter / 2 - 7, diameter / 2 - 7) cylinder(d = 7, h = length, $fn = 6, center = true);
cylinder(d = diameter * 0.5, h = length, $fn = 24, center = true);
