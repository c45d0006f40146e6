// Carriage plate: pockets and bolt heads on its top, four guide blocks below.
use <common.scad>
length = 360;
height = 50;
width = 360;
plate = 26;
difference() {
  translate([0, (height - plate) / 2, 0]) block([length, plate, width], 3);
  for (x = [-1, 1], z = [-1, 1]) translate([x * length * 0.25, height / 2 - 4, z * width * 0.24]) rotate([-90, 0, 0])
    linear_extrude(10) rounded(length * 0.32, width * 0.30, 10);
}
for (x = [-1, 1], z = [-1, 1]) translate([x * length * 0.33, -plate / 2, z * width * 0.36])
  block([length * 0.24, height - plate + 2, width * 0.2], 2);
for (x = [-0.44, 0, 0.44], z = [-0.44, 0.44]) translate([x * length, height / 2 - 4, z * width])
  rotate([-90, 0, 0]) cylinder(d = 15, h = 4.01, $fn = 6);
