// A block with a step cut into one edge of its upper half: its smooth cross field has an arc that changes its valence.
SetFactory("OpenCASCADE");
Point(1) = {0, 0, 0}; Point(2) = {2, 0, 0}; Point(3) = {2.2, 1.6, 0}; Point(4) = {0, 2, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Extrude {0, 0, 1.5} { Surface{1}; }
Box(2) = {1.2, 1, 0.7, 1.5, 1.5, 1};
BooleanDifference { Volume{1}; Delete; }{ Volume{2}; Delete; }
