// A block with a half round passage.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 4, 2, 2};
Cylinder(2) = {2, -1, 0, 0, 4, 0, 1};
BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }
