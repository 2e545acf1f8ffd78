//! What legs of every type have: an actuator with a spring and a damper along it.

use super::{Place, Property};
use crate::keys::{Key, Range, Value};

/// d0.
pub(super) const REST_LENGTH: Property = Property::new(
    Key {
        name: "rest_length_m",
        value: Value::Number(Range::Any),
        meaning: "the actuator length at which the axial spring is relaxed, m",
        example: "rest_length_m = 0.198",
    },
    "rest_length",
    "m",
    Place::Legs,
);

/// k_e.
pub(super) const AXIAL_STIFFNESS: Property = Property::new(
    Key {
        name: "axial_stiffness_n_per_m",
        value: Value::Number(Range::NotNegative),
        meaning: "the axial stiffness of one actuator's springs, N/m",
        example: "axial_stiffness_n_per_m = 21555.9",
    },
    "axial_stiffness",
    "N/m",
    Place::Legs,
);

/// c_e.
pub(super) const AXIAL_DAMPING: Property = Property::new(
    Key {
        name: "axial_damping_n_s_per_m",
        value: Value::Number(Range::NotNegative),
        meaning: "the axial damping of one actuator, N s/m",
        example: "axial_damping_n_s_per_m = 0.0",
    },
    "axial_damping",
    "N s/m",
    Place::Legs,
);
