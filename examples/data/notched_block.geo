// A block with a quarter-round groove along an edge that ends halfway: its smooth cross field has an arc that changes its
// valence.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 2.4, 1.6, 1.5};
Cylinder(2) = {1.4, 0, 1.5, 1.5, 0, 0, 0.8};
BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }
