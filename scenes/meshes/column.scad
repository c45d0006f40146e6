// Welded column, rib in front, gussets at the foot, a window.
use <common.scad>
width = 300;
height = 650;
depth = 60;
linear_extrude(depth * 0.5, center = true) difference() {
  polygon([[-width / 2, -height / 2], [width / 2, -height / 2], [width / 2, -height / 2 + 60], [width * 0.3, -height * 0.12],
           [width * 0.3, height / 2 - 14], [width * 0.26, height / 2], [-width * 0.26, height / 2], [-width * 0.3, height / 2 - 14],
           [-width * 0.3, -height * 0.12], [-width / 2, -height / 2 + 60]]);
  for (y = [-0.22, 0.3]) translate([0, y * height]) rounded(width * 0.3, height * 0.16, 22);
}
for (x = [-1, 1]) translate([x * width * 0.26, height * 0.06, 0]) block([18, height * 0.86, depth], 3);
translate([0, -height / 2 + 9, 0]) block([width, 18, depth], 3);
translate([0, height / 2 - 8, 0]) block([width * 0.56, 16, depth], 3);
