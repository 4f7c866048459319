// A disk of radius 10 with a curved line inside that element edges have to follow. It prescribes no sizes: elements that
// are thin across boundary and line come from --anisotropic --size boundary=0.15x1.5 --size feature=0.15x1.5.
R = 10;
Point(1) = {0, 0, 0};
Point(2) = {R, 0, 0};
Point(3) = {0, R, 0};
Point(4) = {-R, 0, 0};
Point(5) = {0, -R, 0};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 2};
Point(11) = {-6, -1.5, 0};
Point(12) = {-3, 1, 0};
Point(13) = {3, -1, 0};
Point(14) = {6, 1.5, 0};
Spline(5) = {11, 12, 13, 14};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Curve{5} In Surface{1};
Physical Curve("boundary") = {1, 2, 3, 4};
Physical Curve("feature") = {5};
Physical Surface("disk") = {1};
