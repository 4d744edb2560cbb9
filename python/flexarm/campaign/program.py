"""The identity of what computes: version, extension module and the sources of a kind."""

import functools
import hashlib

import flexarm
from flexarm import _flexarm


@functools.cache
def program_digest(kind):
    """SHA-256 over version, bytes of the extension and of the module of `kind`."""
    whole = hashlib.sha256(flexarm.__version__.encode())
    for file in (_flexarm.__file__, kind.__file__):
        with open(file, "rb") as stream:
            whole.update(hashlib.file_digest(stream, "sha256").digest())
    return whole.hexdigest()


def shown_program(digest):
    return f"{flexarm.__version__}, {digest[:12]}"
