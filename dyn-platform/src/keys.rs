//! The table of keys: spelling, meaning and an example of each. Messages and remedies are made from it.

/// A key of the platform file.
#[derive(Debug)]
pub(crate) struct Key {
    /// Spelling, with the unit at the end.
    pub name: &'static str,
    /// What its value is, as it reads after "give".
    pub meaning: &'static str,
    /// A line or table that may stand in a file.
    pub example: &'static str,
}

impl Key {
    /// The remedy when its value is absent or wrong.
    pub fn remedy(&self) -> String {
        format!("give {}, for example `{}`", self.meaning, self.example)
    }
}

/// Declares keys as constants: `IDENT = "name", "meaning", "example";`.
macro_rules! keys {
    ($($ident:ident = $name:literal, $meaning:literal, $example:literal;)*) => {
        $(pub(crate) const $ident: Key = Key { name: $name, meaning: $meaning, example: $example };)*
    };
}

keys! {
    VERSION = "version", "the version of the file format", "version = 1";
    NAME = "name", "a short name in lower case", r#"name = "my_platform""#;
    DESCRIPTION = "description", "a sentence for people", r#"description = "test bench""#;
    SOURCE = "source", "the origin of the numbers", r#"source = "measured""#;
    LEG_TYPE = "leg_type", "the build of the legs", r#"leg_type = "uhp""#;
    GRAVITY = "gravity_m_per_s2", "gravity in inertial axes, m/s^2", "gravity_m_per_s2 = [0.0, 0.0, -9.81]";
    HOME = "home", "the table of the home pose", "[home]";
    CIRCULAR_LAYOUT = "circular_layout", "the table of the joint circles", "[circular_layout]";
    LEGS = "legs", "the table of what all legs have in common", "[legs]";
    LEG = "leg", "one table per leg", "[[leg]]";
    PAYLOAD = "payload", "the table of the payload", "[payload]";
}

keys! {
    POSITION = "position_m",
        "the position of the platform's origin at home in base axes, m", "position_m = [0.0, 0.0, 0.4]";
    ROTATION = "rotation",
        "the rotation from platform to base axes, row by row",
        "rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]";
}

keys! {
    BASE_RADIUS = "base_radius_m", "the radius of the base's joint circle, m", "base_radius_m = 0.18";
    PLATFORM_RADIUS = "platform_radius_m",
        "the radius of the platform's joint circle, m", "platform_radius_m = 0.12";
    BASE_PAIR_ANGLE = "base_pair_angle_rad",
        "the angle between the two base joints of a pair, rad", "base_pair_angle_rad = 1.5";
    PLATFORM_PAIR_ANGLE = "platform_pair_angle_rad",
        "the angle between the two platform joints of a pair, rad", "platform_pair_angle_rad = 0.5";
}

keys! {
    LEG_NUMBER = "number", "the number of the leg, 1 to 6", "number = 1";
    BASE_POINT = "base_point_m",
        "the point in base axes where the actuator's axis starts, m", "base_point_m = [0.1, -0.1, 0.0]";
    PLATFORM_POINT = "platform_point_m",
        "the platform joint in platform axes, m", "platform_point_m = [0.1, -0.03, 0.0]";
    ACTUATOR_AXIS = "actuator_axis",
        "the unit vector along the actuator, from the base up, in base axes", "actuator_axis = [0.0, 0.0, 1.0]";
    ROD_LENGTH = "rod_length_m", "the rod's length from Hooke joint to platform joint, m", "rod_length_m = 0.206";
    ROD_MASS = "rod_mass_kg", "the mass of one rod, kg", "rod_mass_kg = 1.024";
    ROD_INERTIA = "rod_inertia_kg_m2",
        "the rod's transverse inertia about its centre of mass, kg m^2", "rod_inertia_kg_m2 = 0.0036";
    ROD_COM_FRACTION = "rod_com_fraction",
        "the place of the rod's centre of mass between Hooke joint (0) and platform joint (1)",
        "rod_com_fraction = 0.5";
    MOVER_MASS = "mover_mass_kg", "the moving mass of one actuator, kg", "mover_mass_kg = 0.611";
    MOVER_OFFSET = "mover_offset_m",
        "the distance of the mover's centre of mass below the Hooke joint, m", "mover_offset_m = 0.05";
    REST_LENGTH = "rest_length_m",
        "the actuator length at which the axial spring is relaxed, m", "rest_length_m = 0.198";
    AXIAL_STIFFNESS = "axial_stiffness_n_per_m",
        "the axial stiffness of one actuator's springs, N/m", "axial_stiffness_n_per_m = 21555.9";
    AXIAL_DAMPING = "axial_damping_n_s_per_m",
        "the axial damping of one actuator, N s/m", "axial_damping_n_s_per_m = 0.0";
}

keys! {
    PAYLOAD_MASS = "mass_kg", "the mass of platform and payload together, kg", "mass_kg = 6.1";
    PAYLOAD_COM = "com_m",
        "the centre of mass of platform and payload in platform axes, m", "com_m = [0.0, 0.0, 0.03]";
    PAYLOAD_INERTIA = "inertia_kg_m2",
        "the inertia about the centre of mass in platform axes, kg m^2",
        "inertia_kg_m2 = [[0.02, 0.0, 0.0], [0.0, 0.02, 0.0], [0.0, 0.0, 0.03]]";
}

/// Keys of the file itself.
pub(crate) const FILE: &[&Key] = &[
    &VERSION,
    &NAME,
    &DESCRIPTION,
    &SOURCE,
    &LEG_TYPE,
    &GRAVITY,
    &HOME,
    &CIRCULAR_LAYOUT,
    &LEGS,
    &LEG,
    &PAYLOAD,
];

/// Keys of `[home]`.
pub(crate) const IN_HOME: &[&Key] = &[&POSITION, &ROTATION];

/// Keys of `[circular_layout]`.
pub(crate) const IN_CIRCULAR_LAYOUT: &[&Key] =
    &[&BASE_RADIUS, &PLATFORM_RADIUS, &BASE_PAIR_ANGLE, &PLATFORM_PAIR_ANGLE];

/// Keys of `[legs]`: what a leg of type `uhp` may share with the others.
pub(crate) const IN_LEGS: &[&Key] = &[
    &ACTUATOR_AXIS,
    &ROD_LENGTH,
    &ROD_MASS,
    &ROD_INERTIA,
    &ROD_COM_FRACTION,
    &MOVER_MASS,
    &MOVER_OFFSET,
    &REST_LENGTH,
    &AXIAL_STIFFNESS,
    &AXIAL_DAMPING,
];

/// Keys that only `[[leg]]` has; those of `[legs]` may stand there too.
pub(crate) const ONLY_IN_LEG: &[&Key] = &[&LEG_NUMBER, &BASE_POINT, &PLATFORM_POINT];

/// Keys of `[payload]`.
pub(crate) const IN_PAYLOAD: &[&Key] = &[&PAYLOAD_MASS, &PAYLOAD_COM, &PAYLOAD_INERTIA];

/// Every table of a file with its keys: where a key that stands in the wrong place belongs.
pub(crate) const TABLES: [(&str, &[&Key]); 6] = [
    ("the part of the file before the first table", FILE),
    ("[home]", IN_HOME),
    ("[circular_layout]", IN_CIRCULAR_LAYOUT),
    ("[legs] or [[leg]]", IN_LEGS),
    ("[[leg]]", ONLY_IN_LEG),
    ("[payload]", IN_PAYLOAD),
];
