// Bolster plate with three T-slots.
width = 840;
height = 50;
depth = 520;
rotate([0, 90, 0]) linear_extrude(width, center = true) difference() {
  translate([-depth / 2, -height / 2]) square([depth, height]);
  for (x = [-0.3, 0, 0.3]) translate([x * depth, height / 2]) {
    translate([-9, -20]) square([18, 21]);
    translate([-16, -32]) square([32, 14]);
  }
}
