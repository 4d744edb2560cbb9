"""Arms as tasks have them: read from a file, their numbers by the keys of an arm file."""

import functools

import flexarm

from .errors import CampaignError


def read_arm(path):
    """The arm of a file; CampaignError has one line for the user."""
    try:
        return flexarm.read_arm(path)
    except flexarm.InputError as error:
        raise CampaignError(str(error)) from None


@functools.cache
def attributes():
    """The attribute of `flexarm.Arm` of each key, `payload.mass` of `payload_mass_kg`."""
    return {number.key: number.attribute for number in flexarm.arm_numbers()}
