"""Build backend of `pip install .` (PEP 517): the program and the module as a wheel, built by CMake
with Debian's packages. Python's standard library is all that it needs.

Build folder: build/pip, which a later call goes on with; `--config-settings build-folder=FOLDER` takes
one that has everything built.
"""

import base64
import hashlib
import pathlib
import re
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import tomllib
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]


def version():
    text = (ROOT / "CMakeLists.txt").read_text()
    return re.search(r"project\(flexarm VERSION ([\d.]+)", text).group(1)


def metadata():
    lines = ["Metadata-Version: 2.1", f"Name: {PROJECT['name']}", f"Version: {version()}",
             f"Summary: {PROJECT['description']}", f"Requires-Python: {PROJECT['requires-python']}"]
    lines += [f"Requires-Dist: {one}" for one in PROJECT["dependencies"]]
    for extra, packages in PROJECT["optional-dependencies"].items():
        lines.append(f"Provides-Extra: {extra}")
        lines += [f"Requires-Dist: {one}; extra == '{extra}'" for one in packages]
    return "\n".join(lines) + "\n"


def tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


def built():
    """The build folder, with program and module built in it."""
    folder = ROOT / "build" / "pip"
    if not (folder / "build.ninja").exists():
        subprocess.run(
            ["cmake", "--preset", "release", "-B", folder, "-DFLEXARM_TESTS=OFF",
             "-DFLEXARM_BENCHMARKS=OFF", f"-DPython_EXECUTABLE={sys.executable}"],
            cwd=ROOT, check=True)
    subprocess.run(["cmake", "--build", folder, "--target", "flexarm", "_flexarm"], check=True)
    return folder


def place(path):
    """Where a file of the installed tree goes in a wheel; None: not into it."""
    parts = path.parts
    if "site-packages" in parts:
        return "/".join(parts[parts.index("site-packages") + 1:])
    data = f"flexarm-{version()}.data"
    if parts[0] == "bin":
        return f"{data}/scripts/{path.name}" if path.name == "flexarm" else None
    return f"{data}/data/{path.as_posix()}"


def write_wheel(path, installed):
    """The files of the installed tree and the metadata as a wheel."""
    info = f"flexarm-{version()}.dist-info"
    scripts = "".join(f"{name} = {call}\n" for name, call in PROJECT["scripts"].items())
    texts = {
        f"{info}/METADATA": metadata(),
        f"{info}/WHEEL": f"Wheel-Version: 1.0\nGenerator: flexarm\nRoot-Is-Purelib: false\nTag: {tag()}\n",
        f"{info}/entry_points.txt": f"[console_scripts]\n{scripts}",
        f"{info}/LICENSE": (ROOT / "LICENSE").read_text(),
    }
    record = []
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as wheel:

        def add(name, content, mode):
            entry = zipfile.ZipInfo(name)
            entry.external_attr = (0o100000 | mode) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, content)
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=")
            record.append(f"{name},sha256={digest.decode()},{len(content)}\n")

        for file in sorted(installed.rglob("*")):
            name = place(file.relative_to(installed)) if file.is_file() else None
            if name:
                add(name, file.read_bytes(), file.stat().st_mode & 0o777)
        for name, text in texts.items():
            add(name, text.encode(), 0o644)
        wheel.writestr(f"{info}/RECORD", "".join(record) + f"{info}/RECORD,,\n")


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    given = (config_settings or {}).get("build-folder")
    folder = pathlib.Path(given) if given else built()
    name = f"flexarm-{version()}-{tag()}.whl"
    with tempfile.TemporaryDirectory() as stage:
        for component in ("program", "python"):
            subprocess.run(
                ["cmake", "--install", folder, "--component", component, "--prefix", stage],
                check=True, stdout=subprocess.DEVNULL)
        write_wheel(pathlib.Path(wheel_directory) / name, pathlib.Path(stage))
    return name


def build_sdist(sdist_directory, config_settings=None):
    name = f"flexarm-{version()}"
    files = subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True)
    with tempfile.TemporaryDirectory() as folder:
        info = pathlib.Path(folder) / "PKG-INFO"
        info.write_text(metadata())
        with tarfile.open(pathlib.Path(sdist_directory) / f"{name}.tar.gz", "w:gz") as archive:
            archive.add(info, f"{name}/PKG-INFO")
            for file in files.stdout.splitlines():
                archive.add(ROOT / file, f"{name}/{file}", recursive=False)
    return f"{name}.tar.gz"
