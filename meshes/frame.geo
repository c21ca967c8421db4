// SPDX-License-Identifier: GPL-3.0-only
// Lever frame of the friction damper in lever axes: x along the lever from the pivot at the origin, y from the friction interface
// into the lever. The root (2b) is a block around the pivot, held by a rigid hub of small radius; it carries the arm (2a): two
// flanges, and between them pockets with a thinner web (or holes) and ribs of full width, tapering to the tip. The friction layer
// lies on the arm, or on a plate of its own in front of it, which touches the arm nowhere: force sensors and a linear guide join
// the two. Units: mm. Structured quadrilaterals, fine where the cylinder sweeps along the face.

DefineConstant[
  lever_length    = {210.0, Name "Lever/Length"},           // pivot to tip
  root_depth      = { 20.0, Name "Lever/Depth at the root"},
  tip_depth       = { 12.0, Name "Lever/Depth at the tip"},
  flange          = {  4.0, Name "Lever/Flange"},           // depth of each of the two
  web             = {   10, Name "Lever/Web"},              // 0: holes; its width is the scene's
  pockets         = {    3, Name "Lever/Pockets"},
  rib             = {  6.0, Name "Lever/Rib"},              // between pockets and at the ends of the arm
  root            = { 30.0, Name "Lever/Root"},             // from the pivot to the arm
  hub_radius      = {  5.0, Name "Lever/Hub radius"},
  wall            = {  5.0, Name "Lever/Wall"},             // of the root around the hub, at least
  offset          = { 45.6, Name "Lever/Interface offset"}, // pivot to the outer face of the layer
  layer_thickness = {  1.0, Name "Lever/Layer thickness"},  // 0: no layer
  plate_thickness = {  0.0, Name "Plate/Thickness"},        // 0: no plate
  plate_begin     = { 95.0, Name "Plate/Begin"},
  plate_end       = {205.0, Name "Plate/End"},
  spacer          = {  6.0, Name "Plate/Spacer"},           // distance of plate and arm
  face_size       = {  0.5, Name "Mesh/Face size"},         // element length along the swept face
  sweep_begin     = {115.0, Name "Mesh/Sweep begin"},       // swept part of the face
  sweep_end       = {190.0, Name "Mesh/Sweep end"},
  largest         = {  3.0, Name "Mesh/Largest length"},    // of elements along the lever
  growth          = {  1.2, Name "Mesh/Growth"}             // between neighbours beyond the swept part
];
small = 1e-6;
coarse = Max(largest, face_size);
plate = plate_thickness > 0 ? 1 : 0;
faced = layer_thickness > 0 ? 1 : 0;
front = offset + layer_thickness + plate * (plate_thickness + spacer); // of the arm
pocket = (lever_length - root - (pockets + 1) * rib) / Max(1, pockets);

lever[] = {}; webs[] = {}; plates[] = {}; layer[] = {}; face[] = {}; sensor_plate[] = {}; sensor_lever[] = {}; hub[] = {};

// Meshes a strip between columns at x[]: heights low[] at the first and high[] at the last of them, straight between, rows[] and
// ratios[] of elements across, parts[] what lies in column i and row j at i * #rows[] + j: 0 nothing, 1 lever, 2 web, 3 plate,
// 4 layer. Sizes along it grow with the distance from the swept part, up to the coarsest. Leaves lines along in along[] and
// across in across[].
Macro Strip
  n = #x[]; m = #rows[];
  p0 = newp;
  For i In {0:n-1}
    way = (x[i] - x[0]) / (x[n-1] - x[0]);
    For j In {0:m}
      Point(p0 + i * (m + 1) + j) = {x[i], low[j] + way * (high[j] - low[j]), 0};
    EndFor
  EndFor
  along[] = {}; across[] = {};
  For i In {0:n-2}
    before = Max(0, Max(sweep_begin - x[i], x[i] - sweep_end));
    after = Max(0, Max(sweep_begin - x[i+1], x[i+1] - sweep_end));
    from = Min(coarse, finest + (growth - 1) * before);
    to = Min(coarse, finest + (growth - 1) * after);
    mean = from;
    If (Fabs(to - from) > small * from)
      mean = (to - from) / Log(to / from);
    EndIf
    count = Max(1, Ceil((x[i+1] - x[i]) / mean - small));
    ratio = (to / from) ^ (1 / Max(1, count - 1));
    For j In {0:m}
      l = newl; Line(l) = {p0 + i * (m + 1) + j, p0 + (i + 1) * (m + 1) + j};
      Transfinite Curve {l} = count + 1 Using Progression ratio;
      along[] += l;
    EndFor
  EndFor
  For i In {0:n-1}
    For j In {0:m-1}
      l = newl; Line(l) = {p0 + i * (m + 1) + j, p0 + i * (m + 1) + j + 1};
      Transfinite Curve {l} = rows[j] + 1 Using Progression ratios[j];
      across[] += l;
    EndFor
  EndFor
  For i In {0:n-2}
    For j In {0:m-1}
      part = parts[i * m + j];
      If (part > 0)
        c = newll;
        Curve Loop(c) = {along[i * (m + 1) + j], across[(i + 1) * m + j], -along[i * (m + 1) + j + 1], -across[i * m + j]};
        s = news; Plane Surface(s) = {c};
        Transfinite Surface {s}; Recombine Surface {s};
        If (part == 1)
          lever[] += s;
        ElseIf (part == 2)
          webs[] += s;
        ElseIf (part == 3)
          plates[] += s;
        Else
          layer[] += s;
        EndIf
      EndIf
    EndFor
  EndFor
