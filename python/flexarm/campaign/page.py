"""The summary page of a campaign: one HTML file without scripts, for a browser or a printer."""

import collections
import csv
import heapq
import html
import os

from .task_files import write_whole

_IN_A_LIST = 20
_IN_THE_TABLE = 1000

_STYLE = """
:root { color-scheme: light dark; }
body { font: 15px/1.45 system-ui, sans-serif; margin: 2em auto; max-width: 76em; padding: 0 1em; }
h1 { font-size: 1.5em; } h2 { font-size: 1.15em; margin-top: 2em; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: .2em .8em .2em 0; border-bottom: 1px solid #8886; }
th { vertical-align: bottom; } td { vertical-align: top; } td.number { text-align: right; }
.counts strong { font-size: 1.3em; }
.bad { color: light-dark(#a3260b, #ff9a7a); }
footer { margin-top: 3em; font-size: .9em; }
"""


def _cell(value):
    if value is None or value == "":
        return "<td></td>"
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return f'<td class="number">{value:.6g}</td>'
    return f"<td>{html.escape(str(value))}</td>"


def _table(columns, rows, caption):
    head = "".join(f'<th scope="col">{html.escape(one)}</th>' for one in columns)
    body = "\n".join("<tr>" + "".join(map(_cell, row)) + "</tr>" for row in rows)
    return (
        f'<div class="scroll" role="region" aria-label="{html.escape(caption)}" tabindex="0">'
        f"<table><thead><tr>{head}</tr></thead>\n<tbody>{body}</tbody></table></div>"
    )


def _section(title, columns, rows, note=""):
    if not rows:
        return ""
    text = f"<p>{html.escape(note)}</p>" if note else ""
    return f"<section><h2>{html.escape(title)}</h2>{text}{_table(columns, rows, title)}</section>"


class Page:
    """Sees each merged row once and keeps what the page shows: its size is bounded."""

    def __init__(self, campaign):
        self._campaign = campaign
        kind = campaign.kind
        self._worst_by = getattr(kind, "WORST", None)
        self._flagged_by = getattr(kind, "FLAGGED", None)
        self._tally_of = getattr(kind, "TALLY", None)
        self._columns = []
        self._rows, self._failed, self._flagged, self._worst = [], [], [], []
        self._tally = collections.Counter()
        self._states = collections.Counter()
        self._flags = 0

    def see(self, columns, row):
        self._columns = columns
        cells = dict(zip(columns, row))
        self._states[cells["state"]] += 1
        if len(self._rows) < _IN_THE_TABLE:
            self._rows.append(row)
        if cells["state"] != "done":
            if len(self._failed) < _IN_A_LIST:
                self._failed.append(row)
            return
        if self._tally_of:
            self._tally[cells[self._tally_of]] += 1
        if self._flagged_by and cells[self._flagged_by[0]] in self._flagged_by[1]:
            self._flags += 1
            if len(self._flagged) < _IN_A_LIST:
                self._flagged.append(row)
        value = cells.get(self._worst_by)
        if value is not None:
            heapq.heappush(self._worst, (value, -row[0], row))
            if len(self._worst) > _IN_A_LIST:
                heapq.heappop(self._worst)

    def _slowest(self, durations, digests):
        """Rows of the tasks that took longest, the last run of each. The file may have tasks of an
        earlier campaign, too."""
        seconds = {}
        if os.path.exists(durations):
            with open(durations, newline="", encoding="utf-8") as stream:
                rows = csv.reader(stream)
                next(rows, None)  # the titles
                for row in rows:
                    if len(row) == 3 and int(row[0]) < len(digests):
                        if digests[int(row[0])].hex() == row[1]:
                            seconds[row[1]] = (float(row[2]), int(row[0]))
        longest = heapq.nlargest(_IN_A_LIST, ((value, key) for key, value in seconds.items()))
        total_s = sum(value for value, _ in seconds.values())
        return [[index, f"{key[:12]}…", value] for (value, index), key in longest], total_s

    def _counts(self, total_s):
        total = sum(self._states.values())
        without = total - self._states["done"]
        parts = [f"<strong>{self._states['done']}</strong> of {total} tasks have a result"]
        if without:
            parts.append(f'<strong class="bad">{without}</strong> have none')
        if self._flags:
            label = " or ".join(self._flagged_by[1]).replace("_", " ")
            parts.append(f'<strong class="bad">{self._flags}</strong> {html.escape(label)}')
        parts.append(f"{total_s:.3g} s of work")
        return '<p class="counts">' + "; ".join(parts) + ".</p>"

    def _shown(self, rows):
        """Columns and rows as the page has them: the message beside the state, without the hashes
        and what is empty in all rows."""
        order = [one for one in self._columns if one not in ("task", "message")]
        if order:
            order.insert(order.index("state") + 1, "message")
        places = [self._columns.index(one) for one in order]
        places = [one for one in places if any(row[one] not in (None, "") for row in rows)]
        return [self._columns[one] for one in places], [[row[one] for one in places] for row in rows]

    def write(self, path, durations, digests):
        """`digests` are those of the tasks, in their order."""
        campaign = self._campaign
        slowest, total_s = self._slowest(durations, digests)
        worst = [row for _, _, row in sorted(self._worst, reverse=True)]
        total = sum(self._states.values())
        more = f"The first {len(self._rows)} of {total}; results.csv has all." * (
            total > len(self._rows)
        )
        flagged = self._flagged_by[1] if self._flagged_by else []
        sections = [
            _section("Without a result", *self._shown(self._failed),
                     "Inputs are in failures.json."),
            _section(" and ".join(flagged).replace("_", " ").capitalize(),
                     *self._shown(self._flagged)),
            _section(f"Worst: largest {self._worst_by}", *self._shown(worst)),
            _section(f"Count of {self._tally_of}", [self._tally_of or "", "tasks"],
                     [[name, count] for name, count in self._tally.most_common()]),
            _section("Slowest", ["index", "task", "duration [s]"], slowest),
            _section("All tasks", *self._shown(self._rows), more),
        ]
        title = html.escape(f"Campaign {campaign.name}")
        text = (
            f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>{title}</title>\n'
            '<meta name="viewport" content="width=device-width">'
            f"<style>{_STYLE}</style></head>\n<body><main><h1>{title}</h1>\n"
            f"{self._counts(total_s)}\n" + "\n".join(one for one in sections if one) +
            f"</main>\n<footer>Kind {html.escape(campaign.kind_name)}. At most {_IN_A_LIST} tasks"
            " in a list.</footer></body></html>\n"
        )
        write_whole(path, text.encode())
