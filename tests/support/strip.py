# SPDX-License-Identifier: GPL-3.0-only
"""A strip of 52 x 4 quadrilaterals, clamped at its left edge: a lever as small as one can be, as gmsh's script and meshes, and with
four layers in three dimensions."""

SCRIPT = """
Point(1) = {0, 45.6, 0};
line[] = Extrude {210, 0, 0} { Point{1}; Layers{52}; };
area[] = Extrude {0, 20, 0} { Curve{line[1]}; Layers{4}; Recombine; };
Physical Surface("lever") = {area[1]};
Physical Curve("hub") = {Abs(area[3])};
Physical Curve("friction face") = {line[1]};
"""
SOLID = (
    SCRIPT.split("Physical")[0]
    + """
solid[] = Extrude {0, 0, 40} { Surface{area[1]}; Layers{4}; Recombine; };
Translate {0, 0, -20} { Volume{solid[1]}; }
Physical Volume("lever") = {solid[1]};
Physical Surface("friction face") = {solid[2]};
Physical Surface("hub") = {solid[5]};
"""
)
NAMES = '$PhysicalNames\n3\n2 1 "lever"\n1 2 "friction face"\n1 3 "hub"\n$EndPhysicalNames\n'
NODES = [(210 * x / 52, 45.6 + 5 * y) for y in range(5) for x in range(53)]
CELLS = [(at + 1, at + 2, at + 55, at + 54) for y in range(4) for at in range(53 * y, 53 * y + 52)]
FACE = [(x + 1, x + 2) for x in range(52)]
HUB = [(53 * y + 1, 53 * y + 54) for y in range(4)]


def mesh_22():
    elements = [(3, 1, cell) for cell in CELLS] + [(1, 2, side) for side in FACE] + [(1, 3, side) for side in HUB]
    lines = [f"{number} {kind} 2 {group} {group} " + " ".join(map(str, nodes)) for number, (kind, group, nodes) in enumerate(elements, 1)]
    nodes = [f"{number} {x:g} {y:g} 0" for number, (x, y) in enumerate(NODES, 1)]
    return "\n".join(
        ["$MeshFormat\n2.2 0 8\n$EndMeshFormat", NAMES + "$Nodes", str(len(nodes)), *nodes, "$EndNodes\n$Elements", str(len(lines)), *lines, "$EndElements\n"]
    )


def mesh_41():
    box = "0 45.6 0 210 65.6 0"
    entities = f"0 2 1 0\n1 {box} 1 2 0\n2 {box} 1 3 0\n1 {box} 1 1 2 1 2"
    blocks, number = [], 1
    for dim, entity, kind, elements in ((1, 1, 1, FACE), (1, 2, 1, HUB), (2, 1, 3, CELLS)):
        blocks.append(f"{dim} {entity} {kind} {len(elements)}")
        blocks += [f"{number + i} " + " ".join(map(str, nodes)) for i, nodes in enumerate(elements)]
        number += len(elements)
    count = len(NODES)
    nodes = [f"1 {count} 1 {count}", f"2 1 0 {count}", *map(str, range(1, count + 1)), *(f"{x:g} {y:g} 0" for x, y in NODES)]
    return "\n".join(
        ["$MeshFormat\n4.1 0 8\n$EndMeshFormat", NAMES + "$Entities", entities, "$EndEntities\n$Nodes", *nodes, "$EndNodes\n$Elements",
         f"3 {number - 1} 1 {number - 1}", *blocks, "$EndElements\n"]
    )  # fmt: skip


MESH_22, MESH_41 = mesh_22(), mesh_41()
