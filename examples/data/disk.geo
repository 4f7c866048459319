// A disk of radius 15 with element size 1.
radius = 15;
Point(1) = {0, 0, 0, 1};
Point(2) = {radius, 0, 0, 1};
Point(3) = {0, radius, 0, 1};
Point(4) = {-radius, 0, 0, 1};
Point(5) = {0, -radius, 0, 1};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Physical Curve("circle") = {1, 2, 3, 4};
Physical Surface("disk") = {1};
