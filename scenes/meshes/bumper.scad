// Rubber bumper: a stepped buffer, its face at +z.
use <common.scad>
diameter = 60;
length = 60;
lathe([[0, -length / 2], [diameter / 2, -length / 2], [diameter / 2, -length / 2 + 8], [diameter * 0.40, -length / 2 + 10],
       [diameter * 0.44, 0], [diameter * 0.38, length / 2 - 8], [diameter * 0.26, length / 2 - 1], [0, length / 2]], 36);
