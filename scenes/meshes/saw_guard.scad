// Guard over the upper half of the blade, whose axis is x: a shell, its face ring-shaped, open below.
diameter = 330;
height = 174;
width = 34;
below = height - diameter / 2;  // how far it goes below the axis
module upper() {
  intersection() {
    children();
    translate([-diameter, -below]) square([2 * diameter, diameter]);
  }
}
rotate([0, 90, 0]) {
  linear_extrude(width, center = true) upper() difference() {
    circle(d = diameter, $fn = 60);
    circle(d = diameter - 8, $fn = 60);
  }
  translate([0, 0, -width / 2]) linear_extrude(3) upper() difference() {
    circle(d = diameter - 2, $fn = 60);
    circle(d = diameter * 0.62, $fn = 40);
  }
}
