// Toothed belt pulley with flanges and holes in its web; the axis is z.
use <common.scad>
diameter = 180;
width = 70;
teeth = 22;
rim = diameter / 2 - 6;
linear_extrude(width - 10, center = true) difference() {
  polygon([for (i = [0:teeth - 1]) for (p = [[0, rim - 4], [0.3, rim - 4], [0.4, rim], [0.9, rim]])
    p[1] * [cos(360 * (i + p[0]) / teeth), sin(360 * (i + p[0]) / teeth)]]);
  for (i = [0:3]) rotate(90 * i) translate([diameter * 0.29, 0]) circle(d = diameter * 0.16, $fn = 10);
}
for (z = [-1, 1]) translate([0, 0, z * (width / 2 - 3)]) linear_extrude(6, center = true) difference() {
  circle(d = diameter, $fn = 28);
  circle(d = diameter * 0.8, $fn = 28);
}
rod(diameter * 0.32, width, 2, 36);
