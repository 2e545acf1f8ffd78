"""6 x 6 linear systems written out, in the ways that dyn-gen writes them out."""

import itertools

import casadi as ca
import numpy as np


def lu(matrix, right, rows, columns):
    """Gaussian elimination in a fixed order of pivots, one reciprocal per pivot."""
    n = right.shape[0]
    a = [[matrix[i, j] for j in range(n)] for i in range(n)]
    b = [right[i] for i in range(n)]
    reciprocals = []
    for k in range(n):
        pivot = rows[k]
        reciprocals.append(1 / a[pivot][columns[k]])
        for row in rows[k + 1:]:
            factor = a[row][columns[k]] * reciprocals[k]
            for column in columns[k + 1:]:
                a[row][column] -= factor * a[pivot][column]
            b[row] -= factor * b[pivot]
    x = [None] * n
    for k in reversed(range(n)):
        remainder = b[rows[k]]
        for column in columns[k + 1:]:
            remainder -= a[rows[k]][column] * x[column]
        x[columns[k]] = remainder * reciprocals[k]
    return ca.vertcat(*x)


def ldl(matrix, right):
    """L D L^T of a symmetric positive definite matrix, lower triangle."""
    n = right.shape[0]
    a = [[matrix[i, j] for j in range(n)] for i in range(n)]
    x = [right[i] for i in range(n)]
    reciprocals = []
    for k in range(n):
        reciprocals.append(1 / a[k][k])
        column = [a[row][k] for row in range(n)]
        for row in range(k + 1, n):
            factor = column[row] * reciprocals[k]
            for inner in range(k + 1, row + 1):
                a[row][inner] -= factor * column[inner]
            x[row] -= factor * x[k]
            a[row][k] = factor
    for k in reversed(range(n)):
        x[k] *= reciprocals[k]
        for row in range(k + 1, n):
            x[k] -= a[row][k] * x[row]
    return ca.vertcat(*x)


def _adjugate(a):
    """Adjugate and determinant of a 3 x 3 matrix."""
    rows = [ca.cross(a[(k + 1) % 3, :].T, a[(k + 2) % 3, :].T) for k in range(3)]
    return ca.horzcat(*rows), ca.dot(a[0, :].T, rows[0])


def blocks(matrix, right, rows, columns):
    """Elimination by two 3 x 3 blocks: the first three of `rows` and `columns`, then the Schur complement of the rest.

    Two divisions follow one another instead of six.
    """
    top, bottom, left, rest = rows[:3], rows[3:], columns[:3], columns[3:]
    adjugate, determinant = _adjugate(matrix[top, left])
    inverse = adjugate * (1 / determinant)
    half = inverse @ matrix[top, rest]
    first = inverse @ right[top]
    schur = matrix[bottom, rest] - matrix[bottom, left] @ half
    adjugate, determinant = _adjugate(schur)
    second = (adjugate @ (right[bottom] - matrix[bottom, left] @ first)) * (1 / determinant)
    first = first - half @ second
    x = [None] * 6
    for k, column in enumerate(left):
        x[column] = first[k]
    for k, column in enumerate(rest):
        x[column] = second[k]
    return ca.vertcat(*x)


def block_order(matrices: np.ndarray):
    """Rows and columns whose first three make the block that is best conditioned at the worst of the given matrices."""
    whole = range(6)

    def worst(rows, columns):
        return np.linalg.cond(matrices[:, rows][:, :, columns]).max()

    halves = [list(half) for half in itertools.combinations(whole, 3)]
    rows, columns = min(((r, c) for r in halves for c in halves), key=lambda pair: worst(*pair))
    return tuple(part + [k for k in whole if k not in part] for part in (rows, columns))
