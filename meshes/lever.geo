// SPDX-License-Identifier: GPL-3.0-only
// Lever of the friction damper in lever axes: x along the lever from the pivot at the origin, y from the friction interface
// into the lever. A bar of metal faced with a friction layer, carried by a rigid hub that reaches from the pivot to the bar:
// the arm for the interface offset. With a friction plate the layer lies on that, in front of the bar, which it touches nowhere:
// force sensors and a linear guide join the two. Units: mm. Structured quadrilaterals, fine where the cylinder sweeps along the
// face.

DefineConstant[
  lever_length    = {210.0, Name "Lever/Length"},           // pivot to tip
  lever_depth     = { 20.0, Name "Lever/Depth"},            // metal only
  offset          = { 45.6, Name "Lever/Interface offset"}, // pivot to the outer face of the layer
  layer_thickness = {  1.0, Name "Lever/Layer thickness"},  // 0: no layer
  plate_thickness = {  0.0, Name "Plate/Thickness"},        // 0: no plate
  plate_begin     = { 95.0, Name "Plate/Begin"},
  plate_end       = {205.0, Name "Plate/End"},
  spacer          = {  6.0, Name "Plate/Spacer"},           // distance of plate and bar
  hub_length      = { 10.0, Name "Lever/Hub length"},       // behind the pivot
  face_size       = {  0.5, Name "Mesh/Face size"},         // element length along the swept face
  sweep_begin     = {115.0, Name "Mesh/Sweep begin"},       // swept part of the face
  sweep_end       = {190.0, Name "Mesh/Sweep end"},
  graded_from     = {  0.0, Name "Mesh/Graded from"},       // where lengths begin to fall towards the narrow contact
  graded_to       = {  0.0, Name "Mesh/Graded to"},         // where they are shortest
  longest         = {  0.0, Name "Mesh/Longest"},           // up to there
  shortest        = {  0.0, Name "Mesh/Shortest"},          // at graded_to; 0: all of the face size on the swept face
  largest         = {  3.0, Name "Mesh/Largest length"},    // of elements along the lever
  growth          = {  1.2, Name "Mesh/Growth"}             // between neighbours beyond the swept part
];

plate = plate_thickness > 0 ? 1 : 0;
face_begin = plate ? plate_begin : 0;
face_end = plate ? plate_end : lever_length;

// Element boundaries along the friction face: sizes are fine between sweep_begin and fine_end, fall towards `last` if the mesh is
// graded, grow away from there and are scaled to fit.
graded = shortest > 0 ? 1 : 0;
fine_size = graded ? longest : face_size;
last_size = graded ? shortest : face_size;
fine_end = graded ? Max(graded_from, sweep_begin) : sweep_end;
last = graded ? graded_to : sweep_end;
limit = Max(largest, face_size);
most = growth > 1.01 ? Min(5000, Ceil(Log(limit / last_size) / Log(growth) + (face_end - face_begin) / limit + 3)) : 5000;
left[] = {}; size = fine_size; sum = 0;
For i In {1:most}
  If (sum < sweep_begin - face_begin - 1e-9)
    size = Min(size * growth, limit); sum += size; left[] += size;
  EndIf
EndFor
right[] = {}; size = last_size; sum_right = 0;
For i In {1:most}
  If (sum_right < face_end - last - 1e-9)
    size = Min(size * growth, limit); sum_right += size; right[] += size;
  EndIf
