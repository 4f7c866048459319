// An annulus with element size 2 on the inner circle and 1 on the outer one.
inner_radius = 8;
outer_radius = 28;
Point(1) = {0, 0, 0};

For i In {0 : 3}
  angle = i * Pi / 2;
  Point(10 + i) = {inner_radius * Cos(angle), inner_radius * Sin(angle), 0, 2};
  Point(20 + i) = {outer_radius * Cos(angle), outer_radius * Sin(angle), 0, 1};
EndFor
For i In {0 : 3}
  next = (i + 1) % 4;
  Circle(10 + i) = {10 + i, 1, 10 + next};
  Circle(20 + i) = {20 + i, 1, 20 + next};
EndFor

Curve Loop(1) = {20 : 23};
Curve Loop(2) = {10 : 13};
Plane Surface(1) = {1, 2};
Physical Curve("inner") = {10 : 13};
Physical Curve("outer") = {20 : 23};
Physical Surface("annulus") = {1};
