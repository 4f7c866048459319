// A plate with a hole, and a cylinder that stands on it.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 4, 2, 0.6};
Cylinder(2) = {1, 1, -1, 0, 0, 3, 0.45};
Cylinder(3) = {3, 1, 0, 0, 0, 1.8, 0.6};
BooleanDifference(4) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
BooleanUnion(5) = { Volume{4}; Delete; }{ Volume{3}; Delete; };
