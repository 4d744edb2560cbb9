"""Where tasks run: a cluster of this machine, or the scheduler of an address.

Both have the same members:

    client          the distributed.Client
    workers()       how many workers there are that can run the tasks
    only()          their addresses, where some cannot; None: any may have a task
    unfit()         why some cannot, by their addresses
    is_lost()       the scheduler is gone
    tend()          starts workers anew where some died
    close()         ends what was started
"""

import asyncio
import contextlib
import logging
import multiprocessing
import multiprocessing.connection
import os
import shutil
import signal
import tempfile
import threading
import time
import warnings

import dask
import distributed

from .errors import CampaignError

_START_S = 30.0  # of the processes of this machine, which may have other work
_CONNECT_S = 10.0
# Of the scheduler that is started here: blame is counted by the attempts of a task (task_files.py),
# and what it remembers is bounded.
_SETTINGS = {
    "distributed.scheduler.allowed-failures": 1_000_000,
    "distributed.scheduler.worker-saturation": 1.0,
    "distributed.scheduler.transition-log-length": 100,
    "distributed.scheduler.events-log-length": 100,
    "distributed.scheduler.events-cleanup-delay": "1s",
    "distributed.scheduler.http.routes": [],
    "distributed.worker.http.routes": [],
    "distributed.worker.profile.enabled": False,
    "distributed.admin.tick.limit": "60s",
    "distributed.comm.timeouts.connect": f"{_START_S}s",
}


def quiet():
    """The library's own messages do not stand among those of the campaign."""
    logging.disable(logging.CRITICAL)
    warnings.filterwarnings("ignore", category=DeprecationWarning, module="tornado|distributed")
    # Said where the machine has other work.
    warnings.filterwarnings("ignore", message="Creating scratch directories")


