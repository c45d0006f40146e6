// Slotted disc of an incremental encoder, with hub and one index window.
use <common.scad>
diameter = 110;
thick = 8;
slots = 24;
linear_extrude(3, center = true) difference() {
  circle(d = diameter, $fn = 48);
  for (i = [0:slots - 1]) rotate(360 * i / slots) translate([diameter / 2 - 9, 0]) square([10, 3.6], center = true);
  translate([0, diameter / 2 - 21]) square([6, 8], center = true);
  for (i = [0:4]) rotate(72 * i + 36) translate([diameter * 0.22, 0]) circle(d = 13, $fn = 10);
}
rod(32, thick, 1, 24);
