"""Effects as a campaign file names them: `time_delay`, `sensor_lag on hub_angle`."""

import flexarm

from .tables import suggestion


def effect_of(name):
    """The definition of an effect by its name, with or without a sensor, or None."""
    return {one.name: one for one in flexarm.effects()}.get(name.split(" on ")[0])


def effects_in(table, key, *default):
    """A list of effects in `table`; refuses those that flexarm does not have."""
    stated = table.texts(key, *default)
    known = [effect.name for effect in flexarm.effects()]
    for one in stated:
        if effect_of(one) is None:
            name = one.split(" on ")[0]
            table.fail(key, f"{name}: unknown effect{suggestion(name, known)}")
    return stated
