// Blade of the drum in its clamping bar: the edge is below, at -y.
use <common.scad>
thick = 22;
height = 30;
width = 400;
screws = 8;
rotate([0, 0, 180]) {
  linear_extrude(width, center = true)
    polygon([[-1, height / 2], [-4.5, 2], [-4.5, -height / 2], [3, -height / 2], [3, 2]]);
  linear_extrude(width - 8, center = true)
    polygon([[2.5, 3], [5, 3], [11, -6], [11, -height / 2], [2.5, -height / 2]]);
  linear_extrude(width - 8, center = true)
    polygon([[-4, -4], [-11, -8], [-11, -height / 2], [-4, -height / 2]]);
  for (i = [0:screws - 1]) translate([8, -1.5, width * ((i + 0.5) / screws - 0.5)])
    rotate([0, 90, -50]) cylinder(d = 9, h = 7, $fn = 6, center = true);
}
