// End block of a linear axis: bearing seat for the screw, two screws in the foot.
use <common.scad>
width = 30;
height = 100;
depth = 150;
rotate([0, 90, 0]) linear_extrude(width, center = true) difference() {
  polygon([[-depth / 2, -height / 2], [depth / 2, -height / 2], [depth / 2, height * 0.05], [depth * 0.28, height / 2 - 3],
           [depth * 0.25, height / 2], [-depth * 0.25, height / 2], [-depth * 0.28, height / 2 - 3], [-depth / 2, height * 0.05]]);
  for (x = [-1, 1]) translate([x * depth * 0.36, -height * 0.14]) circle(d = 14, $fn = 18);
}
