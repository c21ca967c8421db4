// SPDX-License-Identifier: GPL-3.0-only
// A lever in three dimensions whose left and right are not alike: a flange as wide as the friction layer, and behind it a rib beside
// the middle. In lever axes: x along the lever from the pivot, y from the friction interface into the lever, z across the width
// from its middle. Clamped to the pivot at x = 0. Units: mm. The section across is extruded along the lever in layers of
// hexahedra, fine where the cylinder sweeps along the face.

DefineConstant[
  lever_length    = {210.0, Name "Lever/Length"},
  width           = { 40.0, Name "Lever/Width"},
  offset          = { 45.6, Name "Lever/Interface offset"}, // pivot to the outer face of the layer
  layer_thickness = {  1.0, Name "Lever/Layer thickness"},
  flange          = {  8.0, Name "Lever/Flange"},           // depth
  rib             = { 12.0, Name "Lever/Rib depth"},        // behind the flange
  rib_width       = { 12.0, Name "Lever/Rib width"},
  rib_middle      = {  8.0, Name "Lever/Rib middle"},       // z
  face_size       = {  1.0, Name "Mesh/Face size"},         // along the swept face
  coarse          = {  3.0, Name "Mesh/Largest length"},
  across          = {  5.0, Name "Mesh/Size across"},
  sweep_begin     = {114.0, Name "Mesh/Sweep begin"},
  sweep_end       = {192.0, Name "Mesh/Sweep end"}
];

z[] = {-width / 2, rib_middle - rib_width / 2, rib_middle + rib_width / 2, width / 2};
y[] = {offset, offset + layer_thickness, offset + layer_thickness + flange, offset + layer_thickness + flange + rib};
rows[] = {Max(2, Ceil(layer_thickness / face_size)), 4, 4};

// The section: columns between z[i] and z[i + 1], rows between y[j] and y[j + 1]; behind the flange the middle column alone.
p = newp;
For i In {0:3}
  For j In {0:3}
    Point(p + 4 * i + j) = {0, y[j], z[i]};
  EndFor
EndFor
up = newl;
For i In {0:3}
  For j In {0:2}
    If (j < 2 || i == 1 || i == 2)
      Line(up + 3 * i + j) = {p + 4 * i + j, p + 4 * i + j + 1};
      Transfinite Curve {up + 3 * i + j} = rows[j] + 1;
    EndIf
  EndFor
EndFor
over = up + 12;
For i In {0:2}
  For j In {0:3}
    If (j < 3 || i == 1)
      Line(over + 4 * i + j) = {p + 4 * i + j, p + 4 * (i + 1) + j};
      Transfinite Curve {over + 4 * i + j} = Ceil((z[i + 1] - z[i]) / across - 1e-6) + 1;
    EndIf
  EndFor
EndFor

layer[] = {}; metal[] = {};
For i In {0:2}
  For j In {0:2}
    If (j < 2 || i == 1)
      c = newll;
      Curve Loop(c) = {up + 3 * i + j, over + 4 * i + j + 1, -(up + 3 * (i + 1) + j), -(over + 4 * i + j)};
      s = news; Plane Surface(s) = {c};
      Transfinite Surface {s}; Recombine Surface {s};
      If (j == 0)
        layer[] += s;
      Else
        metal[] += s;
      EndIf
    EndIf
  EndFor
EndFor

counts[] = {Ceil(sweep_begin / coarse), Ceil((sweep_end - sweep_begin) / face_size), Ceil((lever_length - sweep_end) / coarse)};
ends[] = {sweep_begin / lever_length, sweep_end / lever_length, 1};
cork[] = {}; bar[] = {};
For i In {0:#layer[] - 1}
  made[] = Extrude {lever_length, 0, 0} { Surface{layer[i]}; Layers{counts[], ends[]}; Recombine; };
  cork[] += made[1];
EndFor
For i In {0:#metal[] - 1}
  made[] = Extrude {lever_length, 0, 0} { Surface{metal[i]}; Layers{counts[], ends[]}; Recombine; };
  bar[] += made[1];
EndFor
Coherence;

small = 1e-3;
Physical Volume("lever") = {bar[]};
Physical Volume("layer") = {cork[]};
Physical Surface("hub") = {layer[], metal[]};
Physical Surface("friction face") = Surface In BoundingBox {-small, offset - small, -width, lever_length + small, offset + small, width};
