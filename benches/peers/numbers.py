"""Numbers from `dyn-gen resolve`, and inputs as CasADi symbols."""

import casadi as ca
import numpy as np

from derivation.export import matrix_shape
from derivation.symbols import LEG_COUNT, Symbol


def _slices(symbol: Symbol) -> int:
    return LEG_COUNT if symbol.per_leg else 1


def element_count(symbol: Symbol) -> int:
    """Numbers of a whole array, all legs."""
    rows, columns = matrix_shape(symbol.shape)
    return _slices(symbol) * rows * columns


def shaped(symbol: Symbol, flat) -> list[ca.SX]:
    """An array given flat and row-major as CasADi matrices: one per leg, or a single one."""
    rows, columns = matrix_shape(symbol.shape)
    size = rows * columns
    return [ca.reshape(flat[k * size:(k + 1) * size], columns, rows).T for k in range(_slices(symbol))]


def parameters(symbols: list[Symbol], platform: dict) -> dict[str, list[ca.SX]]:
    """Values of all parameters by name."""
    values = {}
    for symbol in symbols:
        if symbol.role == "parameter":
            flat = np.asarray(platform["parameters"][symbol.name], dtype=float).ravel()
            values[symbol.name] = shaped(symbol, ca.SX(ca.DM(flat)))
    return values


def inputs(symbols: list[Symbol], names) -> tuple[list[ca.SX], dict[str, list[ca.SX]]]:
    """The named inputs as flat columns of symbols, and by name in their shapes."""
    by_name = {symbol.name: symbol for symbol in symbols}
    flat = {name: ca.SX.sym(name, element_count(by_name[name])) for name in names}
    return list(flat.values()), {name: shaped(by_name[name], column) for name, column in flat.items()}
