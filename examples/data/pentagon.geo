// A regular pentagon with corners at distance 10 from the centre. It prescribes no sizes: frames along the sides alone
// force one irregular vertex of valence 5.
radius = 10;
For i In {0 : 4}
  angle = (2 * i / 5 + 1 / 2) * Pi;
  Point(1 + i) = {radius * Cos(angle), radius * Sin(angle), 0};
EndFor
For i In {0 : 4}
  Line(1 + i) = {1 + i, 1 + (i + 1) % 5};
EndFor
Curve Loop(1) = {1 : 5};
Plane Surface(1) = {1};
Physical Curve("outline") = {1 : 5};
Physical Surface("pentagon") = {1};
