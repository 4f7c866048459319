// A quarter of a ring with a square cross section.
SetFactory("OpenCASCADE");
Rectangle(1) = {1, 0, 0, 1, 1};
Rotate {{1, 0, 0}, {1, 0, 0}, Pi / 2} { Surface{1}; }
Extrude {{0, 0, 1}, {0, 0, 0}, Pi / 2} { Surface{1}; }
