# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside pvbatch: says, as JSON, what ParaView itself sees in a result folder.

usage: pvbatch _pvbatch_probe.py DIR X Y ANSWER.json      X, Y: the mouth of the crack, m
"""

import json
import sys

import numpy as np
from paraview import servermanager
from paraview.simple import CellSize, OpenDataFile, UpdatePipeline, WarpByVector
from vtk.util.numpy_support import vtk_to_numpy

WARP = 50.0


def only_grid(proxy):
    """The grid of a source, whatever boxes ParaView puts it into."""
    data = servermanager.Fetch(proxy)
    while data.IsA("vtkCompositeDataSet"):
        iterator = data.NewIterator()
        data = iterator.GetCurrentDataObject()
    return data


def points_of(grid):
    if grid.GetNumberOfPoints() == 0:
        return np.empty((0, 3))
    return vtk_to_numpy(grid.GetPoints().GetData()).astype(float)


def values_of(data, name):
    return vtk_to_numpy(data.GetArray(name))


def at(points, place):
    """Numbers of the points at a place."""
    return np.flatnonzero(np.linalg.norm(points[:, :2] - place, axis=1) < 1e-9)


def elements_of(fields):
    sized = CellSize(Input=fields, ComputeArea=1)
    grid = only_grid(sized)
    return {"element": values_of(grid.GetCellData(), "element").tolist(),
            "area": values_of(grid.GetCellData(), "Area").tolist()}


def mouth_of(fields, cracks, place):
    grid = only_grid(fields)
    chosen = at(points_of(grid), place)
    lines = only_grid(cracks)
    ends = at(points_of(lines), place)
    warped = only_grid(WarpByVector(Input=fields, Vectors=["POINTS", "displacement"], ScaleFactor=WARP))
    return {"displacement_y": values_of(grid.GetPointData(), "displacement")[chosen, 1].tolist(),
            "opening": values_of(lines.GetPointData(), "opening")[ends].tolist(),
            "slip": values_of(lines.GetPointData(), "slip")[ends].tolist(),
            "displacement_x": values_of(grid.GetPointData(), "displacement")[chosen, 0].tolist(),
            "warped_y": points_of(warped)[chosen, 1].tolist(),
            "warp": WARP}


def main(folder, x, y, answer):
    fields = OpenDataFile(f"{folder}/fields.pvd")
    cracks = OpenDataFile(f"{folder}/cracks.pvd")
    steps = []
    for time in fields.TimestepValues:
        UpdatePipeline(time, fields)
        UpdatePipeline(time, cracks)
        steps.append({"time": time, **elements_of(fields),
                      "mouth": mouth_of(fields, cracks, np.array([float(x), float(y)]))})
    with open(answer, "w", encoding="utf-8") as file:
        json.dump({"times": list(fields.TimestepValues), "crack_times": list(cracks.TimestepValues),
                   "steps": steps}, file)


main(*sys.argv[1:])
