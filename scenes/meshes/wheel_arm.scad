// Arm that presses the measuring wheel on the web: bored at both ends.
use <common.scad>
length = 260;
height = 25;
thick = 20;
linear_extrude(thick, center = true) difference() {
  hull() for (x = [-1, 1]) translate([x * (length - height) / 2, 0]) circle(d = height, $fn = 24);
  hull() for (x = [-1, 1]) translate([x * length * 0.3, 0]) circle(d = height * 0.4, $fn = 16);
  translate([-(length - height) / 2, 0]) circle(d = height * 0.4, $fn = 16);
}
