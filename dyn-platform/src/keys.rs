//! The tables of keys: spelling, value, meaning and an example of each. Reading, messages and remedies are made from
//! them. What a leg is made of stands in the table of its type, in [`legs`].

use crate::legs;
use crate::platform::LegType;

/// A key of the platform file.
#[derive(Debug)]
pub(crate) struct Key {
    /// Spelling, with the unit at the end.
    pub name: &'static str,
    /// What may stand behind it.
    pub value: Value,
    /// What its value is, as it reads after "give".
    pub meaning: &'static str,
    /// A line or table that may stand in a file.
    pub example: &'static str,
}

/// What may stand behind a key.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Value {
    /// The version of the format.
    Version,
    /// Text for people.
    Text,
    /// Text that can name a generated module.
    Name,
    /// Name of a leg type.
    LegType,
    /// 1 to 6.
    LegNumber,
    /// One number.
    Number(Range),
    /// Three numbers.
    Vector,
    /// Three numbers of length one.
    UnitVector,
    /// A proper rotation, row by row.
    Rotation,
    /// The inertia tensor of a real body.
    Inertia,
    /// A table.
    Table,
    /// An array of tables.
    Tables,
}

/// Where a number must lie.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Range {
    /// Anywhere.
    Any,
    /// Above zero.
    Positive,
    /// Zero or above.
    NotNegative,
    /// 0 to 1.
    Fraction,
    /// From 0 to less than 2 pi: between two joints of a pair.
    PairAngle,
    /// Between 0 and pi: how far a joint may turn to each side.
    JointAngle,
}

impl Key {
    /// The remedy when its value is absent or wrong.
    pub fn remedy(&self) -> String {
        format!("give {}, for example `{}`", self.meaning, self.example)
    }
}

/// Declares keys as constants: `IDENT = "name", value, "meaning", "example";`.
macro_rules! keys {
    ($($ident:ident = $name:literal, $value:expr, $meaning:literal, $example:literal;)*) => {
        $(pub(crate) const $ident: Key =
            Key { name: $name, value: $value, meaning: $meaning, example: $example };)*
    };
}

keys! {
    VERSION = "version", Value::Version,
        "the version of the file format (a draft without one must first be brought into the form of \
         docs/platform-file.md)",
        "version = 1";
    NAME = "name", Value::Name, "a short name in lower case", r#"name = "my_platform""#;
    DESCRIPTION = "description", Value::Text, "a sentence for people", r#"description = "test bench""#;
    SOURCE = "source", Value::Text, "the origin of the numbers", r#"source = "measured""#;
    LEG_TYPE = "leg_type", Value::LegType, "the build of the legs", r#"leg_type = "uhp""#;
    GRAVITY = "gravity_m_per_s2", Value::Vector,
        "gravity in inertial axes, m/s^2", "gravity_m_per_s2 = [0.0, 0.0, -9.81]";
    HOME = "home", Value::Table, "the table of the home pose", "[home]";
    CIRCULAR_LAYOUT = "circular_layout", Value::Table, "the table of the joint circles", "[circular_layout]";
    LEGS = "legs", Value::Table, "the table of what all legs have in common", "[legs]";
    LEG = "leg", Value::Tables, "one table per leg", "[[leg]]";
    PAYLOAD = "payload", Value::Table, "the table of the payload", "[payload]";
}

keys! {
    POSITION = "position_m", Value::Vector,
        "the position of the platform's origin at home in base axes, m", "position_m = [0.0, 0.0, 0.4]";
    ROTATION = "rotation", Value::Rotation,
        "the rotation from platform to base axes, row by row",
        "rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]";
}

keys! {
    BASE_RADIUS = "base_radius_m", Value::Number(Range::Positive),
        "the radius of the base's joint circle, m", "base_radius_m = 0.18";
    PLATFORM_RADIUS = "platform_radius_m", Value::Number(Range::Positive),
        "the radius of the platform's joint circle, m", "platform_radius_m = 0.12";
    BASE_PAIR_ANGLE = "base_pair_angle_rad", Value::Number(Range::PairAngle),
        "the angle between the two base joints of a pair, rad", "base_pair_angle_rad = 1.5";
    PLATFORM_PAIR_ANGLE = "platform_pair_angle_rad", Value::Number(Range::PairAngle),
        "the angle between the two platform joints of a pair, rad", "platform_pair_angle_rad = 0.5";
}

keys! {
    LEG_NUMBER = "number", Value::LegNumber, "the number of the leg, 1 to 6", "number = 1";
}

keys! {
    MINIMUM_LENGTH = "minimum_length_m", Value::Number(Range::Any),
        "the shortest length of the actuator, m", "minimum_length_m = 0.18";
    MAXIMUM_LENGTH = "maximum_length_m", Value::Number(Range::Any),
        "the longest length of the actuator, m", "maximum_length_m = 0.22";
    MAXIMUM_VELOCITY = "maximum_velocity_m_per_s", Value::Number(Range::Positive),
        "the highest speed of the actuator, m/s", "maximum_velocity_m_per_s = 0.5";
    MAXIMUM_FORCE = "maximum_force_n", Value::Number(Range::Positive),
        "the largest force of the actuator, either way, N", "maximum_force_n = 200.0";
    FORCE_CONSTANT = "force_constant_n_per_a", Value::Number(Range::Positive),
        "the force of the voice coil per current, N/A", "force_constant_n_per_a = 25.0";
    MAXIMUM_HOOKE_JOINT_ANGLE = "maximum_hooke_joint_angle_rad", Value::Number(Range::JointAngle),
        "the largest angle between the rod and its direction at home, seen from the base, rad",
        "maximum_hooke_joint_angle_rad = 0.35";
    MAXIMUM_PLATFORM_JOINT_ANGLE = "maximum_platform_joint_angle_rad", Value::Number(Range::JointAngle),
        "the largest angle between the rod and its direction at home, seen from the platform, rad",
        "maximum_platform_joint_angle_rad = 0.35";
}

