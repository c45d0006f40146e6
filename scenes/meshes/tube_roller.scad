// Roller on which a tube runs: waisted, on a shaft along z.
use <common.scad>
diameter = 90;
waist = 60;
width = 160;
lathe([[0, -width / 2], [9, -width / 2], [10, -width / 2 + 1], [10, -width / 2 + 12], [diameter / 2 - 2, -width / 2 + 12],
       [diameter / 2, -width / 2 + 14], [diameter / 2, -width / 2 + 26], [waist / 2, -14], [waist / 2, 14],
       [diameter / 2, width / 2 - 26], [diameter / 2, width / 2 - 14], [diameter / 2 - 2, width / 2 - 12],
       [10, width / 2 - 12], [10, width / 2 - 1], [9, width / 2], [0, width / 2]]);
