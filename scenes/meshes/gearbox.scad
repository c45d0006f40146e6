// Coaxial planetary gearbox: output flange, housing, ring of bolts, input bell. The output is at +z.
use <common.scad>
diameter = 130;
length = 120;
lathe([[0, length / 2], [38, length / 2], [40, length / 2 - 6], [diameter / 2 - 2, length / 2 - 6],
       [diameter / 2, length / 2 - 8], [diameter / 2, length / 2 - 20], [diameter / 2 - 7, length / 2 - 22],
       [diameter / 2 - 7, -10], [diameter / 2 - 2, -12], [diameter / 2 - 2, -26], [diameter / 2 - 12, -30],
       [diameter / 2 - 12, -length / 2 + 12], [diameter / 2 - 4, -length / 2 + 10], [diameter / 2 - 4, -length / 2],
       [0, -length / 2]]);
translate([0, 0, length / 2 - 8]) bolts(54, 8, 10, 7);
