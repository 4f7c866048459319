// A bend of 180 degrees, 30 elements wide, with arms 50 elements long. Tilted as square_line.geo is.

c = Cos(0.5);
s = Sin(0.5);
Point(1) = {-40, -50 * c, -50 * s, 1};
Point(2) = {-10, -50 * c, -50 * s, 1};
Point(3) = {-10, 0, 0, 1};
Point(4) = {0, 10 * c, 10 * s, 1};
Point(5) = {10, 0, 0, 1};
Point(6) = {10, -50 * c, -50 * s, 1};
Point(7) = {40, -50 * c, -50 * s, 1};
Point(8) = {40, 0, 0, 1};
Point(9) = {0, 40 * c, 40 * s, 1};
Point(10) = {-40, 0, 0, 1};
Point(11) = {0, 0, 0, 1};
Line(1) = {1, 2};
Line(2) = {2, 3};
Circle(3) = {3, 11, 4};
Circle(4) = {4, 11, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 8};
Circle(8) = {8, 11, 9};
Circle(9) = {9, 11, 10};
Line(10) = {10, 1};
Curve Loop(1) = {1 : 10};
Plane Surface(1) = {1};
