"""The command line of `python -m flexarm.campaign` and `flexarm-campaign`."""

import argparse
import importlib.util
import os
import pathlib
import signal
import sys

import flexarm
from flexarm import _progress

from .errors import CampaignError

_UNUSABLE = 2
_FAILED = 1
_INTERRUPTED = 128 + signal.SIGINT
_TERMINATED = 128 + signal.SIGTERM
_FAILURES_SHOWN = 10


class _Terminated(BaseException):
    pass


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        """One line, without the usage."""
        raise CampaignError(f"{message}; see flexarm-campaign --help")


def _count(text):
    value = int(text) if text.isdecimal() else 0
    if not 1 <= value <= 1024:
        raise argparse.ArgumentTypeError(f"{text}: must be a whole number from 1 to 1024")
    return value


def _parser():
    parser = _Parser(
        prog="flexarm-campaign",
        description="Run the tasks of a campaign file on all cores, or on the workers of a"
        " dask scheduler. What has a result already is not run again.",
        epilog="Exit status: 0 all tasks have a result; 1 some have not; 2 unusable input;"
        " 130 interrupted. Manual: docs/campaign.md",
        allow_abbrev=False,
    )
    parser.add_argument("file", metavar="CAMPAIGN", help="campaign file, campaign.toml")
    parser.add_argument(
        "--out", metavar="FOLDER", type=pathlib.Path,
        help="folder of the results; default: the name of the file with -results, beside it",
    )
    parser.add_argument(
        "--workers", metavar="N", type=_count,
        help="worker processes of this machine; default: one per core",
    )
    parser.add_argument(
        "--scheduler", metavar="ADDRESS",
        help="tcp://HOST:PORT of a dask scheduler that runs, in place of this machine",
    )
    parser.add_argument(
        "--hdf5", action="store_true", help="write results.h5 too, for tables larger than memory"
    )
    parser.add_argument(
        "--report", metavar="FILE", type=pathlib.Path,
        help="HTML file with a summary: failed, unexplained, worst and slowest tasks",
    )
    parser.add_argument("--version", action="version", version=f"flexarm {flexarm.__version__}")
    return parser


def _duration(seconds):
    if seconds < 100.0:
        return f"{seconds:.0f} s"
    if seconds < 6000.0:
        return f"{seconds / 60.0:.0f} min"
    return f"{seconds / 3600.0:.1f} h"


class _Line:
    """The progress of the campaign on standard error, where that is a terminal."""

    def __init__(self):
        self._line = _progress.line_of("campaign")

    def __call__(self, ended, total, failed, left_s):
        if self._line is None:
            return
        text = f"{ended} of {total} tasks" + (f", {failed} failed" if failed else "")
        if left_s is not None:
            text += f", {_duration(left_s)} left"
        self._line(ended / total, text)

    def hashed(self, count, total):
        if self._line is not None:
            self._line(count / total, f"files of {count} of {total} tasks hashed")

    def close(self):
        if self._line is not None:
            self._line.close()


def _print_summary(campaign, outcome, failures, out):
    """Failures first."""
    for one in failures[:_FAILURES_SHOWN]:
        print(f"task {one['index']} {one['state']}: {one['message']}")
    if len(failures) > _FAILURES_SHOWN:
        print(f"and {len(failures) - _FAILURES_SHOWN} more, in {out / 'failures.json'}")
    total = len(outcome.digests)
    counts = f"{total - len(failures)} of {total} tasks have a result"
    if outcome.before:
        counts += f", {outcome.before} of them from before"
    print(f"{campaign.name}: {counts}")
    print(f"results: {out / 'results.csv'}, {out / 'results.json'}")
    if failures:
        print(f"inputs of those without: {out / 'failures.json'}")


def _require_report(report, campaign_file):
    """What would fail hours later, or overwrite an input."""
    if report is None:
        return
    if not report.parent.is_dir():
        raise CampaignError(f"--report {report}: no such folder")
    if report.is_dir():
        raise CampaignError(f"--report {report}: is a folder")
    if report.suffix not in (".html", ".htm"):
        raise CampaignError(f"--report {report}: must end in .html")
    if report.exists() and report.samefile(campaign_file):
        raise CampaignError(f"--report {report}: is the campaign file")


def _run(arguments):
    from .campaign_file import read_campaign
    from .cluster import quiet
    from .hdf5 import ColumnTypes, write_hdf5
    from .merge import merge, results_of
    from .page import Page
    from .runner import Runner
    from .task_files import output_folder

    quiet()
    if arguments.scheduler is not None and arguments.workers is not None:
        raise CampaignError("--workers: the scheduler of --scheduler has its own")
    if arguments.hdf5 and not importlib.util.find_spec("h5py"):
        raise CampaignError(
            "--hdf5: the Python module h5py is missing: apt-get install python3-h5py"
        )
    campaign = read_campaign(arguments.file)
    _require_report(arguments.report, campaign.file)
    out = arguments.out or campaign.file.with_name(campaign.file.stem + "-results")
    line = _Line()
    with output_folder(out):
        runner = Runner(
            campaign,
            out,
            address=arguments.scheduler,
            workers=arguments.workers or len(os.sched_getaffinity(0)),
            progress=line,
            starting=lambda hashed: line.hashed(hashed, len(campaign.tasks)),
        )
        try:
            outcome = runner.run()
        except (KeyboardInterrupt, _Terminated):
            line.close()
            done = runner.outcome.before + runner.outcome.ended - len(runner.outcome.failures)
            print(
                f"flexarm-campaign: stopped with {done} of {len(campaign.tasks)} tasks done;"
                " the same command goes on from there",
                file=sys.stderr,
            )
            raise
        line.close()
        page, types = Page(campaign), ColumnTypes()

        def see(columns, row):
            page.see(columns, row)
            types.see(columns, row)

        failures = merge(campaign, outcome, out, see)
        if hasattr(campaign.kind, "finish"):
            campaign.kind.finish(results_of(campaign, outcome, out), campaign.folder, out)
        if arguments.hdf5:
            write_hdf5(campaign, outcome, out, types)
        if arguments.report is not None:
            page.write(arguments.report, out / "durations.csv", outcome.digests)
    _print_summary(campaign, outcome, failures, out)
    return _FAILED if failures else 0


def _terminate(number, frame):
    raise _Terminated


def main(arguments=None):
    """Runs a command line; returns the exit status."""
    missing = [one for one in ("dask", "distributed") if not importlib.util.find_spec(one)]
    if missing:
        print(
            f"flexarm-campaign: the Python module {missing[0]} is missing:"
            " apt-get install python3-distributed",
            file=sys.stderr,
        )
        return _UNUSABLE
    before = signal.signal(signal.SIGTERM, _terminate)
    try:
        return _run(_parser().parse_args(arguments))
    except CampaignError as error:
        print(f"flexarm-campaign: {error}", file=sys.stderr)
        return _UNUSABLE
    except OSError as error:
        print(f"flexarm-campaign: {error.filename}: {error.strerror}", file=sys.stderr)
        return _UNUSABLE
    except KeyboardInterrupt:
        return _INTERRUPTED
    except _Terminated:
        return _TERMINATED
    finally:
        signal.signal(signal.SIGTERM, before)


def console_script():
    sys.exit(main())
