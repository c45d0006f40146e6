// Shaft of the drum: stepped, with a centre hole and a keyway at each end.
use <common.scad>
diameter = 50;
length = 460;
module end() {
  difference() {
    lathe([[0, 0], [diameter / 2, 0], [diameter / 2, 22], [diameter * 0.4, 24], [diameter * 0.4, length / 2 - 2],
           [diameter * 0.4 - 2, length / 2], [0, length / 2]], 24);
    translate([-5, diameter * 0.28, length / 2 - 22]) cube([10, 20, 30]);
    translate([0, 0, length / 2 - 6]) cylinder(d1 = 2, d2 = 14, h = 8, $fn = 24);
  }
}
end();
mirror([0, 0, 1]) end();
