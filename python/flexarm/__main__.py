"""python -m flexarm: the program of this installation, with the same arguments."""

import os
import pathlib
import shutil
import sys


def program():
    """Path of the program: in bin/ of the prefix that holds the package, or on PATH."""
    for folder in pathlib.Path(__file__).resolve().parents:
        beside = folder / "bin" / "flexarm"
        if beside.is_file():
            return str(beside)
    return shutil.which("flexarm")


def main():
    path = program()
    if path is None:
        print("flexarm: the program is not installed beside the package, nor on PATH",
              file=sys.stderr)
        sys.exit(2)
    os.execv(path, [path, *sys.argv[1:]])


if __name__ == "__main__":
    main()
