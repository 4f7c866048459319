// A rectangular plate with four round holes: element size 0.9 on the outline and finer on the holes.
Point(1) = {0, 0, 0, 0.9};
Point(2) = {54, 0, 0, 0.9};
Point(3) = {54, 30, 0, 0.9};
Point(4) = {0, 30, 0, 0.9};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};

centre_x[] = {12, 30, 44, 25};
centre_y[] = {15, 20, 9, 7};
radius[] = {6, 4, 4.5, 2.5};
size[] = {0.6, 0.5, 0.6, 0.4};
For i In {0 : 3}
  p = 10 * (i + 1);
  Point(p) = {centre_x[i], centre_y[i], 0, size[i]};
  Point(p + 1) = {centre_x[i] + radius[i], centre_y[i], 0, size[i]};
  Point(p + 2) = {centre_x[i], centre_y[i] + radius[i], 0, size[i]};
  Point(p + 3) = {centre_x[i] - radius[i], centre_y[i], 0, size[i]};
  Point(p + 4) = {centre_x[i], centre_y[i] - radius[i], 0, size[i]};
  Circle(p + 1) = {p + 1, p, p + 2};
  Circle(p + 2) = {p + 2, p, p + 3};
  Circle(p + 3) = {p + 3, p, p + 4};
  Circle(p + 4) = {p + 4, p, p + 1};
  Curve Loop(i + 2) = {(p + 1) : (p + 4)};
EndFor

Plane Surface(1) = {1 : 5};
Physical Curve("clamped") = {4};
Physical Curve("pulled") = {2};
Physical Curve("free") = {1, 3};
Physical Curve("bolt_holes") = {11 : 14, 21 : 24, 31 : 34, 41 : 44};
Physical Surface("plate") = {1};
