// Induction motor: round ribbed housing, end shields, fan cover with slots, terminal box. The shaft is at +z.
use <common.scad>
diameter = 180;
length = 260;
ribs = 12;
core = diameter * 0.86;
translate([0, 0, -10]) linear_extrude(length - 70, center = true) {
  circle(d = core, $fn = 28);
  for (i = [0:ribs - 1]) rotate(360 * i / ribs) translate([core / 2, 0]) square([(diameter - core) - 4, 4], center = true);
}
lathe([[0, -length / 2], [diameter / 2 - 10, -length / 2], [diameter / 2, -length / 2 + 8],
       [diameter / 2, -length / 2 + 48], [core / 2, -length / 2 + 50], [core / 2, length / 2 - 46],
       [diameter / 2, length / 2 - 44], [diameter / 2, length / 2 - 28], [diameter / 2 - 8, length / 2 - 26],
       [46, length / 2 - 14], [16, length / 2 - 14], [16, length / 2], [0, length / 2]]);
translate([0, 0, length / 2 - 30]) bolts(diameter / 2 - 12, 6, 12, 6);
