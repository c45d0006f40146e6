// Flanged guide bush; the axis is z.
use <common.scad>
diameter = 110;
length = 240;
lathe([[30, -length / 2], [44, -length / 2], [44, -length / 2 + 26], [diameter / 2, -length / 2 + 28], [diameter / 2, -length / 2 + 46],
       [44, -length / 2 + 48], [44, length / 2 - 48], [diameter / 2, length / 2 - 46], [diameter / 2, length / 2 - 28],
       [44, length / 2 - 26], [44, length / 2], [30, length / 2]]);
