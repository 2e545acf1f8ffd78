"""Leg types: one module each, with the same stages (see `uhp.py`, the paper's leg)."""

from . import uhp

LEG_TYPES = {"uhp": uhp}