keys! {
    PAYLOAD_MASS = "mass_kg", Value::Number(Range::Positive),
        "the mass of platform and payload together, kg", "mass_kg = 6.1";
    PAYLOAD_COM = "com_m", Value::Vector,
        "the centre of mass of platform and payload in platform axes, m", "com_m = [0.0, 0.0, 0.03]";
    PAYLOAD_INERTIA = "inertia_kg_m2", Value::Inertia,
        "the inertia about the centre of mass in platform axes, kg m^2",
        "inertia_kg_m2 = [[0.02, 0.0, 0.0], [0.0, 0.02, 0.0], [0.0, 0.0, 0.03]]";
    PART = "part", Value::Tables, "one table per rigid part of the payload", "[[payload.part]]";
}

keys! {
    PART_NAME = "name", Value::Text, "a name for people", r#"name = "camera""#;
    PART_MASS = "mass_kg", Value::Number(Range::Positive), "the mass of the part, kg", "mass_kg = 1.2";
    PART_COM = "com_m", Value::Vector,
        "the part's centre of mass in platform axes, m", "com_m = [0.0, 0.05, 0.03]";
    PART_INERTIA = "inertia_kg_m2", Value::Inertia,
        "the part's inertia about its own centre of mass in its own axes, kg m^2",
        "inertia_kg_m2 = [[0.002, 0.0, 0.0], [0.0, 0.002, 0.0], [0.0, 0.0, 0.003]]";
    PART_ROTATION = "rotation", Value::Rotation,
        "the rotation from the part's axes to platform axes, row by row",
        "rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]";
}

/// A table of the file, but for those about legs.
pub(crate) struct Table {
    /// Where its keys stand, in messages.
    pub title: &'static str,
    pub keys: &'static [&'static Key],
    /// Keys that must be there.
    pub needed: &'static [&'static Key],
}

/// The file itself.
pub(crate) const FILE: Table = Table {
    title: "the part of the file before the first table",
    keys: &[
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
    ],
    needed: &[&VERSION, &NAME, &LEG_TYPE, &GRAVITY, &HOME, &PAYLOAD],
};

/// `[home]`.
pub(crate) const IN_HOME: Table =
    Table { title: "[home]", keys: &[&POSITION, &ROTATION], needed: &[&POSITION] };

/// `[circular_layout]`.
pub(crate) const IN_CIRCULAR_LAYOUT: Table =
    Table { title: "[circular_layout]", keys: CIRCLES, needed: CIRCLES };

const CIRCLES: &[&Key] = &[&BASE_RADIUS, &PLATFORM_RADIUS, &BASE_PAIR_ANGLE, &PLATFORM_PAIR_ANGLE];

/// `[payload]`; what is needed is needed where there are no parts.
pub(crate) const IN_PAYLOAD: Table = Table {
    title: "[payload]",
    keys: &[&PAYLOAD_MASS, &PAYLOAD_COM, &PAYLOAD_INERTIA, &PART],
    needed: &[&PAYLOAD_MASS, &PAYLOAD_COM, &PAYLOAD_INERTIA],
};

/// `[[payload.part]]`.
pub(crate) const IN_PART: Table = Table {
    title: "[[payload.part]]",
    keys: &[&PART_NAME, &PART_MASS, &PART_COM, &PART_INERTIA, &PART_ROTATION],
    needed: &[&PART_MASS, &PART_COM, &PART_INERTIA],
};

/// Every table, but for those about legs.
const TABLES: [&Table; 5] = [&FILE, &IN_HOME, &IN_CIRCULAR_LAYOUT, &IN_PAYLOAD, &IN_PART];

/// Keys of `[legs]`, which may stand in `[[leg]]` too: the leg type's own, then limits. Of every leg type where it is
/// not known which one it is.
pub(crate) fn in_legs(leg_type: Option<LegType>) -> Vec<&'static Key> {
    let own = legs::kinds(leg_type).flat_map(|kind| kind.shared()).map(|property| &property.key);
    own.chain(crate::limits::KEYS).collect()
}

/// Keys that only `[[leg]]` has.
pub(crate) fn only_in_leg(leg_type: Option<LegType>) -> Vec<&'static Key> {
    let joints = legs::kinds(leg_type).flat_map(|kind| kind.joints()).map(|property| &property.key);
    std::iter::once(&LEG_NUMBER).chain(joints).collect()
}

/// Where a key belongs that stands in the wrong place.
pub(crate) enum Home {
    /// In this table.
    Table(&'static str),
    /// In a file with legs of another type.
    OtherLegType(LegType),
}

/// Where the key `written` belongs in a file with legs of this type, if anywhere.
pub(crate) fn home_of(written: &str, leg_type: Option<LegType>) -> Option<Home> {
    let among = |keys: &[&Key]| keys.iter().any(|key| key.name == written);
    if let Some(table) = TABLES.iter().find(|table| among(table.keys)) {
        return Some(Home::Table(table.title));
    }
    if among(&in_legs(leg_type)) {
        return Some(Home::Table("[legs] or [[leg]]"));
    }
    if among(&only_in_leg(leg_type)) {
        return Some(Home::Table("[[leg]]"));
    }
    LegType::ALL.into_iter().find(|other| among(&in_legs(Some(*other)))).map(Home::OtherLegType)
}
