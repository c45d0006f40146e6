// Anvil roll: ground body, stepped journals.
use <common.scad>
diameter = 160;
width = 400;
body = width - 60;
lathe([[0, -width / 2], [22, -width / 2], [24, -width / 2 + 2], [24, -width / 2 + 16], [34, -width / 2 + 16],
       [34, -body / 2], [diameter / 2 - 4, -body / 2], [diameter / 2, -body / 2 + 4], [diameter / 2, body / 2 - 4],
       [diameter / 2 - 4, body / 2], [34, body / 2], [34, width / 2 - 16], [24, width / 2 - 16],
       [24, width / 2 - 2], [22, width / 2], [0, width / 2]], 36);
