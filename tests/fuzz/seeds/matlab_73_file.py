"""Writes the seeds of MATLAB files of level 7.3, as MATLAB lays them out, with h5py."""

import pathlib

import h5py
import numpy as np

HEAD = b"MATLAB 7.3 MAT-file, Platform: GLNXA64, HDF5 schema 1.00 .".ljust(116) + bytes(8) + b"\x00\x02IM"
FOLDER = pathlib.Path(__file__).parent / "matlab_73_file"
TIME_S = np.arange(12) * 0.004
TORQUE_N_m = 0.1 * np.sin(9 * TIME_S)
ANGLE_rad = 0.05 * np.sin(8 * TIME_S)


def set_class(item, name):
    item.attrs["MATLAB_class"] = np.bytes_(name)
    return item


def numbers(group, name, values, kind="double", **options):
    return set_class(group.create_dataset(name, data=np.asarray(values).T, **options), kind)


def text(group, name, letters):
    if not letters:
        item = group.create_dataset(name, data=np.zeros(2, "u8"))
        item.attrs["MATLAB_empty"] = np.uint8(1)
        return set_class(item, "char")
    return set_class(group.create_dataset(name, data=np.array([[ord(c)] for c in letters], "u2")), "char")


def references(group, name, items, kind=""):
    item = group.create_dataset(name, shape=(len(items), 1), dtype=h5py.ref_dtype)
    for i, one in enumerate(items):
        item[i, 0] = one.ref
    return set_class(item, kind) if kind else item


def column(values):
    return values.reshape(-1, 1)


def structure(file, hidden):
    scope = set_class(file.create_group("ScopeData"), "struct")
    numbers(scope, "time", column(TIME_S))
    signals = set_class(scope.create_group("signals"), "struct")
    references(signals, "values", [numbers(hidden, "a", column(TORQUE_N_m)), numbers(hidden, "b", column(ANGLE_rad))])
    references(signals, "label", [text(hidden, "c", "torque"), text(hidden, "d", "hub angle")])
    references(signals, "title", [text(hidden, "e", ""), text(hidden, "f", "")])
    text(scope, "blockName", "rig/Scope")


def cells(file, hidden):
    signals = [numbers(hidden, name, column(values)) for name, values in
               {"a": TIME_S, "b": TORQUE_N_m, "c": ANGLE_rad}.items()]
    references(file, "log", signals, "cell")
    names = [text(hidden, "n" + name, name) for name in ("t", "torque", "theta")]
    references(file, "names", names, "cell")


def classes(file, hidden):
    numbers(file, "t_ms", (1000 * TIME_S).astype("i4").reshape(1, -1), "int32")
    numbers(file, "torque", TORQUE_N_m.astype("f4").reshape(1, 1, -1), "single")
    numbers(file, "theta", column(ANGLE_rad), compression="gzip")
    response = np.zeros((1, 12), dtype=[("real", "f8"), ("imag", "f8")])
    response["real"], response["imag"] = 1.0, TIME_S
    set_class(file.create_dataset("H", data=response), "double")
    numbers(file, "f", column(1.0 + TIME_S))


def units(file, hidden):
    recorder = set_class(file.create_group("rec"), "struct")
    instants = set_class(recorder.create_group("X"), "struct")
    numbers(instants, "Data", column(TIME_S))
    signals = set_class(recorder.create_group("Y"), "struct")
    references(signals, "Data", [numbers(hidden, "a", column(TORQUE_N_m)),
                                 numbers(hidden, "b", column(np.degrees(ANGLE_rad)))])
    references(signals, "Name", [text(hidden, "c", "torque"), text(hidden, "d", "theta")])
    references(signals, "Unit", [text(hidden, "e", "N\u00b7m"), text(hidden, "f", "\u00b0")])


def objects(file, hidden):
    for name in ("timeseries", "table"):
        item = numbers(file, name[:2], np.arange(6, dtype="u4").reshape(1, -1), name)
        item.attrs["MATLAB_object_decode"] = np.int32(3)
    numbers(file.create_group("#subsystem#"), "MCOS", np.arange(4.0).reshape(1, -1), "FileWrapper__")


def circular(file, hidden):
    item = file.create_dataset("log", shape=(2, 1), dtype=h5py.ref_dtype)
    set_class(item, "cell")
    item[0, 0] = item[1, 0] = item.ref


for write in (structure, cells, classes, units, objects, circular):
    path = FOLDER / f"{write.__name__}.mat"
    with h5py.File(path, "w", userblock_size=512, libver="earliest") as file:
        write(file, file.create_group("#refs#"))
    content = bytearray(path.read_bytes())
    content[: len(HEAD)] = HEAD
    path.write_bytes(content)
