"""Vectors, rotations and rigid motion: cross products, skew matrices, fields of velocity and acceleration."""

import casadi as ca


def skew(v: ca.SX) -> ca.SX:
    """S(v) with S(v) y = v x y."""
    return ca.skew(v)


def cross(a: ca.SX, b: ca.SX) -> ca.SX:
    """a x b."""
    return ca.cross(a, b)


def dot(a: ca.SX, b: ca.SX) -> ca.SX:
    """a . b"""
    return ca.dot(a, b)


def outer(a: ca.SX, b: ca.SX) -> ca.SX:
    """a b^T"""
    return a @ b.T


def symmetric(matrix: ca.SX) -> ca.SX:
    """The symmetric matrix whose upper triangle is that of `matrix`."""
    size = matrix.shape[0]
    return ca.blockcat([[matrix[min(i, j), max(i, j)] for j in range(size)] for i in range(size)])


def acceleration_field(rate: ca.SX, rate_derivative: ca.SX) -> ca.SX:
    """S(w') + S(w) S(w): accelerations of the points of a rigid body per vector from its origin."""
    x, y, z = rate[0], rate[1], rate[2]
    squares = ca.vertcat(x * x, y * y, z * z)
    products = ca.vertcat(y * z, z * x, x * y)
    centripetal = ca.blockcat([
        [-(squares[1] + squares[2]), products[2], products[1]],
        [products[2], -(squares[0] + squares[2]), products[0]],
        [products[1], products[0], -(squares[0] + squares[1])],
    ])
    return centripetal + skew(rate_derivative)


def accelerated(rate: ca.SX, rate_derivative: ca.SX, vectors: ca.SX) -> ca.SX:
    """w' x y + w x (w x y) for each column y of `vectors`: `acceleration_field` times them, vector by vector."""
    columns = (vectors[:, k] for k in range(vectors.shape[1]))
    return ca.horzcat(*(cross(rate_derivative, y) + cross(rate, cross(rate, y)) for y in columns))


def levers_cross(rotation: ca.SX, moments: ca.SX) -> ca.SX:
    """sum_k e_k x m_k for the columns e_k of `rotation` and m_k of `moments`.

    With m_k = sum_i p_ik f_i this is sum_i (R p_i) x f_i: the moment of forces on points p_i of a rotated body.
    """
    return cross(rotation[:, 0], moments[:, 0]) + cross(rotation[:, 1], moments[:, 1]) + cross(rotation[:, 2], moments[:, 2])
