"""Hashes of the files that tasks read, kept from one start of a campaign to the next."""

import os
import sqlite3
import time

from .task_files import file_digest

# A file may change again within the resolution of its time: what is younger is not kept.
_SETTLED_NS = 2_000_000_000
_TABLE = (
    "create table if not exists files"
    " (path text primary key, size integer, changed_ns integer, inode integer, digest text)"
    " without rowid"
)


class FileDigests:
    """`digests(path)` is `file_digest(path)`. One that is kept, in the SQLite file `kept`, is taken
    where size, time of change and inode are those of then: a `stat` in place of a reading.

    A file that cannot be used is made anew: it has nothing but what can be computed again.
    """

    def __init__(self, kept):
        try:
            self._open(kept)
        except sqlite3.DatabaseError:
            os.unlink(kept)
            self._open(kept)

    def _open(self, kept):
        # One process writes here, under the lock of the output folder.
        self._kept = sqlite3.connect(kept, isolation_level=None)
        self._kept.execute("pragma locking_mode = exclusive")
        self._kept.execute("pragma journal_mode = off")
        self._kept.execute("pragma synchronous = off")
        self._kept.execute(_TABLE)
        self._kept.execute("begin")

    def close(self):
        self._kept.execute("commit")
        self._kept.close()

    def __call__(self, path):
        try:
            status = os.stat(path)
        except OSError as error:
            return f"cannot be read: {error.strerror}"
        changed_ns = max(status.st_mtime_ns, status.st_ctime_ns)
        now = (status.st_size, changed_ns, status.st_ino)
        name = os.path.abspath(path)
        found = self._kept.execute(
            "select size, changed_ns, inode, digest from files where path = ?", (name,)
        ).fetchone()
        if found is not None and found[:3] == now:
            return found[3]
        digest = file_digest(path)
        if time.time_ns() - changed_ns > _SETTLED_NS and not digest.startswith("cannot"):
            self._kept.execute(
                "insert or replace into files values (?, ?, ?, ?, ?)", (name, *now, digest)
            )
        return digest
