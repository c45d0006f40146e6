// What several parts are made of. Millimetres; rotating parts have their axis along z.

// A box about the origin with broken edges.
module block(size, c = 2) {
  hull() {
    cube([size[0], size[1] - 2 * c, size[2] - 2 * c], center = true);
    cube([size[0] - 2 * c, size[1], size[2] - 2 * c], center = true);
    cube([size[0] - 2 * c, size[1] - 2 * c, size[2]], center = true);
  }
}

// A turned part: its half section as [radius, z].
module lathe(section, n = 26) { rotate_extrude($fn = n) polygon(section); }

// A cylinder about the origin with broken edges.
module rod(d, length, c = 1, n = 26) {
  lathe([[0, -length / 2], [d / 2 - c, -length / 2], [d / 2, -length / 2 + c], [d / 2, length / 2 - c],
         [d / 2 - c, length / 2], [0, length / 2]], n);
}

// Hexagon heads on a circle of radius r, standing on z = 0.
module bolts(r, n, d, height, first = 0) {
  for (i = [0:n - 1]) rotate(first + 360 * i / n) translate([r, 0, 0]) cylinder(d = d, h = height, $fn = 6);
}

// Children at the four corners of a rectangle.
module corners(x, y) { for (sx = [-1, 1], sy = [-1, 1]) translate([sx * x, sy * y, 0]) children(); }

module rounded(x, y, r) { offset(r = r, $fn = 8) square([x - 2 * r, y - 2 * r], center = true); }
