#!/usr/bin/env pvpython
# SPDX-License-Identifier: GPL-3.0-only
"""ParaView pictures of results of sprag, made by ParaView's own Python: pvpython paraview_pictures.py DIR... [-o PICTURE_DIR].

A run is shown at its last frame in time of the largest P, a mode in the phase of its largest displacement. The state of ParaView
goes into the result's folder: paraview --state=DIR/fields.pvsm. Without a screen:
xvfb-run -a pvpython postprocess/paraview_pictures.py DIR...
"""

import argparse
import sys
from pathlib import Path

import numpy
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

WIDTH = 1100  # of a picture [pixels]
SHOWN = {"fields": "von_mises_stress [MPa]", "mode": "displacement [mm]"}


def read_arrays(reader, time):
    """Numbers of every array at the nodes, and positions."""
    simple.UpdatePipeline(time, reader)
    data = servermanager.Fetch(reader)
    while data.IsA("vtkCompositeDataSet"):
        data = data.GetBlock(data.GetNumberOfBlocks() - 1)  # rigid parts come first
    values = data.GetPointData()
    found = {values.GetArrayName(i): vtk_to_numpy(values.GetArray(i)) for i in range(values.GetNumberOfArrays())}
    return vtk_to_numpy(data.GetPoints().GetData()), found


def chosen_time(reader, name, folder):
    """Returns the time of the frame whose friction faces are pressed most."""
    times = list(reader.TimestepValues)
    if name != "fields":
        return times[0]
    face = simple.XDMFReader(FileNames=[str(folder / "face.xdmf")])
    forces = []
    for time in times:
        points, found = read_arrays(face, time)
        length = abs(points[1:, 0] - points[:-1, 0])
        forces.append(float((found["pressure [MPa]"][1:] * length * (length < 1)).sum()))
    simple.Delete(face)
    return times[forces.index(max(forces))]


def picture(index, path, magnify):
    """One index as it opens, magnified, its outline at rest behind it."""
    name = "mode" if index.stem.startswith("mode") else "fields"
    reader = simple.XDMFReader(FileNames=[str(index)])
    time = chosen_time(reader, name, index.parent)
    points, found = read_arrays(reader, time)
    moved = points + (magnify - 1) * found["displacement [mm]"]  # the nodes are where they are in the frame
    warp = simple.WarpByVector(Input=reader, Vectors=["POINTS", "displacement [mm]"], ScaleFactor=magnify - 1)

    view = simple.CreateView("RenderView")
    simple.AssignViewToLayout(view)
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.ViewTime = time
    rest = points - found["displacement [mm]"]
    low, high = (ends((ends(moved, axis=0), ends(rest, axis=0)), axis=0) for ends in (numpy.min, numpy.max))
    span = max(high[:2] - low[:2])
    view.InteractionMode = "2D"
    view.CameraParallelProjection = 1
    height = (high[1] - low[1]) * 1.06 + 0.06 * span
    width = (high[0] - low[0]) * 1.08 + 0.12 * span  # room for the colour bar
    view.ViewSize = [WIDTH, max(300, round(WIDTH * height / width))]
    middle = [0.5 * (low[0] + high[0]) + 0.05 * span, 0.5 * (low[1] + high[1])]
    view.CameraPosition = [*middle, 1000]
    view.CameraFocalPoint = [*middle, 0]
    view.CameraViewUp = [0, 1, 0]
    view.CameraParallelScale = 0.5 * max(height, width * view.ViewSize[1] / WIDTH)

    shown = simple.Show(warp, view)
    simple.ColorBy(shown, ("POINTS", SHOWN[name], "Magnitude") if name == "mode" else ("POINTS", SHOWN[name]))
    colours = simple.GetColorTransferFunction(SHOWN[name])
    colours.AutomaticRescaleRangeMode = "Never"
    colours.UseLogScale = 0
    colours.ApplyPreset("Viridis (matplotlib)", True)
    if name == "fields":
        # Leaf springs are stressed a hundred times as much as the rest.
        stress = found[SHOWN[name]]
        top = float(sorted(stress[stress == stress])[int(0.999 * (len(stress) - 1))])
        colours.RescaleTransferFunction(2e-5 * top, top)
        colours.MapControlPointsToLogSpace()
        colours.UseLogScale = 1
    else:
        size = float((found[SHOWN[name]] ** 2).sum(axis=1).max()) ** 0.5
        colours.RescaleTransferFunction(0.0, magnify * size)
    bar = simple.GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle = SHOWN[name], ""
    for text in ("TitleColor", "LabelColor"):
        setattr(bar, text, [0, 0, 0])
    bar.TitleFontSize, bar.LabelFontSize = 14, 12
    bar.ScalarBarLength = 0.6
    shown.SetScalarBarVisibility(view, True)
    shown.DiffuseColor = shown.AmbientColor = [0.75, 0.75, 0.75]  # of rigid parts, which have no stress

    at_rest = simple.WarpByVector(Input=reader, Vectors=["POINTS", "displacement [mm]"], ScaleFactor=-1)
    edges = simple.Show(simple.FeatureEdges(Input=simple.ExtractSurface(Input=simple.CleantoGrid(Input=at_rest))), view)
    simple.ColorBy(edges, None)
    edges.DiffuseColor = edges.AmbientColor = [0.55, 0.55, 0.55]
    path.parent.mkdir(parents=True, exist_ok=True)
    simple.SaveScreenshot(str(path), view, ImageResolution=view.ViewSize)
    simple.GetAnimationScene().AnimationTime = time
    simple.SaveState(str(index.with_suffix(".pvsm")))
    for shown_here in (*simple.GetSources().values(), view):
        simple.Delete(shown_here)
    print(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folders", metavar="DIR", nargs="+", type=Path, help="result folder with fields")
    parser.add_argument("-o", "--output", type=Path, metavar="DIR", help="of the pictures; default: the result's")
    parser.add_argument("--mode", type=int, default=1, help="number of the mode shown (1)")
    parser.add_argument("--magnify", type=float, default=1.0, help="factor of the displacement (1)")
    options = parser.parse_args()
    for folder in options.folders:
        index = folder.resolve() / ("fields.xdmf" if (folder / "fields.xdmf").is_file() else f"mode-{options.mode:02}.xdmf")
        if not index.is_file():
            print(f"paraview_pictures.py: {folder}: no fields.xdmf and no {index.name} there", file=sys.stderr)
            return 2
        picture(index, (options.output or folder) / f"paraview-{folder.resolve().name}.png", options.magnify)
    return 0


if __name__ == "__main__":
    sys.exit(main())