Return

// Rows through metal under the friction face grow by half (under a layer from its thickness, as the layer spreads the load).
grow_by = 1.5;
first = faced ? Max(2 * face_size, layer_thickness) : face_size;
rows_layer = Max(2, Ceil(layer_thickness / face_size - small));

// Friction plate.
If (plate)
  finest = face_size;
  x[] = {plate_begin, sweep_begin, sweep_end, plate_end};
  rows[] = {}; ratios[] = {}; low[] = {offset}; parts[] = {};
  If (faced)
    rows[] += rows_layer; ratios[] += 1; low[] += offset + layer_thickness;
  EndIf
  rows[] += Max(2, Ceil(Log(1 + plate_thickness * (grow_by - 1) / first) / Log(grow_by))); ratios[] += grow_by;
  low[] += offset + layer_thickness + plate_thickness;
  high[] = low[];
  For i In {0:2}
    If (faced)
      parts[] += 4;
    EndIf
    parts[] += 3;
  EndFor
  Call Strip;
  For i In {0:2}
    face[] += along[i * (m + 1)];
    sensor_plate[] += along[i * (m + 1) + m];
  EndFor
EndIf

// Arm: its sections end where pockets do and, without a plate, the swept part of the face, which begins behind the first rib.
ends[] = {root + rib};
For k In {1:pockets}
  If (k > 1)
    ends[] += root + rib + (k - 1) * (pocket + rib);
  EndIf
  ends[] += root + k * (pocket + rib);
