// SPDX-License-Identifier: GPL-3.0-only
// Leaf spring behind the pivot in lever axes at rest: x along the lever from the pivot at the origin, y from the friction
// interface into the lever. From its clamp in the hub at x = -clamp_distance to the spring joint, ends on y = 0; straight, or
// bent as an arc of a circle towards +y. Units: mm. Structured quadrilaterals, shorter towards the ends, where a clamp disturbs
// what is otherwise a beam.

DefineConstant[
  leaf_length     = {100.0, Name "Leaf/Length"},         // from clamp to joint, along x
  leaf_thickness  = {  1.4, Name "Leaf/Thickness"},
  sagitta         = {  0.0, Name "Leaf/Sagitta"},        // of the arc, signed, less than half the length
  clamp_distance  = {  0.0, Name "Leaf/Clamp distance"}, // from the pivot back to the clamp
  elements_along  = { 40.0, Name "Mesh/Elements along"},
  elements_across = {  2.0, Name "Mesh/Elements across"},
  grading         = {  0.7, Name "Mesh/Grading"}         // 0: of equal length, towards 1: ever shorter at the ends
];

// Element boundaries over the length.
counts[] = {}; ends[] = {};
For i In {1:elements_along}
  counts[] += 1; ends[] += i / elements_along - grading * Sin(2 * Pi * i / elements_along) / (2 * Pi);
EndFor
ends[#ends[] - 1] = 1;

half = leaf_thickness / 2;
If (Fabs(sagitta) < 1e-6 * leaf_length)
  Point(1) = {-clamp_distance, -half, 0};
  Point(2) = {-clamp_distance, half, 0};
Else
  // Radius and angle have the sign of the sagitta; the section at the clamp points to the centre.
  radius = (leaf_length * leaf_length / 4 + sagitta * sagitta) / (2 * sagitta);
  angle = 2 * Atan(2 * sagitta / leaf_length);
  centre_x = -clamp_distance - leaf_length / 2;
  centre_y = sagitta - radius;
  Point(1) = {centre_x + (radius - half) * Sin(angle), centre_y + (radius - half) * Cos(angle), 0};
  Point(2) = {centre_x + (radius + half) * Sin(angle), centre_y + (radius + half) * Cos(angle), 0};
EndIf
Line(1) = {1, 2};
Transfinite Curve {1} = elements_across + 1;
If (Fabs(sagitta) < 1e-6 * leaf_length)
  leaf[] = Extrude {-leaf_length, 0, 0} { Curve{1}; Layers{counts[], ends[]}; Recombine; };
Else
  leaf[] = Extrude { {0, 0, 1}, {centre_x, centre_y, 0}, 2 * angle } { Curve{1}; Layers{counts[], ends[]}; Recombine; };
EndIf

Physical Surface("leaf") = {leaf[1]};
Physical Curve("hub") = {1};
Physical Curve("joint") = {leaf[0]};
