// A square with a tilted square hole: element size 1 on the hole and 2 on the outside.
outer_side = 70;
inner_side = 24;
tilt = 25 * Pi / 180;

For i In {0 : 3}
  angle = (2 * i + 1) * Pi / 4;
  Point(10 + i) = {outer_side / Sqrt(2) * Cos(angle), outer_side / Sqrt(2) * Sin(angle), 0, 2};
  Point(20 + i) = {inner_side / Sqrt(2) * Cos(angle + tilt), inner_side / Sqrt(2) * Sin(angle + tilt), 0, 1};
EndFor
For i In {0 : 3}
  next = (i + 1) % 4;
  Line(10 + i) = {10 + i, 10 + next};
  Line(20 + i) = {20 + i, 20 + next};
EndFor

Curve Loop(1) = {10 : 13};
Curve Loop(2) = {20 : 23};
Plane Surface(1) = {1, 2};
Physical Curve("outer") = {10 : 13};
Physical Curve("inner") = {20 : 23};
Physical Surface("plate") = {1};
