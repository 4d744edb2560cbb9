"""Runs the tasks of a campaign: keeps a few in flight, counts what ended, goes on after a death."""

import asyncio
import concurrent.futures
import contextlib
import csv
import dataclasses
import functools
import queue
import secrets
import shutil
import sys
import time

from .cluster import LocalCluster, RemoteCluster
from .errors import CampaignError
from .file_digests import FileDigests
from .program import program_digest
from .task_files import finished, marked, task_digest
from .work import Shared, run_order, why_unfit

# So many orders a worker are with the scheduler: enough that none waits for the next, few enough
# that its memory does not grow with the campaign.
_IN_FLIGHT_PER_WORKER = 4
# Short tasks go out together, so many that an order takes some time, as long as there are orders
# for all workers.
_ORDER_TAKES_S = 0.05
# Command and scheduler spend some 2.5 ms on an order (docs/scale.md). With so many workers that they
# could not keep up, orders are larger: half of the time of both is left.
_ORDER_COSTS_S = 0.005
_MOST_IN_AN_ORDER = 32
_MOST_PER_WORKER = 0.1
_WEIGHT_OF_THE_LAST = 0.1
_LOOKS_EVERY_S = 0.2
_CONNECTS_EVERY_S = 2.0
_WITHOUT_WORKERS_S = 5.0
# Longer than NFS may take to show a new folder.
_WITHOUT_FIT_WORKERS_S = 90.0
_GATHERS_S = 5.0
# So many workers may die in a row, for each of them, without any task ending.
_DEATHS_IN_A_ROW = 20
_LOSSES_IN_A_ROW = 20
# What calls of a client raise when its scheduler goes.
_OF_A_LOST_CONNECTION = (
    OSError, RuntimeError, asyncio.CancelledError, concurrent.futures.CancelledError,
)


@dataclasses.dataclass
class Outcome:
    """What became of the tasks. `digests[i]` is of task i; `failures` has (state, message) by
    digest."""

    digests: list = dataclasses.field(default_factory=list)
    failures: dict = dataclasses.field(default_factory=dict)
    before: int = 0  # had a result when the run began
    ended: int = 0  # in this run, failures included


def order_size(mean_s, left, workers):
    """How many tasks of `mean_s` seconds go out as one order, of `left` for `workers`; 1 or more."""
    takes_s = max(_ORDER_TAKES_S, _ORDER_COSTS_S * workers)
    return max(
        min(
            takes_s / max(mean_s, 1e-6),
            left / (2 * _IN_FLIGHT_PER_WORKER * workers),
            max(_MOST_IN_AN_ORDER, _MOST_PER_WORKER * workers),
        ),
        1,
    )


class _Lost(Exception):
    """The scheduler is gone."""


