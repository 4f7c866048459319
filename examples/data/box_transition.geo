// A box whose left face has a boundary with smaller elements than the rest.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 4, 2, 1};
left() = Curve In BoundingBox {-0.01, -0.01, -0.01, 0.01, 2.01, 1.01};
Physical Curve("small") = {left()};
Physical Curve("rest") = {5:12};
Physical Surface("skin") = {1:6};
