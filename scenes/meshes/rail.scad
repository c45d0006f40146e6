// Profiled guide rail along x, waisted.
length = 1000;
height = 30;
width = 24;
rotate([0, 90, 0]) linear_extrude(length, center = true)
  polygon([[-12, -15], [12, -15], [12, -4], [8, 1], [8, 4], [12, 9], [12, 13], [10, 15], [-10, 15], [-12, 13],
           [-12, 9], [-8, 4], [-8, 1], [-12, -4]]);
