// Roller with stepped journals.
use <common.scad>
diameter = 140;
width = 345;
body = width - 44;
lathe([[0, -width / 2], [16, -width / 2], [18, -width / 2 + 2], [18, -width / 2 + 12], [26, -width / 2 + 12],
       [26, -body / 2 + 5], [diameter / 2 - 14, -body / 2 + 5], [diameter / 2 - 10, -body / 2],
       [diameter / 2 - 3, -body / 2], [diameter / 2, -body / 2 + 3], [diameter / 2, body / 2 - 3],
       [diameter / 2 - 3, body / 2], [diameter / 2 - 10, body / 2], [diameter / 2 - 14, body / 2 - 5],
       [26, body / 2 - 5], [26, width / 2 - 12], [18, width / 2 - 12], [18, width / 2 - 2], [16, width / 2],
       [0, width / 2]], 28);
