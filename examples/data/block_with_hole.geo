// A block with a cylindrical hole: a volume.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 3, 2, 1};
Cylinder(2) = {1, 1, -1, 0, 0, 3, 0.4};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
