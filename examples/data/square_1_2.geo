// A square of side 20 with element size 1 along the bottom and 2 along the top, linear on the sides.
Point(1) = {0, 0, 0, 1};
Point(2) = {20, 0, 0, 1};
Point(3) = {20, 20, 0, 2};
Point(4) = {0, 20, 0, 2};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Physical Curve("bottom") = {1};
Physical Curve("right") = {2};
Physical Curve("top") = {3};
Physical Curve("left") = {4};
Physical Surface("square") = {1};
