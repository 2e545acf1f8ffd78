"""Leg types: one module each, with the same stages (see `uhp.py`, the paper's leg).

A leg type declares its symbols (`PARAMETERS`, `INTERMEDIATES`, `OUTPUTS`) and derives, stage by stage, what
`symbols.LEG_INTERFACE` lists for every leg and what `functions.py` asks for at its bodies and joints.
"""

from . import uhp, ups

LEG_TYPES = {"uhp": uhp, "ups": ups}
