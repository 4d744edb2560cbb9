"""Commands that write, as they are put under stress: their arguments and what they leave."""

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Command:
    """`arguments` are those of flexarm, in a folder that has `data` of the repository in it."""

    name: str
    arguments: tuple[str, ...]
    outputs: tuple[str, ...]  # files and folders that it writes
    draws: bool = False       # needs gnuplot
    checkpoint: str = ""      # file of its folder from which it goes on with --resume

    def again(self) -> tuple[str, ...]:
        """The arguments of a run after one that was killed."""
        return (*self.arguments, "--resume") if self.checkpoint else self.arguments


COMMANDS = (
    Command("new", ("new", "rig.toml"), ("rig.toml",)),
    Command("modes", ("modes", "data/paper/arm.toml", "--out", "modes", "--json", "modes.json"),
            ("modes", "modes.json"), draws=True),
    Command("response", ("response", "data/paper/arm.toml", "--out", "response", "--json", "response.json"),
            ("response", "response.json"), draws=True),
    Command("state-space-json", ("response", "data/paper/arm.toml", "--state-space", "arm.json"), ("arm.json",)),
    Command("state-space-csv", ("response", "data/paper/arm.toml", "--state-space", "arm.csv"), ("arm.csv",)),
    Command("state-space-mat", ("response", "data/paper/arm.toml", "--state-space", "arm.mat"), ("arm.mat",)),
    Command("simulate", ("simulate", "data/paper/arm.toml", "--duration", "2", "--out", "runs"), ("runs",), draws=True),
    Command("compare", ("compare", "data/paper/arm.toml", "--quick", "--out", "compared", "--report", "compared.html"),
            ("compared", "compared.html"), draws=True),
    Command("sweep", ("sweep", "data/paper/arm.toml", "--over", "payload.mass=0:0.5:200", "--out", "swept"),
            ("swept",), draws=True, checkpoint="sweep.checkpoint"),
    Command("import", ("import", "data/ruler/random-low.csv", "--arm", "data/plans/arm.toml", "--out", "bench"), ("bench",)),
    Command("save-as-mat", ("import", "data/ruler/random-low.csv", "--save-as", "run.mat"), ("run.mat",)),
    Command("save-as-uff", ("import", "data/ruler/random-low.csv", "--save-as", "run.uff"), ("run.uff",)),
    Command("identify", ("identify", "imported/measurement.toml", "--out", "identified", "--report", "identified.html"),
            ("identified", "identified.html"), draws=True),
    Command("diagnose", ("diagnose", "imported/measurement.toml", "--effects", "coulomb_friction", "--out", "diagnosis",
                         "--json", "diagnosis.json", "--report", "diagnosis.html"),
            ("diagnosis", "diagnosis.json", "diagnosis.extended.toml", "diagnosis.html"), draws=True),
    Command("plan", ("plan", "data/plans/arm.toml", "data/plans/hub-response.toml", "--out", "planned",
                     "--write", "improved.toml"), ("planned", "improved.toml"), draws=True),
    Command("fmu", ("export", "data/paper/arm.toml", "--fmu", "--out", "arm.fmu"), ("arm.fmu",)),
    Command("samples", ("export", "data/paper/arm.toml", "--state-space", "samples.mat"), ("samples.mat",)),
    Command("paper", ("paper", "--out", "paper", "--json", "paper.json"), ("paper", "paper.json")),
)


def bytes_of(path: Path) -> dict[str, bytes] | None:
    """A file, or the files of a folder, by name; None where nothing stands there."""
    if path.is_dir():
        return {str(file.relative_to(path)): file.read_bytes() for file in sorted(path.rglob("*")) if file.is_file()}
    return {"": path.read_bytes()} if path.exists() else None
