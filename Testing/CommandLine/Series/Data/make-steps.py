#!/usr/bin/env python3
# Writes steps.e, steps.vtkhdf, blocks.vtkhdf and steps.cgns, formats that the tests cannot write themselves: a
# square of side 2 whose point array T is 0, 1 and 2 at the times 0, 0.5 and 1.5. Needs numpy, scipy and h5py.
import pathlib

import h5py
import numpy as np
from scipy.io import netcdf_file

FOLDER = pathlib.Path(__file__).resolve().parent
TIMES = np.array([0.0, 0.5, 1.5])
X, Y, Z = np.array([-1.0, 1, 1, -1]), np.array([-1.0, -1, 1, 1]), np.zeros(4)


def letters(text, size):
    return np.array(list(text.ljust(size, "\0")), dtype="S1")


def write_exodus(path):
    file = netcdf_file(path, "w", version=1)
    file.api_version = file.version = np.float32(4.98)
    file.floating_point_word_size = np.int32(8)
    file.file_size = np.int32(1)
    file.title = b"steps"
    sizes = {"time_step": None, "len_string": 33, "len_line": 81, "four": 4, "num_dim": 3, "num_nodes": 4,
             "num_elem": 1, "num_el_blk": 1, "num_el_in_blk1": 1, "num_nod_per_el1": 4, "num_nod_var": 1}
    for name, size in sizes.items():
        file.createDimension(name, size)
    times = file.createVariable("time_whole", "d", ("time_step",))
    file.createVariable("eb_status", "i", ("num_el_blk",))[:] = 1
    ids = file.createVariable("eb_prop1", "i", ("num_el_blk",))
    ids[:] = 1
    ids.name = b"ID"
    for name, values in (("coordx", X), ("coordy", Y), ("coordz", Z)):
        file.createVariable(name, "d", ("num_nodes",))[:] = values
    axes = file.createVariable("coor_names", "c", ("num_dim", "len_string"))
    for i, axis in enumerate("xyz"):
        axes[i] = letters(axis, 33)
    cells = file.createVariable("connect1", "i", ("num_el_in_blk1", "num_nod_per_el1"))
    cells[:] = [[1, 2, 3, 4]]
    cells.elem_type = b"SHELL4"
    file.createVariable("name_nod_var", "c", ("num_nod_var", "len_string"))[0] = letters("T", 33)
    values = file.createVariable("vals_nod_var1", "d", ("time_step", "num_nodes"))
    for step, time in enumerate(TIMES):
        times[step] = time
        values[step] = step
    file.close()


def describe_vtkhdf(group, kind, version):
    group.attrs["Version"] = np.array(version, "i8")
    group.attrs.create("Type", np.bytes_(kind), dtype=h5py.string_dtype("ascii", len(kind)))


def write_vtkhdf(path, is_block=False):
    with h5py.File(path, "w") as file:
        root = file.create_group("VTKHDF", track_order=is_block)
        version = [2, 2] if is_block else [2, 0]
        if is_block:
            describe_vtkhdf(root, "PartitionedDataSetCollection", version)
            root.create_group("Assembly", track_order=True)["Block"] = h5py.SoftLink("/VTKHDF/Block")
            root = root.create_group("Block")
            root.attrs["Index"] = 0
        describe_vtkhdf(root, "UnstructuredGrid", version)
        for name, count in (("NumberOfPoints", 4), ("NumberOfCells", 1), ("NumberOfConnectivityIds", 4)):
            root[name] = np.array([count], "i8")
        root["Points"] = np.stack([X, Y, Z], 1).astype("f4")
        root["Connectivity"] = np.arange(4)
        root["Offsets"] = np.array([0, 4])
        root["Types"] = np.array([9], "u1")
        root.create_group("PointData")["T"] = np.repeat(np.arange(3.0), 4)
        steps = root.create_group("Steps")
        steps.attrs["NSteps"] = 3
        steps["Values"] = TIMES
        zeros = np.zeros(3, "i8")
        steps["PartOffsets"] = steps["PointOffsets"] = zeros
        steps["NumberOfParts"] = zeros + 1
        steps["CellOffsets"] = steps["ConnectivityIdOffsets"] = zeros.reshape(3, 1)
        steps.create_group("PointDataOffsets")["T"] = np.array([0, 4, 8])


def describe(group, **texts):
    """Adds the attributes of a CGNS node, which are strings of fixed size."""
    for name, (text, size) in texts.items():
        kind = h5py.h5t.C_S1.copy()
        kind.set_size(size)
        space = h5py.h5s.create(h5py.h5s.SCALAR)
        h5py.h5a.create(group.id, name.encode(), kind, space).write(np.array(text.encode(), f"S{size}"))


def add_node(parent, name, label, data=None, kind="MT"):
    group = parent.create_group(name, track_order=True)
    if data is not None:
        group.create_dataset(" data", data=data)
        kind = {"i1": "C1", "i4": "I4", "f4": "R4", "f8": "R8"}[data.dtype.str[1:]]
    describe(group, name=(name, 33), label=(label, 33), type=(kind, 3))
    group.attrs.create("flags", np.array([1], "i4"))
    return group


def text(value):
    return np.frombuffer(value.encode(), "i1")


def write_cgns(path):
    with h5py.File(path, "w", track_order=True) as file:
        describe(file, name=("HDF5 MotherNode", 33), label=("Root Node of HDF5 File", 33), type=("MT", 3))
        file.create_dataset(" format", data=text("IEEE_LITTLE_32\0"))
        file.create_dataset(" hdf5version", data=text("HDF5 Version 1.10.4".ljust(33, "\0")))
        add_node(file, "CGNSLibraryVersion", "CGNSLibraryVersion_t", np.array([3.2], "f4"))
        base = add_node(file, "Base", "CGNSBase_t", np.array([2, 3], "i4"))
        zone = add_node(base, "Zone", "Zone_t", np.array([[4], [1], [0]], "i4"))
        add_node(zone, "ZoneType", "ZoneType_t", text("Unstructured"))
        grid = add_node(zone, "GridCoordinates", "GridCoordinates_t")
        for axis, values in (("X", X), ("Y", Y), ("Z", Z)):
            add_node(grid, "Coordinate" + axis, "DataArray_t", values)
        cells = add_node(zone, "Elem", "Elements_t", np.array([7, 0], "i4"))
        add_node(cells, "ElementRange", "IndexRange_t", np.array([1, 1], "i4"))
        add_node(cells, "ElementConnectivity", "DataArray_t", np.array([1, 2, 3, 4], "i4"))
        names = [f"Solution{step}" for step in range(3)]
        for step, name in enumerate(names):
            solution = add_node(zone, name, "FlowSolution_t")
            add_node(solution, "GridLocation", "GridLocation_t", text("Vertex"))
            add_node(solution, "T", "DataArray_t", np.full(4, step, "f8"))
        times = add_node(base, "TimeIterValues", "BaseIterativeData_t", np.array([3], "i4"))
        add_node(times, "TimeValues", "DataArray_t", TIMES)
        pointers = np.stack([text(name.ljust(32)) for name in names])
        add_node(add_node(zone, "ZoneIterativeData", "ZoneIterativeData_t"), "FlowSolutionPointers",
                 "DataArray_t", pointers)


write_exodus(FOLDER / "steps.e")
write_vtkhdf(FOLDER / "steps.vtkhdf")
write_vtkhdf(FOLDER / "blocks.vtkhdf", True)
write_cgns(FOLDER / "steps.cgns")
