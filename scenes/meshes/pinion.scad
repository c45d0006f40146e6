// Pinion with straight teeth and a hub.
use <common.scad>
diameter = 80;
width = 40;
teeth = 18;
inner = diameter / 2 - 6;
linear_extrude(width - 8, center = true) difference() {
  polygon([for (i = [0:teeth - 1]) for (p = [[0, inner], [0.22, inner], [0.36, diameter / 2], [0.64, diameter / 2], [0.78, inner]])
    p[1] * [cos(360 * (i + p[0]) / teeth), sin(360 * (i + p[0]) / teeth)]]);
  for (i = [0:3]) rotate(90 * i + 45) translate([20, 0]) circle(d = 11, $fn = 16);
}
rod(24, width, 1, 24);
