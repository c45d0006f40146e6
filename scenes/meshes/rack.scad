// Rack along x, teeth upwards.
length = 1000;
height = 30;
width = 40;
teeth = 50;
pitch = length / teeth;
linear_extrude(width, center = true)
  polygon(concat([[-length / 2, -height / 2]], [for (i = [0:teeth - 1]) for (p = [[0.05, 7], [0.3, 15], [0.6, 15], [0.85, 7]])
    [-length / 2 + (i + p[0]) * pitch, p[1]]], [[length / 2, 7], [length / 2, -height / 2]]));
