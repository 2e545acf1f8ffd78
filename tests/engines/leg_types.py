"""The leg types that the engines can build, by the name in platform files."""

import numpy as np

import uhp_leg
import ups_leg

LEG_TYPES = {"uhp": uhp_leg, "ups": ups_leg}


def leg_type_and_parameters(platform):
    """Module of a resolved platform's leg type, and its parameters as arrays."""
    parameters = {name: np.asarray(value, dtype=float) for name, value in platform["parameters"].items()}
    return LEG_TYPES[platform["leg_type"]], parameters
