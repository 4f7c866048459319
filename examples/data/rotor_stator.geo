// One sixth of an electric machine: rotor and stator with their slots as holes, bounded by radii.
// Element size 1 on the inner and outer arcs, 0.3 on all other curves; the radii grow to 1 at their ends.
sector = Pi / 3;
shaft_radius = 10;
yoke_radius = 26;
fine = 0.3;
coarse = 1;
transition = 2.5; // length along a radius over which the size goes from coarse to fine
Point(1) = {0, 0, 0};

// The outline, counterclockwise: first radius, outer arc, second radius, inner arc.
For side In {0 : 1}
  c = Cos(side * sector);
  s = Sin(side * sector);
  p = 10 * (side + 1);
  Point(p) = {shaft_radius * c, shaft_radius * s, 0, coarse};
  Point(p + 1) = {(shaft_radius + transition) * c, (shaft_radius + transition) * s, 0, fine};
  Point(p + 2) = {(yoke_radius - transition) * c, (yoke_radius - transition) * s, 0, fine};
  Point(p + 3) = {yoke_radius * c, yoke_radius * s, 0, coarse};
  Line(p) = {p, p + 1};
  Line(p + 1) = {p + 1, p + 2};
  Line(p + 2) = {p + 2, p + 3};
EndFor
Circle(1) = {13, 1, 23};
Circle(2) = {10, 1, 20};
Curve Loop(1) = {10, 11, 12, 1, -22, -21, -20, -2};

// Slots: annular sectors [r0, r1] x [angle - half_width, angle + half_width]; two in the rotor, three in the stator.
slots = 5;
r0[] = {13, 13, 19, 19, 19};
r1[] = {16.5, 16.5, 22.5, 22.5, 22.5};
angle[] = {1 / 4, 3 / 4, 1 / 6, 1 / 2, 5 / 6};
half_width[] = {0.11, 0.11, 0.065, 0.065, 0.065};
For i In {0 : slots - 1}
  p = 100 * (i + 1);
  a = angle[i] * sector - half_width[i];
  b = angle[i] * sector + half_width[i];
  Point(p) = {r0[i] * Cos(a), r0[i] * Sin(a), 0, fine};
  Point(p + 1) = {r1[i] * Cos(a), r1[i] * Sin(a), 0, fine};
  Point(p + 2) = {r1[i] * Cos(b), r1[i] * Sin(b), 0, fine};
  Point(p + 3) = {r0[i] * Cos(b), r0[i] * Sin(b), 0, fine};
  Line(p) = {p, p + 1};
  Circle(p + 1) = {p + 1, 1, p + 2};
  Line(p + 2) = {p + 2, p + 3};
  Circle(p + 3) = {p, 1, p + 3};
  Curve Loop(i + 2) = {p, p + 1, p + 2, -(p + 3)};
EndFor

Plane Surface(1) = {1 : slots + 1};
Physical Curve("shaft") = {2};
Physical Curve("yoke") = {1};
Physical Curve("symmetry") = {10 : 12, 20 : 22};
Physical Curve("rotor_slots") = {100 : 103, 200 : 203};
Physical Curve("stator_slots") = {300 : 303, 400 : 403, 500 : 503};
Physical Surface("iron") = {1};