def _as_child():
    """Of a process that is started here: Ctrl-C is its parent's, and it ends with its parent."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    quiet()
    dask.config.set(_SETTINGS)
    parent = multiprocessing.parent_process().sentinel

    def watch():
        multiprocessing.connection.wait([parent])
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def _serve_scheduler(said):
    _as_child()

    async def serve():
        async with distributed.Scheduler(
            host="127.0.0.1", port=0, dashboard=False, dashboard_address="127.0.0.1:0"
        ) as scheduler:
            said.send(scheduler.address)
            await scheduler.finished()

    asyncio.run(serve())


def _serve_worker(address, core, memory_bytes, folder):
    _as_child()
    # The libraries make as many threads as the process has cores: one.
    os.sched_setaffinity(0, {core})
    from . import work  # noqa: F401  tasks have their modules before the first of them

    async def serve():
        worker = distributed.Worker(
            address,
            nthreads=1,
            memory_limit=memory_bytes,
            local_directory=folder,
            dashboard=False,
            host="127.0.0.1",
        )
        async with worker:
            await worker.finished()

    asyncio.run(serve())
    os._exit(0)


class LocalCluster:
    """A scheduler and workers, a process each, forked from one that has all modules loaded."""

    def __init__(self, count):
        self._start = multiprocessing.get_context("forkserver")
        self._start.set_forkserver_preload(["flexarm.campaign.cluster", "flexarm.campaign.work"])
        self._folder = tempfile.mkdtemp(prefix="flexarm-campaign-")
        self._cores = sorted(os.sched_getaffinity(0))
        pages = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
        self._memory_bytes = pages // count
        self._processes = [None] * count
        heard, said = self._start.Pipe(duplex=False)
        self._scheduler = self._start.Process(
            target=_serve_scheduler, args=(said,), daemon=True, name="campaign-scheduler"
        )
        self._scheduler.start()
        said.close()
        self.client = None
        try:
            self._address = heard.recv()
            self.tend()
            self.client = _connected_client(self._address, timeout=_START_S)
        except (EOFError, OSError):
            self.close()
            raise CampaignError("the scheduler of this machine does not start") from None

    def workers(self):
        return len(self._processes)

    def only(self):
        return None

    def unfit(self):
        return {}

    def is_lost(self):
        return not self._scheduler.is_alive() or self.client.status != "running"

    def tend(self):
        """Starts a worker for each that has ended; returns how many had."""
        ended = 0
        for number, process in enumerate(self._processes):
            if process is not None:
                if process.is_alive():
                    continue
                process.join()
                self._processes[number] = None
                ended += 1
            core = self._cores[number % len(self._cores)]
            fresh = self._start.Process(
                target=_serve_worker,
                args=(self._address, core, self._memory_bytes, self._folder),
                daemon=True,
                name=f"campaign-worker-{number}",
            )
            fresh.start()
            self._processes[number] = fresh
        return ended

    def close(self):
        _close_client(self.client)
        for process in [*self._processes, self._scheduler]:
            if process is not None:
                process.kill()
        for process in [*self._processes, self._scheduler]:
            if process is not None:
                process.join()
        shutil.rmtree(self._folder, ignore_errors=True)


class RemoteCluster:
    """The scheduler of `address`; its workers are its owner's.

    `why_unfit` is run in each worker, beside its tasks: it returns why the worker cannot run any,
    or None.
    """

    _LOOKS_EVERY_S = 2.0
    # What is amiss may be mended: a folder that was not mounted, or that NFS does not show yet.
    _ASKS_AGAIN_S = 10.0

    def __init__(self, address, why_unfit):
        self.client = None
        try:
            self.client = _connected_client(address, timeout=_CONNECT_S)
        except (OSError, ValueError, TypeError) as error:
            raise CampaignError(
                f"--scheduler {address}: no scheduler answers ({type(error).__name__})"
            ) from None
        self._why_unfit = why_unfit
        self._looked = -self._LOOKS_EVERY_S
        self._answers = {}  # worker's address: (time of the answer, why it is unfit or None)
        self._asked = {}  # worker's address: the answer to come

    def workers(self):
        now = time.monotonic()
        if now - self._looked >= self._LOOKS_EVERY_S:
            self._looked = now
            with contextlib.suppress(OSError, asyncio.TimeoutError):
                self._ask(self.client.scheduler_info()["workers"], now)
        for address in [one for one, answer in self._asked.items() if answer.done()]:
            self._hear(address, self._asked.pop(address), now)
        return sum(why is None for _, why in self._answers.values())

    def _ask(self, present, now):
        """Those that are new, and from time to time those that were unfit."""
        for gone in [one for one in self._answers if one not in present]:
            del self._answers[gone]
        for address in present:
            answered, why = self._answers.get(address, (-self._ASKS_AGAIN_S, ""))
            again = why is not None and now - answered >= self._ASKS_AGAIN_S
            if again and address not in self._asked:
                # One each: a machine that has vanished keeps none of the others waiting.
                self._asked[address] = asyncio.run_coroutine_threadsafe(
                    self.client._run(self._why_unfit, workers=[address], on_error="return"),
                    self.client.loop.asyncio_loop,
                )

    def _hear(self, address, answer, now):
        try:
            why = answer.result()[address]
        except (Exception, asyncio.CancelledError):
            return  # the connection is gone: asked at the next look
        if isinstance(why, (OSError, asyncio.TimeoutError)):
            return
        if isinstance(why, BaseException):  # it has no module flexarm, or one that is older
            why = f"worker {address}: {why}"
        self._answers[address] = (now, why)

    def exclude(self, address, why):
        """A worker said of itself that it cannot run tasks."""
        self._answers[address] = (time.monotonic(), why)

    def only(self):
        if not self.unfit():
            return None
        return [address for address, (_, why) in self._answers.items() if why is None]

    def unfit(self):
        return {address: why for address, (_, why) in self._answers.items() if why is not None}

    def is_lost(self):
        return self.client.status != "running"

    def tend(self):
        return 0

    def close(self):
        for answer in self._asked.values():
            answer.cancel()
        _close_client(self.client)


# The destructor of a client closes it again, under a lock that the start of the next may hold in the
# same thread: a client that is collected then stops the program for ever. So none is collected.
_kept_clients = []


def _connected_client(address, **options):
    """A client; it is closed and kept where its constructor fails, too."""
    client = distributed.Client.__new__(distributed.Client)
    _kept_clients.append(client)
    try:
        client.__init__(address, set_as_default=False, **options)
    except BaseException:
        _close_client(client)
        raise
    return client


def _close_client(client):
    """Without waiting for a scheduler that may be gone."""
    if client is not None:
        with contextlib.suppress(Exception):
            client.close(timeout=1)
