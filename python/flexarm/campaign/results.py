"""Reads the merged table back."""

import pathlib


class _Texts:
    """A column of texts as an array of str, read where it is sliced."""

    def __init__(self, column):
        self._column = column.asstr()
        self.shape = column.shape
        self.ndim = 1
        self.dtype = column.dtype  # object

    def __getitem__(self, rows):
        return self._column[rows]


def open_results(path):
    """The table of a campaign as an xarray.Dataset over the dimension `row`.

    `path` is `results.h5` or the folder that has it. Columns are dask arrays: rows are read where
    they are asked for, so the table may be larger than memory. The file stays open until the
    dataset is closed. Needs h5py, xarray and dask.
    """
    import dask.array
    import h5py
    import numpy
    import xarray

    path = pathlib.Path(path)
    file = h5py.File(path / "results.h5" if path.is_dir() else path, "r")
    try:
        columns = {}
        for name in file.attrs["columns"]:
            column = file[name]
            source = _Texts(column) if h5py.check_string_dtype(column.dtype) else column
            values = dask.array.from_array(
                source, chunks=column.chunks, lock=True, meta=numpy.empty(0, dtype=source.dtype)
            )
            columns[name] = ("row", values)
        attributes = {name: file.attrs[name] for name in ("name", "kind", "version")}
        data = xarray.Dataset(columns, attrs=attributes)
    except BaseException:
        file.close()
        raise
    data.set_close(file.close)
    return data
