// Back plate of the knife: carries bearing and gearbox; ribbed, with lightening slots.
use <common.scad>
width = 260;
height = 530;
depth = 30;
translate([0, 0, -depth / 6]) linear_extrude(depth * 2 / 3, center = true) difference() {
  rounded(width, height, 14);
  for (y = [-190, 190]) translate([0, y]) rounded(width - 90, 70, 20);
}
for (x = [-1, 1]) translate([x * (width / 2 - 14), 0, 0]) block([16, height - 40, depth], 3);
translate([0, 0, depth / 6]) bolts(88, 8, 16, 10, 22.5);
