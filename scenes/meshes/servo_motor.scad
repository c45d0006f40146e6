// Servo motor: square body with cooling fins, flange with four bolts, plug on top. The shaft is at +z.
use <common.scad>
width = 140;
length = 200;
fins = 7;
body = width - 34;
top = 34 - 17;  // the plug stands out of the body
translate([0, -top / 2, 0]) {
  translate([0, 0, length / 2 - 20 - 9]) block([width, width - top, 18], 3);
  translate([0, 0, -14]) block([body, body, length - 34], 8);
  for (i = [0:fins - 1], side = [-1, 1]) translate([side * body / 2, body * ((i + 0.5) / fins - 0.5) * 0.86, -2])
    cube([10, 6, length - 80], center = true);
  for (i = [0:fins - 1]) translate([body * ((i + 0.5) / fins - 0.5) * 0.86, -body / 2, -2])
    cube([6, 10, length - 80], center = true);
  translate([0, 0, length / 2 - 22]) cylinder(d = 80, h = 12, $fn = 48);
  cylinder(d = 24, h = length / 2, $fn = 24);
  translate([0, 0, length / 2 - 32]) corners(width / 2 - 14, (width - top) / 2 - 12) cylinder(d = 15, h = 9, $fn = 6);
  translate([0, body / 2 + 8, -length / 2 + 45]) block([40, 34, 46], 4);
  translate([0, body / 2 + 12, -length / 2 + 22]) cylinder(d = 22, h = 30, $fn = 24, center = true);
}
translate([0, 0, -length / 2 + 6]) block([width * 0.6, width * 0.6, 12], 4);
