"""Runs the tasks of a campaign: keeps a few in flight, counts what ended, goes on after a death."""

import asyncio
import concurrent.futures
import csv
import dataclasses
import functools
import queue
import secrets
import sys
import time

from .cluster import LocalCluster, RemoteCluster
from .errors import CampaignError
from .program import program_digest
from .task_files import file_digest, finished, task_digest
from .work import Order, run_task

# So many tasks a worker are with the scheduler: enough that none waits for the next, few enough
# that its memory does not grow with the campaign.
_IN_FLIGHT_PER_WORKER = 4
_LOOKS_EVERY_S = 0.2
_CONNECTS_EVERY_S = 2.0
# So many workers may die in a row, for each of them, without any task ending.
_DEATHS_IN_A_ROW = 20


@dataclasses.dataclass
class Outcome:
    """What became of the tasks. `digests[i]` is of task i; a failure is (state, message)."""

    digests: list = dataclasses.field(default_factory=list)
    failures: dict = dataclasses.field(default_factory=dict)
    before: int = 0  # had a result when the run began
    ended: int = 0  # in this run, failures included


class _Lost(Exception):
    """The scheduler is gone."""


class Runner:
    """Runs what has no result yet. `address` is that of a scheduler, or None for `workers` here.

    `progress` is called with (ended, total, failed, seconds left or None).
    """

    def __init__(self, campaign, out, *, address=None, workers=1, progress=lambda *_: None):
        self._campaign = campaign
        self._out = out
        self._address = address
        self._workers = workers
        self._progress = progress
        self._run = secrets.token_hex(8)
        self._generation = 0
        self._serial = 0
        self._program = program_digest(campaign.kind)
        self._in_flight = {}  # key of a future: (future, index, digest, task)
        self._again = []  # (index, digest, task) that a lost scheduler had
        self._ended = queue.SimpleQueue()
        self._deaths = 0
        self._cluster = None
        self.outcome = Outcome()

    def run(self):
        """Returns the outcome. KeyboardInterrupt passes through; `outcome` has what there is."""
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
                self._connect()
                while self._fill():
                    self._turn()
            finally:
                if self._cluster is not None:
                    self._cluster.close()
        return self.outcome

    def _known(self):
        """Finds the digest of each task, and which have a result."""
        done = finished(self._out)
        digest_of_file = functools.lru_cache(maxsize=100_000)(file_digest)
        campaign = self._campaign
        for task in campaign.tasks:
            text = task_digest(
                campaign.kind_name, campaign.kind, task, campaign.folder, self._program,
                digest_of_file,
            )
            self.outcome.digests.append(bytes.fromhex(text))
        self.outcome.before = sum(one in done for one in self.outcome.digests)
        return done

    def _without_result(self, done):
        """Equal tasks have one result: only the first of them runs."""
        for index, (digest, task) in enumerate(zip(self.outcome.digests, self._campaign.tasks)):
            if digest not in done:
                done.add(digest)
                yield index, digest.hex(), task

    def _connect(self):
        if self._address is None:
            self._cluster = LocalCluster(self._workers)
        else:
            self._cluster = RemoteCluster(self._address)

    def _fill(self):
        """Submits as many tasks as may be in flight; whether some are."""
        room = _IN_FLIGHT_PER_WORKER * max(self._cluster.workers(), 1) - len(self._in_flight)
        fresh = []
        while len(fresh) < room:
            if self._again:
                fresh.append(self._again.pop())
            elif self._next_task is not None:
                fresh.append(self._next_task)
                self._next_task = next(self._waiting, None)
            else:
                break
        if fresh:
            self._submit(fresh)
        return bool(self._in_flight or self._again)

    def _submit(self, fresh):
        order = Order(
            self._campaign.kind_name, str(self._campaign.folder), str(self._out.resolve()),
            self._run, self._generation, self._program,
        )
        # Keys of one name are one group: what does not run yet waits at the scheduler, not at a
        # worker behind a long task.
        keys = [
            f"('flexarm-{self._run}-{self._generation}', {self._serial + i})"
            for i in range(len(fresh))
        ]
        self._serial += len(fresh)
        futures = self._cluster.client.map(
            functools.partial(run_task, order), [one[1] for one in fresh],
            [one[2] for one in fresh], key=keys, pure=False,
        )
        for future, one in zip(futures, fresh):
            self._in_flight[future.key] = (future, *one)
            future.add_done_callback(lambda ended: self._ended.put(ended.key))

    def _turn(self):
        """Waits for tasks to end, and notes them."""
        try:
            keys = self._some_ended()
            results = self._results_of([self._in_flight[key][0] for key in keys])
        except _Lost:
            self._begin_again()
            return
        for key in keys:
            _, index, digest, task = self._in_flight.pop(key)
            if key not in results:
                # Cancelled, or given up by a scheduler that blames tasks beside the one that ended
                # the worker: the attempts of the task say when it is enough.
                self._again.append((index, digest, task))
                continue
            self._note(index, digest, *results[key])
        self._show()

    def _note(self, index, digest, state, seconds, message):
        self._deaths = 0
        self.outcome.ended += 1
        self._durations.writerow([index, digest, f"{seconds:.6f}"])
        if state != "done":
            self.outcome.failures[index] = (state, message)

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
        while True:
            try:
                values = gathered.result(timeout=_LOOKS_EVERY_S)
            except concurrent.futures.TimeoutError:
                self._tend()
                continue
            except (concurrent.futures.CancelledError, asyncio.CancelledError):
                return {}
            # Those skipped are missing in the list: it is as long as the futures, or asked singly.
            if len(values) == len(whole):
                return {one.key: value for one, value in zip(whole, values)}
            return {one.key: one.result() for one in whole if one.status == "finished"}

    def _tend(self):
        if self._cluster.is_lost():
            raise _Lost
        self._deaths += self._cluster.tend()
        if self._deaths > _DEATHS_IN_A_ROW * self._workers:
            raise CampaignError(
                f"{self._deaths} workers died one after another and no task ended;"
                " see whether this machine has memory and disk space"
            )
        self._show()

    def _begin_again(self):
        """After the death of a scheduler: all that was in flight, with a new one."""
        self._again += [one[1:] for one in self._in_flight.values()]
        self._in_flight.clear()
        self._ended = queue.SimpleQueue()
        self._generation += 1
        self._cluster.close()
        if self._address is None:
            _say("the scheduler died; a new one goes on")
            self._connect()
            return
        _say(f"scheduler {self._address}: connection lost; trying again, Ctrl-C stops")
        while True:
            try:
                self._connect()
                _say(f"scheduler {self._address}: connected again")
                return
            except CampaignError:
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
