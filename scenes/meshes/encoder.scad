// Encoder: cup with cover and cable outlet; the machine is at +z.
use <common.scad>
diameter = 90;
length = 50;
lathe([[0, -length / 2], [diameter * 0.30, -length / 2], [diameter * 0.40, -length / 2 + 4],
       [diameter * 0.42, length / 2 - 12], [diameter / 2, length / 2 - 11], [diameter / 2, length / 2], [0, length / 2]]);
translate([0, diameter * 0.40, -length / 2 + 18]) rotate([-90, 0, 0]) cylinder(d = 15, h = diameter * 0.10, $fn = 6);
translate([0, 0, length / 2 - 12]) bolts(diameter * 0.455, 3, 6, 5, 30);
mirror([0, 0, 1]) translate([0, 0, length / 2 - 2]) bolts(diameter * 0.24, 4, 5, 2);
