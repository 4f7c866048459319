// A square of 100 x 100 elements with a curve inside that is shaped like an S. Tilted as square_line.geo is.

c = Cos(0.5);
s = Sin(0.5);
Point(1) = {0, 0, 0, 1};
Point(2) = {100, 0, 0, 1};
Point(3) = {100, 100 * c, 100 * s, 1};
Point(4) = {0, 100 * c, 100 * s, 1};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

Point(5) = {22, 50 * c, 50 * s, 1};
Point(6) = {30, 38 * c, 38 * s, 1};
Point(7) = {40, 40 * c, 40 * s, 1};
Point(8) = {50, 50 * c, 50 * s, 1};
Point(9) = {60, 60 * c, 60 * s, 1};
Point(10) = {70, 62 * c, 62 * s, 1};
Point(11) = {78, 50 * c, 50 * s, 1};
Spline(5) = {5 : 11};
Line{5} In Surface{1};
