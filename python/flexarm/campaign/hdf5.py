"""The merged table as HDF5, `results.h5`: a dataset a column, in chunks of rows.

Numbers are float64, NaN where a task has none; texts are of variable length, UTF-8. The attribute
`columns` has the order. Memory is that of a chunk.
"""

import flexarm

from .merge import columns_of, rows_of
from .task_files import whole_files

ROWS_IN_A_CHUNK = 4096


class ColumnTypes:
    """Sees each row; a column is of numbers where nothing else stands in it."""

    def __init__(self):
        self._texts = set()

    def see(self, columns, row):
        for name, value in zip(columns, row):
            if isinstance(value, str):
                self._texts.add(name)

    def is_text(self, name):
        return name in self._texts


def _make(file, columns, types, rows):
    import h5py

    chunk = (min(ROWS_IN_A_CHUNK, max(rows, 1)),)
    return [
        file.create_dataset(
            name, (rows,), chunks=chunk,
            dtype=h5py.string_dtype() if types.is_text(name) else "f8",
            fillvalue=None if types.is_text(name) else float("nan"),
        )
        for name in columns
    ]


def _write_batch(datasets, types, columns, first, batch):
    for dataset, name, values in zip(datasets, columns, zip(*batch)):
        is_text = types.is_text(name)
        absent = "" if is_text else float("nan")
        dataset[first : first + len(batch)] = [
            absent if value is None else str(value) if is_text else float(value)
            for value in values
        ]


def write_hdf5(campaign, outcome, out, types):
    """Writes `results.h5` from the files of the tasks; whole or not at all."""
    import h5py

    columns = columns_of(campaign)
    # Headers of the earliest version have no times of day.
    with (
        whole_files(out / "results.h5") as (temporary,),
        h5py.File(temporary, "x", libver="earliest") as file,
    ):
        file.attrs["schema"] = "flexarm.campaign/1"
        file.attrs["name"] = campaign.name
        file.attrs["kind"] = campaign.kind_name
        file.attrs["version"] = flexarm.__version__
        file.attrs["columns"] = columns
        datasets = _make(file, columns, types, len(outcome.digests))
        batch, first = [], 0
        for _, row in rows_of(campaign, outcome, out):
            batch.append(row)
            if len(batch) == ROWS_IN_A_CHUNK:
                _write_batch(datasets, types, columns, first, batch)
                batch, first = [], first + len(batch)
        if batch:
            _write_batch(datasets, types, columns, first, batch)
