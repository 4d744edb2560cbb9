"""Results of `flexarm diagnose --json` for the scripts that write docs/case-*.md."""
from document import number


def expect(where, diagnosis, verdict, causes, rivals=None):
    """Stops if the text of a document does not match the result of the program.
    `rivals`: effects that are indistinguishable from the first one."""
    found = [diagnosis["verdict"], [cause["effect"] for cause in diagnosis["causes"]]]
    said = [verdict, causes]
    if rivals is not None:
        found.append(diagnosis["causes"][0]["confusable_with"] if diagnosis["causes"] else None)
        said.append(rivals)
    if found != said:
        raise SystemExit(f"{where}: the text assumes {said}, the program gives {found}; revise "
                         "the text")


def verdict_of(diagnosis):
    return diagnosis["verdict"].replace("_", " ")


def cause_text(cause):
    """`effect`: its parameters with standard errors."""
    values = [f"{name} {number(p['value'], 4)} ± {number(p['std_error'], 2)}"
              + (f" {p['unit']}" if p["unit"] != "1" else "")
              for name, p in cause["parameters"].items()]
    sensor = f" of {cause['sensor']}" if cause.get("sensor") else ""
    return f"`{cause['effect']}`{sensor}, {', '.join(values)}"


def per_cent(part, digits=3):
    return number(None if part is None else 100 * part, digits)


def gain_text(gain):
    if gain is None:
        return "-"
    return f"{per_cent(gain['before'])} → {per_cent(gain['after'])} ({per_cent(gain['noise_floor'])})"


def cause_rows(diagnoses):
    """Header and rows of a table with one row per effect; `diagnoses` by their data."""
    rows = []
    for name, diagnosis in diagnoses.items():
        gain = diagnosis["gain"]
        head = [name, verdict_of(diagnosis)]
        tail = [gain_text(gain["estimation"]), gain_text(gain["validation"])]
        causes = diagnosis["causes"] or [None]
        for k, cause in enumerate(causes):
            row = head if k == 0 else ["", ""]
            row = row + ([cause_text(cause), per_cent(cause["explained_share"], 3),
                          ", ".join(cause["confusable_with"]) or "-"] if cause else ["none", "-", "-"])
            rows.append(row + (tail if k == 0 else ["", ""]))
    return ["data", "verdict", "identified effects", "explained share [%]",
            "indistinguishable from", "NRMSE, estimation [%] (noise floor)",
            "NRMSE, validation [%] (noise floor)"], rows
