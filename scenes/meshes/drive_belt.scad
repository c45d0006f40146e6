// Endless toothed belt round two pulleys along x; their axes are y. It is wider at -x, round the larger pulley.
length = 440;
width = 30;
large = 180;
small = 110;
thick = 6;
module loop(more) {
  hull() {
    translate([-length / 2 + large / 2, 0]) circle(d = large + more, $fn = 32);
    translate([length / 2 - small / 2, 0]) circle(d = small + more, $fn = 32);
  }
}
rotate([90, 0, 0]) linear_extrude(width, center = true) difference() { loop(0); loop(-2 * thick); }
