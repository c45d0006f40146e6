// Drum of a rotary knife: a thick tube on two spoked ends, with a clamping flat along the blade's seat.
use <common.scad>
diameter = 143;
width = 400;
spokes = 6;
end = 22;  // thickness of a spoked end

module end_plate() {
  linear_extrude(end) difference() {
    circle(d = diameter - 12, $fn = 40);
    for (i = [0:spokes - 1]) rotate(360 * (i + 0.5) / spokes) translate([diameter * 0.3, 0]) circle(d = 26, $fn = 8);
  }
  translate([0, 0, end - 10]) bolts(diameter * 0.3, spokes, 9, 16);
}

lathe([[diameter / 2 - 16, -width / 2 + 4], [diameter / 2 - 2, -width / 2], [diameter / 2, -width / 2 + 2],
       [diameter / 2, width / 2 - 2], [diameter / 2 - 2, width / 2], [diameter / 2 - 16, width / 2 - 4]], 44);
for (side = [0, 1]) mirror([0, 0, side]) translate([0, 0, width / 2 - end - 8]) end_plate();
lathe([[0, -width / 2], [30, -width / 2], [34, -width / 2 + 5], [34, width / 2 - 5], [30, width / 2], [0, width / 2]], 14);
