// SPDX-License-Identifier: GPL-3.0-only
// Elastic cylinder of the friction damper about its centre, in axes parallel to the lever's: y points to the lever. A ring on
// what is rigid, core or shaft. Units: mm. Structured quadrilaterals, fine where it touches the lever.

DefineConstant[
  radius       = {56.0, Name "Cylinder/Radius"},
  inner_radius = {28.0, Name "Cylinder/Inner radius"}, // of what is rigid
  face_width   = {10.0, Name "Cylinder/Face width"},   // of the part that can touch, along the surface
  face_size    = {0.25, Name "Mesh/Face size"},        // element length there
  growth       = { 1.4, Name "Mesh/Growth"}            // between neighbours, along the surface and inwards
];

// Element boundaries along the surface from the end of the face to the far side: sizes grow and are scaled to fit.
half = face_width / 2 / radius;
rest = Pi - half;
largest = Pi / 12;
counts[] = {}; ends[] = {}; sizes[] = {}; size = face_size / radius; sum = 0;
For i In {1:5000}
  If (sum < rest - 1e-9)
    size = Min(size * growth, largest); sum += size; sizes[] += size;
  EndIf
EndFor
position = 0;
For i In {0:#sizes[] - 1}
  position += sizes[i] / sum; counts[] += 1; ends[] += position;
EndFor
ends[#ends[] - 1] = 1;

// Rows grow inwards from the surface.
rows = Max(2, Ceil(Log(1 + (radius - inner_radius) * (growth - 1) / face_size) / Log(growth)));

Point(1) = {radius * Sin(half), radius * Cos(half), 0};
Point(2) = {inner_radius * Sin(half), inner_radius * Cos(half), 0};
Line(1) = {1, 2};
Transfinite Curve {1} = rows + 1 Using Progression growth;
face[] = Extrude {{0, 0, 1}, {0, 0, 0}, 2 * half} { Curve{1}; Layers{Ceil(face_width / face_size - 1e-6)}; Recombine; };
left[] = Extrude {{0, 0, 1}, {0, 0, 0}, rest} { Curve{face[0]}; Layers{counts[], ends[]}; Recombine; };
right[] = Extrude {{0, 0, 1}, {0, 0, 0}, -rest} { Curve{1}; Layers{counts[], ends[]}; Recombine; };
Coherence;

Physical Surface("cylinder") = {face[1], left[1], right[1]};

// Arcs are told by the distance of their ends from the centre.
outer[] = {}; inner[] = {};
For i In {0:2}
  sides[] = Boundary { Surface{i == 0 ? face[1] : i == 1 ? left[1] : right[1]}; };
  For j In {0:#sides[] - 1}
    ends_of[] = Boundary { Curve{Fabs(sides[j])}; };
    a[] = Point{Fabs(ends_of[0])};
    b[] = Point{Fabs(ends_of[1])};
    shorter = Min(Hypot(a[0], a[1]), Hypot(b[0], b[1]));
    longer  = Max(Hypot(a[0], a[1]), Hypot(b[0], b[1]));
    If (longer < inner_radius * (1 + 1e-6))
      inner[] += Fabs(sides[j]);
    ElseIf (shorter > radius * (1 - 1e-6) && i == 0)
      outer[] += Fabs(sides[j]);
    EndIf
  EndFor
EndFor
Physical Curve("cylinder face") = {outer[]};
Physical Curve("core") = {inner[]};
