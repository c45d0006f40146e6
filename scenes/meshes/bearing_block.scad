// Plummer block: foot with two bolts, round housing, cover with screws on both sides. The bore is the origin.
use <common.scad>
width = 150;
height = 120;
depth = 50;
bore = 42;
linear_extrude(depth - 8, center = true) difference() {
  union() {
    circle(d = 104, $fn = 24);
    translate([-width / 2, -height / 2]) square([width, 22]);
    polygon([[-66, -39], [66, -39], [40, 0], [-40, 0]]);
    translate([-16, 40]) square([32, height / 2 - 40]);
  }
  circle(d = bore, $fn = 36);
}
for (side = [0, 1]) mirror([0, 0, side]) translate([0, 0, depth / 2 - 5]) {
  linear_extrude(3) difference() { circle(d = 84, $fn = 24); circle(d = bore, $fn = 36); }
  bolts(34, 5, 8, 5);
}
for (x = [-58, 58]) translate([x, -height / 2 + 20, 0]) rotate([-90, 0, 0]) cylinder(d = 18, h = 10, $fn = 6);