EndFor
fine = Ceil((fine_end - sweep_begin) / fine_size - 1e-6);
counts[] = {}; ends[] = {}; position = 0;
For i In {1:#left[]}
  position += left[#left[] - i] * (sweep_begin - face_begin) / sum; counts[] += 1; ends[] += position / (face_end - face_begin);
EndFor
If (fine > 0)
  counts[] += fine; position = fine_end - face_begin; ends[] += position / (face_end - face_begin);
EndIf
If (graded)
  steps = Max(1, Ceil(Log(longest / shortest) / Log(1 + (longest - shortest) / (last - fine_end))));
  shrinkage = (shortest / longest) ^ (1 / steps);
  size = (last - fine_end) * (1 - shrinkage) / (1 - shrinkage ^ steps);
  For i In {1:steps}
    position += size; size *= shrinkage; counts[] += 1; ends[] += position / (face_end - face_begin);
  EndFor
EndIf
For i In {1:#right[]}
  position += right[i - 1] * (face_end - last) / sum_right; counts[] += 1; ends[] += position / (face_end - face_begin);
EndFor
ends[#ends[] - 1] = 1;

// Rows through the metal grow by half from the face (under a layer from its thickness, as the layer spreads the load).
first = layer_thickness > 0 ? Max(2 * face_size, layer_thickness) : face_size;
ratio = 1.5;
depth = plate ? plate_thickness : lever_depth;
rows_metal = Max(2, Ceil(Log(1 + depth * (ratio - 1) / first) / Log(ratio)));
rows_layer = Max(2, Ceil(layer_thickness / face_size - 1e-6));
arm = offset + layer_thickness;
bar_front = arm + plate * (plate_thickness + spacer);

// Metal under the layer: the bar, or the plate with the bar behind it.
hub[] = {};
Point(3) = {face_begin, arm, 0};
Point(4) = {face_begin, arm + depth, 0};
Line(3) = {3, 4};
Transfinite Curve {3} = rows_metal + 1 Using Progression ratio;
metal[] = Extrude {face_end - face_begin, 0, 0} { Curve{3}; Layers{counts[], ends[]}; Recombine; };
bar[] = metal[];
If (plate)
  coarse = Max(largest, face_size);
  corner = newp; Point(corner) = {0, bar_front, 0};
  opposite = newp; Point(opposite) = {0, bar_front + lever_depth, 0};
  root = newl; Line(root) = {corner, opposite};
  Transfinite Curve {root} = Max(2, Ceil(lever_depth / coarse - 1e-6)) + 1;
  bar[] = Extrude {lever_length, 0, 0} { Curve{root}; Layers{Ceil(lever_length / coarse - 1e-6)}; Recombine; };
  hub_metal[] = Extrude {-hub_length, 0, 0} { Curve{root}; Layers{2}; Recombine; };
Else
  hub_metal[] = Extrude {-hub_length, 0, 0} { Curve{3}; Layers{2}; Recombine; };
EndIf
hub[] += hub_metal[1];
If (layer_thickness > 0)
  Point(2) = {face_begin, offset, 0};
  Line(2) = {2, 3};
  Transfinite Curve {2} = rows_layer + 1;
  cork[] = Extrude {face_end - face_begin, 0, 0} { Curve{2}; Layers{counts[], ends[]}; Recombine; };
  Physical Surface("layer") = {cork[1]};
  faces[] = Boundary { Surface{cork[1]}; };
  If (!plate)
    hub_layer[] = Extrude {-hub_length, 0, 0} { Curve{2}; Layers{2}; Recombine; };
    hub[] += hub_layer[1];
  EndIf
Else
  faces[] = Boundary { Surface{metal[1]}; };
EndIf
If (offset > 0 || plate)
  If (!plate)
    corner = layer_thickness > 0 ? 2 : 3;
  EndIf
  Point(1) = {0, 0, 0};
  Line(1) = {1, corner};
  Transfinite Curve {1} = Max(2, Ceil((plate ? bar_front : offset) / hub_length)) + 1;
  hub_arm[] = Extrude {-hub_length, 0, 0} { Curve{1}; Layers{2}; Recombine; };
  hub[] += hub_arm[1];
EndIf
Coherence;

// The friction face is the side of the layer (of the bare metal) towards the cylinder; likewise the sides between which the
// sensors are.
Macro Side
  found[] = {};
  For i In {0:#faces[] - 1}
    box[] = BoundingBox Curve{Fabs(faces[i])};
    If (Fabs(box[1] - height) < 1e-6 && Fabs(box[4] - height) < 1e-6)
      found[] += Fabs(faces[i]);
    EndIf
  EndFor
Return
height = offset;
Call Side;
Physical Surface("lever") = {bar[1]};
Physical Surface("hub") = {hub[]};
Physical Curve("friction face") = {found[]};
If (plate)
  Physical Surface("plate") = {metal[1]};
  faces[] = Boundary { Surface{metal[1]}; };
  height = arm + plate_thickness;
  Call Side;
  Physical Curve("sensor plate") = {found[]};
  faces[] = Boundary { Surface{bar[1]}; };
  height = bar_front;
  Call Side;
  Physical Curve("sensor lever") = {found[]};
EndIf
