// A shell: the outside winds up in four quarter circles whose centres move by `growth` each, a straight step leads back
// to the start, and a round hole is cut out. Element size 1 everywhere. Smooth cross fields have a limit cycle here.
start_radius = 23;
growth = 3.5;
hole_radius = 11;

Point(1) = {0, 0, 0, 1};
Point(2) = {0, growth, 0, 1};
Point(3) = {-growth, growth, 0, 1};
Point(4) = {-growth, 0, 0, 1};
Point(5) = {-start_radius, 0, 0, 1};
Point(6) = {0, -start_radius, 0, 1};
Point(7) = {start_radius + growth, growth, 0, 1};
Point(8) = {-growth, start_radius + 3 * growth, 0, 1};
Point(9) = {-start_radius - 4 * growth, 0, 0, 1};
Circle(1) = {5, 1, 6};
Circle(2) = {6, 2, 7};
Circle(3) = {7, 3, 8};
Circle(4) = {8, 4, 9};
Line(5) = {9, 5};

Point(10) = {hole_radius, 0, 0, 1};
Point(11) = {0, hole_radius, 0, 1};
Point(12) = {-hole_radius, 0, 0, 1};
Point(13) = {0, -hole_radius, 0, 1};
Circle(6) = {10, 1, 11};
Circle(7) = {11, 1, 12};
Circle(8) = {12, 1, 13};
Circle(9) = {13, 1, 10};

Curve Loop(1) = {1 : 5};
Curve Loop(2) = {6 : 9};
Plane Surface(1) = {1, 2};
Physical Curve("spiral") = {1 : 4};
Physical Curve("step") = {5};
Physical Curve("hole") = {6 : 9};
Physical Surface("shell") = {1};