class Runner:
    """Runs what has no result yet. `address` is that of a scheduler, or None for `workers` here.

    `progress` is called with (ended, total, failed, seconds left or None), before that `starting`
    with the number of tasks whose files have been hashed.
    """

    def __init__(
        self, campaign, out, *, address=None, workers=1, progress=lambda *_: None,
        starting=lambda hashed: None,
    ):
        self._campaign = campaign
        self._out = out
        self._address = address
        self._workers = workers
        self._progress = progress
        self._starting = starting
        self._run = secrets.token_hex(8)
        self._generation = 0
        self._serial = 0
        self._program = program_digest(campaign.kind)
        self._in_flight = {}  # key of a future: (future, [(index, digest, task), ...])
        self._again = []  # (index, digest, task) that a lost scheduler had
        self._ended = queue.SimpleQueue()
        self._nobody_since = None  # since when the scheduler has no worker for the tasks
        self._said_that_nobody = False
        self._said_unfit = set()
        self._mean_s = None  # duration of the last tasks
        self._deaths = 0  # of workers, since a task ended
        self._losses = 0  # of schedulers, likewise
        self._cluster = None
        self.outcome = Outcome()

    def run(self):
        """Returns the outcome. KeyboardInterrupt passes through; `outcome` has what there is."""
        shutil.rmtree(self._out / "attempts", ignore_errors=True)  # of runs that were interrupted
        done = self._known()
        self._waiting = self._without_result(done)
        self._begun = time.monotonic()
        self._next_task = next(self._waiting, None)
        if self._next_task is None:
            return self.outcome
        path = self._out / "durations.csv"
        with open(path, "a", newline="", encoding="utf-8") as stream:
            self._durations = csv.writer(stream, lineterminator="\n")
            if stream.tell() == 0:
                self._durations.writerow(["index", "task", "duration [s]"])
            try:
                with marked(self._out, self._run):
                    self._connect_first()
                    while self._turn():
                        pass
            finally:
                if self._cluster is not None:
                    self._cluster.close()
        return self.outcome

    def _known(self):
        """Finds the digest of each task, and which have a result."""
        done = finished(self._out)
        campaign = self._campaign
        with contextlib.closing(FileDigests(self._out / "file-digests.sqlite")) as digests:
            digest_of_file = functools.lru_cache(maxsize=100_000)(digests)
            for task in campaign.tasks:
                text = task_digest(
                    campaign.kind_name, campaign.kind, task, campaign.folder, self._program,
                    digest_of_file,
                )
                self.outcome.digests.append(bytes.fromhex(text))
                self._starting(len(self.outcome.digests))
        self.outcome.before = sum(one in done for one in self.outcome.digests)
        return done

    def _without_result(self, done):
        """Equal tasks have one result: only the first of them runs."""
        for index, (digest, task) in enumerate(zip(self.outcome.digests, self._campaign.tasks)):
            if digest not in done:
                done.add(digest)
                yield index, digest.hex(), task

    def _connect_first(self):
        """An address where nothing answers is an error at once."""
        try:
            self._connect()
        except CampaignError:
            if self._address is not None:
                raise
            self._connect_again()

    def _connect(self):
        if self._address is None:
            self._cluster = LocalCluster(self._workers)
        else:
            self._cluster = RemoteCluster(
                self._address, functools.partial(why_unfit, self._shared())
            )

    def _fill(self):
        """Submits as many orders as may be in flight; whether there is something to wait for."""
        workers = max(self._cluster.workers(), 1)
        if self._cluster.only() == []:
            return bool(self._in_flight or self._again or self._next_task is not None)
        fresh = []
        while len(self._in_flight) + len(fresh) < _IN_FLIGHT_PER_WORKER * workers:
            tasks = self._next_order(workers)
            if not tasks:
                break
            fresh.append(tasks)
        if fresh:
            self._submit(fresh)
        return bool(self._in_flight)

    def _next_order(self, workers):
        left = len(self.outcome.digests) - self.outcome.before - self.outcome.ended
        size = 1 if self._mean_s is None else order_size(self._mean_s, left, workers)
        tasks = []
        while len(tasks) < size:
            if self._again:
                tasks.append(self._again.pop())
            elif self._next_task is not None:
                tasks.append(self._next_task)
                self._next_task = next(self._waiting, None)
            else:
                break
        return tasks

    def _shared(self):
        return Shared(
            self._campaign.kind_name, str(self._campaign.folder), str(self._out.resolve()),
            self._run, self._generation, self._program,
        )

    def _submit(self, fresh):
        shared = self._shared()
        # Keys of one name are one group: what does not run yet waits at the scheduler, not at a
        # worker behind a long task.
        keys = [
            f"('flexarm-{self._run}-{self._generation}', {self._serial + i})"
            for i in range(len(fresh))
        ]
        self._serial += len(fresh)
        only = self._cluster.only()
        orders = [[one[1:] for one in tasks] for tasks in fresh]
        try:
            futures = self._cluster.client.map(
                functools.partial(run_order, shared), orders, key=keys, pure=False,
                # If all of these go, others may have what they had: they say what they cannot do.
                workers=only, allow_other_workers=only is not None,
            )
        except _OF_A_LOST_CONNECTION as error:
            self._again += [one for tasks in fresh for one in tasks]
            raise _Lost from error
        for future, tasks in zip(futures, fresh):
            self._in_flight[future.key] = (future, tasks)
            future.add_done_callback(lambda ended: self._ended.put(ended.key))

    def _turn(self):
        """Submits, waits for orders to end, and notes them; whether there is more to do."""
        try:
            if not self._fill():
                return False
            keys = self._some_ended()
            results = self._results_of([self._in_flight[key][0] for key in keys])
        except _Lost:
            self._begin_again()
            return True
        for key in keys:
            _, tasks = self._in_flight.pop(key)
            if key not in results:
                # Cancelled, or given up by a scheduler that blames tasks beside the one that ended
                # the worker: the attempts of the task say when it is enough.
                self._again += tasks
                continue
            if isinstance(results[key], tuple):
                self._exclude(*results[key], tasks)
                continue
            for (index, digest, _), result in zip(tasks, results[key]):
                self._note(index, digest, *result)
        self._show()
        return True

    def _exclude(self, worker, why, tasks):
        """`tasks` came back from a worker that cannot run them."""
        if self._address is not None:
            self._cluster.exclude(worker, why)
            self._again += tasks
            return
        for index, digest, _ in tasks:  # the module or the folder was changed meanwhile
            self._note(index, digest, "failed", 0.0, why)

    def _note(self, index, digest, state, seconds, message):
        self._deaths = self._losses = 0
        self.outcome.ended += 1
        before_s = seconds if self._mean_s is None else self._mean_s
        self._mean_s = before_s + _WEIGHT_OF_THE_LAST * (seconds - before_s)
        self._durations.writerow([index, digest, f"{seconds:.6f}"])
        if state != "done":
            self.outcome.failures[bytes.fromhex(digest)] = (state, message)

    def _some_ended(self):
        """Keys of futures that ended, as they come within a look; raises _Lost."""
        keys = []
        try:
            keys.append(self._ended.get(timeout=_LOOKS_EVERY_S))
            while True:
                keys.append(self._ended.get_nowait())
        except queue.Empty:
            pass
        self._tend()
        return [key for key in keys if key in self._in_flight]

    def _results_of(self, futures):
        """What tasks returned, by key, without those that have no result."""
        whole = [one for one in futures if one.status == "finished"]
        if not whole:
            return {}
        client = self._cluster.client
        # A worker may die between its task and this: then it runs again, on a worker that has to
        # be started meanwhile.
        gathered = asyncio.run_coroutine_threadsafe(
            client._gather(whole, errors="skip"), client.loop.asyncio_loop
        )
        deadline = time.monotonic() + _GATHERS_S
        while True:
            if time.monotonic() > deadline:
                # The library may wait for ever for what a dead worker had. Run again, a task that
                # has its file ends at once.
                gathered.cancel()
                return {}
            try:
                values = gathered.result(timeout=_LOOKS_EVERY_S)
            except TimeoutError as error:
                if gathered.done():
                    raise _Lost from error
                self._tend()
                continue
            except _OF_A_LOST_CONNECTION as error:
                raise _Lost from error
            # A future that was cancelled meanwhile is skipped, and the list says not which.
            if len(values) != len(whole):
                return {}
            return {one.key: value for one, value in zip(whole, values)}

    def _tend(self):
        if self._cluster.is_lost():
            raise _Lost
        self._deaths += self._cluster.tend()
        self._say_if_nobody_works()
        if self._deaths > _DEATHS_IN_A_ROW * self._workers:
            raise CampaignError(
                f"{self._deaths} workers died one after another and no task ended;"
                " see whether this machine has memory and disk space"
            )
        self._show()

    def _say_if_nobody_works(self):
        some = self._cluster.workers() > 0
        unfit = self._cluster.unfit()
        for why in sorted(set(unfit.values()) - self._said_unfit):
            self._said_unfit.add(why)
            _say(f"{why}; gets no task as long as that is so")
        now = time.monotonic()
        if some:
            self._nobody_since = None
            self._said_that_nobody = False
        elif self._nobody_since is None:
            self._nobody_since = now
        elif unfit and now - self._nobody_since > _WITHOUT_FIT_WORKERS_S:
            raise CampaignError(
                f"scheduler {self._address}: no worker can run the tasks, {len(unfit)} cannot"
            )
        elif not unfit and now - self._nobody_since > _WITHOUT_WORKERS_S:
            if not self._said_that_nobody:
                self._said_that_nobody = True
                _say(f"scheduler {self._address}: has no worker; waiting for one, Ctrl-C stops")

    def _begin_again(self):
        """After the death of a scheduler: all that was in flight, with a new one."""
        self._again += [one for _, tasks in self._in_flight.values() for one in tasks]
        self._in_flight.clear()
        self._ended = queue.SimpleQueue()
        self._cluster.close()
        where = f"scheduler {self._address}: connection lost; trying again, Ctrl-C stops"
        _say("the scheduler died; a new one goes on" if self._address is None else where)
        self._connect_again()
        if self._address is not None:
            _say(f"scheduler {self._address}: connected again")

    def _connect_again(self):
        while True:
            self._generation += 1
            self._losses += 1
            if self._address is None and self._losses > _LOSSES_IN_A_ROW:
                raise CampaignError(f"{self._losses} schedulers died and no task ended meanwhile")
            try:
                self._connect()
                return
            except CampaignError:
                # One here died as it started; one elsewhere may be started again in hours.
                if self._address is not None:
                    time.sleep(_CONNECTS_EVERY_S)

    def _show(self):
        outcome = self.outcome
        total = len(outcome.digests)
        ended = outcome.before + outcome.ended
        left_s = None
        if outcome.ended:
            elapsed_s = time.monotonic() - self._begun
            left_s = elapsed_s / outcome.ended * (total - ended)
        self._progress(ended, total, len(outcome.failures), left_s)


def _say(text):
    print(f"flexarm-campaign: {text}", file=sys.stderr, flush=True)
