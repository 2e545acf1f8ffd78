"""Motion of base and platform in base coordinates: common to all leg types and all functions.

Actuators are fixed to the base, so in its coordinates their axes and base points are constants. A point y that moves
relative to the base has inertial acceleration A_B + G_b y + 2 w_b x y' + y'', weight included as -g in A_B.
"""

import casadi as ca

from .rotations import accelerated, acceleration_field, cross
from .stages import leg_stage, platform_stage


@platform_stage
def relative_pose(base_position, base_rotation, platform_position, platform_rotation):
    """pose of the platform relative to the base."""
    return {
        "relative_rotation": base_rotation.T @ platform_rotation,
        "relative_position": base_rotation.T @ (platform_position - base_position),
    }


@platform_stage
def relative_motion(base_rotation, base_velocity, platform_velocity, relative_position):
    """velocity of the platform relative to the base."""
    base_rate = base_rotation.T @ base_velocity[3:]
    platform_rate = base_rotation.T @ platform_velocity[3:]
    relative_rate = platform_rate - base_rate
    linear = base_rotation.T @ (platform_velocity[:3] - base_velocity[:3])
    return {
        "base_rate": base_rate,
        "platform_rate": platform_rate,
        "relative_rate": relative_rate,
        "relative_velocity": linear - cross(base_rate, relative_position),
    }


@platform_stage
def base_acceleration_field(base_rotation, base_acceleration, gravity, base_rate):
    """rigid acceleration field of the base, weight included."""
    derivative = base_rotation.T @ base_acceleration[3:]
    return {
        "base_origin_acceleration": base_rotation.T @ (base_acceleration[:3] - gravity),
        "base_rate_derivative": derivative,
        "base_field": acceleration_field(base_rate, derivative),
    }


@platform_stage
def platform_acceleration_field(base_rotation, platform_acceleration, gravity, platform_rate, relative_rotation):
    """rigid acceleration field of the platform, weight included."""
    derivative = base_rotation.T @ platform_acceleration[3:]
    return {
        "platform_origin_acceleration": base_rotation.T @ (platform_acceleration[:3] - gravity),
        "platform_rate_derivative": derivative,
        "platform_field": accelerated(platform_rate, derivative, relative_rotation),
    }


@platform_stage
def steady_base_field(base_rotation, gravity, base_rate):
    """acceleration field of a base that moves at constant speeds, weight included."""
    zero = ca.SX.zeros(3)
    return {
        "base_origin_acceleration": -(base_rotation.T @ gravity),
        "base_rate_derivative": zero,
        "base_field": acceleration_field(base_rate, zero),
    }


@platform_stage
def steady_platform_field(base_rotation, gravity, platform_rate, relative_rotation):
    """acceleration field of a platform that moves at constant speeds, weight included."""
    zero = ca.SX.zeros(3)
    return {
        "platform_origin_acceleration": -(base_rotation.T @ gravity),
        "platform_rate_derivative": zero,
        "platform_field": accelerated(platform_rate, zero, relative_rotation),
    }


@platform_stage
def trial_platform_field(platform_rate, relative_rotation):
    """acceleration field of a platform that falls freely without angular acceleration: the trial motion."""
    zero = ca.SX.zeros(3)
    return {
        "platform_origin_acceleration": zero,
        "platform_rate_derivative": zero,
        "platform_field": accelerated(platform_rate, zero, relative_rotation),
    }


@platform_stage
def relative_acceleration(
    relative_position, relative_velocity, relative_rate, base_rate, platform_rate,
    base_origin_acceleration, base_rate_derivative, base_field, platform_origin_acceleration, platform_rate_derivative,
):
    """acceleration of the platform relative to the base."""
    # 2 w_b x v, and w x v with the relative w: joints have w x v_joint instead of w x (w x lever).
    turning = cross(base_rate + platform_rate, relative_velocity)
    return {
        "turning_center_acceleration":
            platform_origin_acceleration - base_origin_acceleration - base_field @ relative_position - turning,
        "relative_rate_derivative": platform_rate_derivative - base_rate_derivative - cross(base_rate, relative_rate),
    }


@leg_stage
def joint_pose(relative_position, relative_rotation, platform_point, base_point):
    """platform joint relative to the base."""
    lever = relative_rotation @ platform_point
    return {"platform_lever": lever, "joint_vector": relative_position + lever - base_point}


@leg_stage
def joint_motion(relative_velocity, relative_rate, platform_lever):
    """velocity of the platform joint relative to the base."""
    return {"joint_velocity": relative_velocity + cross(relative_rate, platform_lever)}


@leg_stage
def joint_acceleration(
    turning_center_acceleration, relative_rate, relative_rate_derivative, platform_lever, joint_velocity,
):
    """acceleration of the platform joint relative to the base."""
    turning = cross(relative_rate_derivative, platform_lever) + cross(relative_rate, joint_velocity)
    return {"joint_acceleration": turning_center_acceleration + turning}