EndFor
ends[] += lever_length;
x[] = {root};
For k In {0:#ends[]-1}
  reached = x[#x[]-1];
  If (!plate && sweep_begin > reached + small && sweep_begin < ends[k] - small)
    x[] += sweep_begin;
  EndIf
  If (!plate && sweep_end > reached + small && sweep_end < ends[k] - small)
    x[] += sweep_end;
  EndIf
  x[] += ends[k];
EndFor
finest = plate ? coarse : face_size;
carries = faced && !plate ? 1 : 0;
rows_front = plate ? Max(2, Ceil(flange / coarse - small)) : Max(2, Ceil(Log(1 + flange * (grow_by - 1) / first) / Log(grow_by)));
rows_middle = Max(2, Ceil((root_depth - 2 * flange) / coarse - small));
rows_back = Max(2, Ceil(flange / coarse - small));
rows[] = {rows_front, rows_middle, rows_back}; ratios[] = {plate ? 1 : grow_by, 1, 1};
low[] = {front, front + flange, front + root_depth - flange, front + root_depth};
high[] = {front, front + flange, front + tip_depth - flange, front + tip_depth};
If (carries)
  rows[] = {rows_layer, rows[]}; ratios[] = {1, ratios[]};
  low[] = {offset, low[]}; high[] = {offset, high[]};
EndIf
parts[] = {};
For i In {0:#x[]-2}
  middle = 0.5 * (x[i] + x[i+1]);
  hollow = 0;
  For k In {1:pockets}
    begin = root + rib + (k - 1) * (pocket + rib);
    hollow = middle > begin && middle < begin + pocket ? 1 : hollow;
  EndFor
  If (carries)
    parts[] += middle > root + rib ? 4 : 0;
  EndIf
  parts[] += {1, hollow ? (web > 0 ? 2 : 0) : 1, 1};
EndFor
Call Strip;
For i In {0:n-2}
  If (plate)
    sensor_lever[] += along[i * (m + 1)];
  ElseIf (x[i] > root + small)
    face[] += along[i * (m + 1)];
  EndIf
EndFor

// Root: quadrilaterals around the hub up to the wall over it or, where the arm begins below that, up to the arm's back; in between a
// column. What lies around the hub is convex, and so is seen from the pivot as a whole.
above = hub_radius + wall;
tower = front > above + small ? 1 : 0;
outer[] = {}; sides[] = {}; counts[] = {}; // points around the hub, and the line that follows each, 0 where it is yet to be made
p = newp; Point(p) = {root, -above, 0}; outer[] += p; sides[] += 0; counts[] += 0;
If (tower)
  right[] = {newp}; Point(right[0]) = {root, above, 0};
  left[] = {newp}; Point(left[0]) = {-above, above, 0};
  shelf = newl; Line(shelf) = {right[0], left[0]};
  shelf_count = Max(2, Ceil((root + above) / coarse - small));
  Transfinite Curve {shelf} = shelf_count + 1;
  outer[] += {right[0], left[0]}; sides[] += {shelf, 0}; counts[] += {shelf_count, 0};
  side[] = {newl}; Line(side[0]) = {right[0], p0 + carries};
  tower_rows[] = {Max(1, Ceil((front - above) / coarse - small))}; tower_ratios[] = {1};
  Transfinite Curve {side[0]} = tower_rows[0] + 1;
  For j In {carries:m-1}
    side[] += across[j]; tower_rows[] += rows[j]; tower_ratios[] += ratios[j];
  EndFor
  below = shelf;
  For j In {0:#side[]-1}
    at[] = Point{p0 + carries + j};
    p = newp; Point(p) = {-above, at[1], 0};
    edge = newl; Line(edge) = {left[j], p};
    Transfinite Curve {edge} = tower_rows[j] + 1 Using Progression tower_ratios[j];
    over = newl; Line(over) = {p0 + carries + j, p};
    Transfinite Curve {over} = shelf_count + 1;
    c = newll; Curve Loop(c) = {side[j], over, -edge, -below};
    s = news; Plane Surface(s) = {c};
    Transfinite Surface {s}; Recombine Surface {s};
    lever[] += s; left[] += p; below = over;
  EndFor
Else
  For j In {carries:m-1}
    outer[] += p0 + j; sides[] += across[j]; counts[] += rows[j];
  EndFor
  outer[] += p0 + m; sides[] += 0; counts[] += 0;
  back = Max(front + root_depth, above);
  If (back > front + root_depth + small)
    p = newp; Point(p) = {root, back, 0}; outer[] += p; sides[] += 0; counts[] += 0;
  EndIf
  p = newp; Point(p) = {-above, back, 0}; outer[] += p; sides[] += 0; counts[] += 0;
EndIf
p = newp; Point(p) = {-above, -above, 0}; outer[] += p; sides[] += 0; counts[] += 0;

centre = newp; Point(centre) = {0, 0, 0};
around = #outer[];
inner[] = {}; rays[] = {};
For i In {0:around-1}
  at[] = Point{outer[i]};
  distance = Sqrt(at[0]^2 + at[1]^2);
  p = newp; Point(p) = {hub_radius * at[0] / distance, hub_radius * at[1] / distance, 0}; inner[] += p;
  l = newl; Line(l) = {p, outer[i]}; rays[] += l;
  Transfinite Curve {l} = 9 Using Progression 1.2;
EndFor
For i In {0:around-1}
  next = (i + 1) % around;
  line = sides[i]; count = counts[i];
  If (count == 0)
    a[] = Point{outer[i]}; b[] = Point{outer[next]};
    line = newl; Line(line) = {outer[i], outer[next]};
    count = Max(2, Ceil(Sqrt((a[0] - b[0])^2 + (a[1] - b[1])^2) / coarse - small));
    Transfinite Curve {line} = count + 1;
  EndIf
  arc = newl; Circle(arc) = {inner[i], centre, inner[next]}; hub[] += arc;
  Transfinite Curve {arc} = count + 1;
  c = newll; Curve Loop(c) = {rays[i], line, -rays[next], -arc};
  s = news; Plane Surface(s) = {c};
  Transfinite Surface {s}; Recombine Surface {s};
  lever[] += s;
EndFor

Physical Surface("lever") = {lever[]};
If (#webs[] > 0)
  Physical Surface("web") = {webs[]};
EndIf
If (faced)
  Physical Surface("layer") = {layer[]};
EndIf
Physical Curve("friction face") = {face[]};
Physical Curve("hub") = {hub[]};
If (plate)
  Physical Surface("plate") = {plates[]};
  Physical Curve("sensor plate") = {sensor_plate[]};
  Physical Curve("sensor lever") = {sensor_lever[]};
EndIf
