// Circular saw blade: raked teeth, expansion slots, clamping flange. The axis is z.
use <common.scad>
diameter = 300;
thick = 5;
teeth = 36;
inner = diameter / 2 - 9;
linear_extrude(thick * 0.6, center = true) difference() {
  polygon([for (i = [0:teeth - 1]) for (p = [[0, inner], [0.1, diameter / 2], [0.35, diameter / 2 - 1.5], [0.75, inner]])
    p[1] * [cos(360 * (i + p[0]) / teeth), sin(360 * (i + p[0]) / teeth)]]);
  for (i = [0:5]) rotate(60 * i) {
    translate([diameter / 2 - 30, 0]) square([60, 2], center = true);
    translate([diameter / 2 - 60, 0]) circle(d = 8, $fn = 6);
    rotate(30) translate([diameter * 0.26, 0]) circle(d = 26, $fn = 10);
  }
}
rod(92, thick, 0.8, 32);
