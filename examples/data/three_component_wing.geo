// Cross-section of a wing with its high-lift devices out: slat, main element and flap with sharp trailing edges, in a
// rectangular box of air. Element size 1 on the three parts, 2 on the box.
wing_size = 1;
box_size = 2;

// One part: two B-splines (upper and lower side) from the round nose to the sharp trailing edge.
// Reads: p (first number), chord, thickness and camber (relative to the chord), angle (degrees; positive puts the nose
// below the trailing edge), nose_x, nose_y.
Macro Airfoil
  x[] = {0, 0, 0.22, 0.60, 1};       // along the chord, nose to trailing edge
  half[] = {0, 0.54, 0.95, 0.36, 0}; // half thickness at x, in units of the thickness
  c = Cos(angle * Pi / 180);
  s = Sin(angle * Pi / 180);
  For side In {0 : 1}
    For k In {0 : 4}
      across = chord * (4 * camber * x[k] * (1 - x[k]) + (1 - 2 * side) * thickness * half[k]);
      along = chord * x[k];
      If (side == 0 || (k > 0 && k < 4))
        Point(p + 10 * side + k) = {nose_x + c * along - s * across, nose_y + s * along + c * across, 0, wing_size};
      EndIf
    EndFor
  EndFor
  BSpline(p) = {p, p + 1, p + 2, p + 3, p + 4};
  BSpline(p + 1) = {p + 4, p + 13, p + 12, p + 11, p};
  Curve Loop(p) = {p, p + 1};
Return

p = 100; chord = 22; thickness = 0.25; camber = 0.08; angle = 32; nose_x = 40.5; nose_y = 42.5;
Call Airfoil;
p = 200; chord = 72; thickness = 0.15; camber = 0.03; angle = 0; nose_x = 59; nose_y = 62.5;
Call Airfoil;
p = 300; chord = 32; thickness = 0.19; camber = 0.04; angle = -30; nose_x = 127; nose_y = 54.5;
Call Airfoil;

Point(1) = {0, 0, 0, box_size};
Point(2) = {210, 0, 0, box_size};
Point(3) = {210, 120, 0, box_size};
Point(4) = {0, 120, 0, box_size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};

Plane Surface(1) = {1, 100, 200, 300};
Physical Curve("inflow") = {4};
Physical Curve("outflow") = {2};
Physical Curve("far_field") = {1, 3};
Physical Curve("slat") = {100, 101};
Physical Curve("main") = {200, 201};
Physical Curve("flap") = {300, 301};
Physical Surface("air") = {1};
