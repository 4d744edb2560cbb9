"""The files of an output folder.

    tasks/XX/HASH.json   result of a task; XX are the first two letters of HASH
    attempts/HASH        a line for each time that a worker began the task; gone when it has ended
    lock                 held by the campaign that writes here
    run                  its name, while it runs: workers see by it that they see this folder
"""

import contextlib
import fcntl
import hashlib
import json
import os
import pathlib
import secrets

from .errors import CampaignError


def canonical(value):
    """The one text of a JSON-able value. Infinite numbers and NaN are a ValueError."""
    return json.dumps(
        value, sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False
    )


def file_digest(path):
    """SHA-256 of the bytes of a file; of one that is missing a text that says so."""
    try:
        with open(path, "rb") as stream:
            return hashlib.file_digest(stream, "sha256").hexdigest()
    except OSError as error:
        return f"cannot be read: {error.strerror}"


def task_digest(kind_name, kind, task, folder, program, digest_of_file=file_digest):
    """The HASH of a task: SHA-256 of its input, of the bytes of its files and of the program."""
    names = kind.files(task, folder) if hasattr(kind, "files") else []
    files = {os.path.relpath(name, folder): digest_of_file(name) for name in names}
    text = canonical({"kind": kind_name, "input": task, "files": files, "program": program})
    return hashlib.sha256(text.encode()).hexdigest()


@contextlib.contextmanager
def whole_files(*paths):
    """Random names, in the folders of `paths`, for files that the block writes and closes. At its
    end they are synchronised and renamed to `paths`, after an exception removed: at any moment each
    of `paths` is whole, old or absent."""
    paths = [pathlib.Path(path) for path in paths]
    temporary = [path.with_name(f".{path.name}.{secrets.token_hex(8)}") for path in paths]
    try:
        yield temporary
        for one in temporary:
            with open(one, "rb") as stream:
                os.fsync(stream.fileno())
        for one, path in zip(temporary, paths):
            os.replace(one, path)
    except BaseException:
        for one in temporary:
            with contextlib.suppress(OSError):
                os.unlink(one)
        raise


def write_whole(path, data):
    """Writes bytes as `whole_files` does."""
    with whole_files(path) as (temporary,), open(temporary, "xb") as stream:
        stream.write(data)


def result_path(folder, digest):
    return os.path.join(folder, "tasks", digest[:2], f"{digest}.json")


def write_result(folder, digest, task, result):
    path = result_path(folder, digest)
    data = canonical({"schema": "flexarm.campaign_task/1", "input": task, "result": result})
    try:
        write_whole(path, data.encode())
    except FileNotFoundError:
        os.makedirs(os.path.dirname(path), exist_ok=True)
        write_whole(path, data.encode())


def read_result(folder, digest):
    """The result of a task; None where it has no whole file."""
    try:
        with open(result_path(folder, digest), "rb") as stream:
            return json.loads(stream.read())["result"]
    except (FileNotFoundError, ValueError, KeyError, TypeError):
        return None


def finished(folder):
    """Digests of the tasks that have a result, as bytes."""
    found = set()
    tasks = os.path.join(folder, "tasks")
    for part in os.listdir(tasks) if os.path.isdir(tasks) else []:
        for name in os.listdir(os.path.join(tasks, part)):
            if len(name) == 69 and name.endswith(".json"):
                with contextlib.suppress(ValueError):
                    found.add(bytes.fromhex(name[:64]))
            elif name.startswith("."):
                with contextlib.suppress(OSError):
                    os.unlink(os.path.join(tasks, part, name))  # left by a worker that was killed
    return found


class Attempts:
    """How often workers began a task and did not end it.

    A line is `RUN GENERATION`: RUN is one start of the campaign's program, GENERATION counts the
    schedulers that it had. The last attempt under a scheduler that has died is no fault of the
    task.
    """

    def __init__(self, folder, digest, run, generation):
        self._path = os.path.join(folder, "attempts", digest)
        self._run = run
        self._generation = generation

    def begin(self):
        """Notes one more attempt; returns how many of this run had a worker that died."""
        try:
            file = os.open(self._path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o644)
        except FileNotFoundError:
            os.makedirs(os.path.dirname(self._path), exist_ok=True)
            file = os.open(self._path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o644)
        try:
            lines = os.read(file, 65536).decode().split("\n")[:-1]
            earlier = [one.split(" ")[1] for one in lines if one.startswith(self._run + " ")]
            pardoned = len(set(earlier) - {str(self._generation)})
            os.write(file, f"{self._run} {self._generation}\n".encode())
        finally:
            os.close(file)
        return len(earlier) - pardoned

    def end(self):
        with contextlib.suppress(FileNotFoundError):
            os.unlink(self._path)


@contextlib.contextmanager
def marked(folder, run):
    """The folder has the name of the run that writes there, as long as the block lasts."""
    path = os.path.join(folder, "run")
    write_whole(path, run.encode())
    try:
        yield
    finally:
        with contextlib.suppress(OSError):
            os.unlink(path)


def is_run(folder, run):
    """Whether this machine sees the folder in which `run` writes, under that path."""
    try:
        with open(os.path.join(folder, "run"), "rb") as stream:
            return stream.read() == run.encode()
    except OSError:
        return False


@contextlib.contextmanager
def output_folder(folder):
    """Makes the folder and holds its lock. Refuses one that has other files, or another writer."""
    folder = pathlib.Path(folder)
    try:
        if folder.exists():
            if not folder.is_dir():
                raise CampaignError(f"{folder}: is not a folder")
            if any(folder.iterdir()) and not (folder / "tasks").is_dir():
                raise CampaignError(
                    f"{folder}: has files that no campaign wrote; choose another with --out"
                )
        (folder / "tasks").mkdir(parents=True, exist_ok=True)
        with open(folder / "lock", "ab") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise CampaignError(f"{folder}: another campaign writes here") from None
            yield folder
    except OSError as error:
        raise CampaignError(f"{error.filename or folder}: {error.strerror}") from None
