// A square of 100 x 100 elements with a line inside at 30 degrees to its sides. It is tilted, so that it is read as a
// surface, which elements of equal areas or of right angles can be asked for.

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

dx = 25 * Cos(Pi / 6);
dy = 25 * Sin(Pi / 6);
Point(5) = {50 - dx, (50 - dy) * c, (50 - dy) * s, 1};
Point(6) = {50 + dx, (50 + dy) * c, (50 + dy) * s, 1};
Line(5) = {5, 6};
Line{5} In Surface{1};
