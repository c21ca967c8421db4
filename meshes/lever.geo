// Lever of the friction damper in lever axes: x along the lever from the pivot at the origin, y from the friction interface
// into the lever. A bar of metal faced with a friction layer, carried by a rigid hub that reaches from the pivot to the bar:
// the arm for the interface offset. Units: mm. Structured quadrilaterals, fine where the cylinder sweeps along the face.

DefineConstant[
  lever_length    = {210.0, Name "Lever/Length"},           // pivot to tip
  lever_depth     = { 20.0, Name "Lever/Depth"},            // metal only
  offset          = { 45.6, Name "Lever/Interface offset"}, // pivot to the outer face of the layer
  layer_thickness = {  1.0, Name "Lever/Layer thickness"},  // 0: no layer
  hub_length      = { 10.0, Name "Lever/Hub length"},       // behind the pivot
  face_size       = {  0.5, Name "Mesh/Face size"},         // element length along the swept face
  sweep_begin     = {115.0, Name "Mesh/Sweep begin"},       // swept part of the face
  sweep_end       = {190.0, Name "Mesh/Sweep end"},
  largest         = {  3.0, Name "Mesh/Largest length"},    // of elements along the lever
  growth          = {  1.2, Name "Mesh/Growth"}             // between neighbours beyond the swept part
];

// Element boundaries along the lever, from the pivot to the tip: sizes grow away from the swept part and are scaled to fit.
left[] = {}; size = face_size; sum = 0;
For i In {1:5000}
  If (sum < sweep_begin - 1e-9)
    size = Min(size * growth, Max(largest, face_size)); sum += size; left[] += size;
  EndIf
EndFor
right[] = {}; size = face_size; sum_right = 0;
For i In {1:5000}
  If (sum_right < lever_length - sweep_end - 1e-9)
    size = Min(size * growth, Max(largest, face_size)); sum_right += size; right[] += size;
  EndIf
EndFor
fine = Ceil((sweep_end - sweep_begin) / face_size - 1e-6);
counts[] = {}; ends[] = {}; position = 0;
For i In {1:#left[]}
  position += left[#left[] - i] * sweep_begin / sum; counts[] += 1; ends[] += position / lever_length;
EndFor
counts[] += fine; ends[] += sweep_end / lever_length; position = sweep_end;
For i In {1:#right[]}
  position += right[i - 1] * (lever_length - sweep_end) / sum_right; counts[] += 1; ends[] += position / lever_length;
EndFor
ends[#ends[] - 1] = 1;

// Rows through the metal grow by half from the face (under a layer from its thickness, as the layer spreads the load).
first = layer_thickness > 0 ? Max(2 * face_size, layer_thickness) : face_size;
ratio = 1.5;
rows_metal = Max(2, Ceil(Log(1 + lever_depth * (ratio - 1) / first) / Log(ratio)));
rows_layer = Max(2, Ceil(layer_thickness / face_size - 1e-6));
arm = offset + layer_thickness;

Point(3) = {0, arm, 0};
Point(4) = {0, arm + lever_depth, 0};
Line(3) = {3, 4};
Transfinite Curve {3} = rows_metal + 1 Using Progression ratio;
metal[] = Extrude {lever_length, 0, 0} { Curve{3}; Layers{counts[], ends[]}; Recombine; };
hub_metal[] = Extrude {-hub_length, 0, 0} { Curve{3}; Layers{2}; Recombine; };
hub[] = {hub_metal[1]};
If (layer_thickness > 0)
  Point(2) = {0, offset, 0};
  Line(2) = {2, 3};
  Transfinite Curve {2} = rows_layer + 1;
  cork[] = Extrude {lever_length, 0, 0} { Curve{2}; Layers{counts[], ends[]}; Recombine; };
  hub_layer[] = Extrude {-hub_length, 0, 0} { Curve{2}; Layers{2}; Recombine; };
  hub[] += hub_layer[1];
  Physical Surface("layer") = {cork[1]};
  faces[] = Boundary { Surface{cork[1]}; };
Else
  faces[] = Boundary { Surface{metal[1]}; };
EndIf
If (offset > 0)
  Point(1) = {0, 0, 0};
  Line(1) = {1, layer_thickness > 0 ? 2 : 3};
  Transfinite Curve {1} = Max(2, Ceil(offset / hub_length)) + 1;
  hub_arm[] = Extrude {-hub_length, 0, 0} { Curve{1}; Layers{2}; Recombine; };
  hub[] += hub_arm[1];
EndIf
Coherence;

// The friction face is the side of the layer (of the bare metal) towards the cylinder.
face[] = {};
For i In {0:#faces[] - 1}
  box[] = BoundingBox Curve{Fabs(faces[i])};
  If (Fabs(box[1] - offset) < 1e-6 && Fabs(box[4] - offset) < 1e-6)
    face[] += Fabs(faces[i]);
  EndIf
EndFor
Physical Surface("lever") = {metal[1]};
Physical Surface("hub") = {hub[]};
Physical Curve("friction face") = {face[]};
