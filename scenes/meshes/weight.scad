// Stack of weight plates.
use <common.scad>
width = 200;
height = 100;
depth = 200;
plates = 4;
for (i = [0:plates - 1]) translate([0, height * ((i + 0.5) / plates - 0.5), 0])
  block([width, height / plates - 2, depth], 3);
cube([width * 0.5, height, depth * 0.5], center = true);
