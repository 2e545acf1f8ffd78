"""The base's prescribed motion in the coordinates that Exudyn constrains.

Exudyn holds a body's rotation since the start as Rx(alpha) Ry(beta) Rz(gamma). Angles, rates and second derivatives
follow exactly from rotation, angular velocity and angular acceleration, not by differences, because the constraint on
the base is only as exact as what it is given.
"""

import numpy as np

LARGEST_BETA = np.radians(80.0)  # the second angle is singular at a right angle


class TurnedTooFar(Exception):
    """The base leaves the range of its angles; `sample` numbers the first such entry of the series."""

    def __init__(self, sample):
        super().__init__(sample)
        self.sample = sample


def _sum(axes, rates):
    """sum_j axes[n][:, j] rates[n][j]."""
    return np.einsum("nij,nj->ni", axes, rates)


def angles_of(rotation):
    """[n][3] alpha, beta, gamma, continuous in time, of [n][3][3] rotations."""
    alpha = np.arctan2(-rotation[:, 1, 2], rotation[:, 2, 2])
    beta = np.arcsin(np.clip(rotation[:, 0, 2], -1.0, 1.0))
    gamma = np.arctan2(-rotation[:, 0, 1], rotation[:, 0, 0])
    return np.unwrap(np.column_stack([alpha, beta, gamma]), axis=0)


def axes_of(angles):
    """[n][3][3], columns: the axes about which alpha, beta and gamma turn, O coordinates."""
    alpha, beta = angles[:, 0], angles[:, 1]
    one, zero = np.ones_like(alpha), np.zeros_like(alpha)
    first = np.stack([one, zero, zero], axis=-1)
    second = np.stack([zero, np.cos(alpha), np.sin(alpha)], axis=-1)
    third = np.stack([np.sin(beta), -np.sin(alpha) * np.cos(beta), np.cos(alpha) * np.cos(beta)], axis=-1)
    return np.stack([first, second, third], axis=-1)


def guide_motion(position, rotation, velocity, acceleration):
    """Coordinates, rates and second derivatives of the base's six coordinates, [n][6] each; they start at zero.

    Base motion in O coordinates: [n][3] m, [n][3][3], [n][6] [r'; w], [n][6] [r''; w'].
    """
    angles = angles_of(rotation @ rotation[0].T)
    too_far = np.flatnonzero(np.abs(angles[:, 1]) > LARGEST_BETA)
    if too_far.size:
        raise TurnedTooFar(int(too_far[0]))
    axes = axes_of(angles)
    rates = np.linalg.solve(axes, velocity[:, 3:, None])[:, :, 0]
    # An axis is carried by the turns before it, so it changes by their angular velocity x axis.
    changing = np.zeros_like(axes)
    for j in (1, 2):
        changing[:, :, j] = np.cross(_sum(axes[:, :, :j], rates[:, :j]), axes[:, :, j])
    second = np.linalg.solve(axes, (acceleration[:, 3:] - _sum(changing, rates))[:, :, None])[:, :, 0]
    return (
        np.hstack([position - position[0], angles]),
        np.hstack([velocity[:, :3], rates]),
        np.hstack([acceleration[:, :3], second]),
    )
