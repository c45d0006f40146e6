// Bellows coupling: two clamping hubs with a screw, ripples between.
use <common.scad>
diameter = 50;
length = 50;
lathe(concat([[0, -length / 2], [diameter / 2 - 1, -length / 2], [diameter / 2, -length / 2 + 1], [diameter / 2, -10]],
  [for (i = [0:2]) for (p = [[0.36, 0.1], [0.36, 0.35], [0.47, 0.6], [0.47, 0.85]]) [p[0] * diameter, -10 + (i + p[1]) * 20 / 3]],
  [[diameter / 2, 10], [diameter / 2, length / 2 - 1], [diameter / 2 - 1, length / 2], [0, length / 2]]), 20);
