"""Reads a campaign file: which kind, which tasks."""

import dataclasses
import pathlib
import tomllib

from . import kinds
from .errors import CampaignError
from .tables import Table

_LARGEST_BYTES = 16 * 1024 * 1024


@dataclasses.dataclass
class Campaign:
    """The tasks of a campaign file.

    `tasks` has a length and yields the same JSON-able inputs, in the same order, each time.
    Relative paths in them are relative to `folder`, that of the campaign file.
    """

    file: pathlib.Path
    name: str
    kind_name: str
    kind: object
    tasks: object

    @property
    def folder(self):
        return self.file.resolve().parent


def _text_of(path):
    try:
        if not path.is_file():
            missing = "is not a regular file" if path.exists() else "no such file"
            raise CampaignError(f"{path}: {missing}")
        if path.stat().st_size > _LARGEST_BYTES:
            raise CampaignError(f"{path}: {path.stat().st_size} bytes: must be 16 MiB or less")
        return path.read_bytes().decode("utf-8")
    except OSError as error:
        raise CampaignError(f"{path}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError as error:
        raise CampaignError(f"{path}: byte {error.start}: is not UTF-8") from None


def read_campaign(path):
    """The campaign of a file; CampaignError has one line for the user."""
    path = pathlib.Path(path)
    try:
        data = tomllib.loads(_text_of(path))
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        what = "nested too deep" if isinstance(error, RecursionError) else str(error)
        raise CampaignError(f"{path}: not TOML: {what}") from None
    table = Table(str(path), data)
    name = table.text("name", path.stem)
    kind_name = table.text("kind")
    kind = kinds.find(kind_name)
    if kind is None:
        table.choice("kind", kinds.names())
    own = table.table(kind_name.rpartition(".")[2])
    table.end()
    tasks = kind.expand(own, path.resolve().parent)
    own.end()
    return Campaign(path, name, kind_name, kind, tasks)
