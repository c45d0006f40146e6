// Spindle with its thread as close ridges, bare ends.
length = 1000;
diameter = 30;
ridges = 24;
bare = length * 0.03;
step = (length - 2 * bare) / ridges;
rotate_extrude($fn = 10) polygon(concat([[0, -length / 2], [11, -length / 2], [11, -length / 2 + bare]],
  [for (i = [0:ridges - 1]) for (p = [[12, 0.1], [15, 0.5], [12, 0.9]]) [p[0], -length / 2 + bare + (i + p[1]) * step]],
  [[11, length / 2 - bare], [11, length / 2], [0, length / 2]]));
