//! Files to start from: commented platform files with numbers that make a working platform.

/// A file to start from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Starter {
    /// The platform of the paper: joints on circles, upright actuators.
    Paper,
    /// The same platform with the joints of each leg written out.
    Free,
    /// Legs along the edges of a cube, so that legs side by side are perpendicular.
    Cubic,
    /// The classical Gough-Stewart platform with telescopic legs.
    Ups,
}

impl Starter {
    /// Every one.
    pub const ALL: [Self; 4] = [Self::Paper, Self::Free, Self::Cubic, Self::Ups];

    /// Its name in commands.
    pub fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Free => "free",
            Self::Cubic => "cubic",
            Self::Ups => "ups",
        }
    }
}

/// The text of a platform file to start from; it is called `my_platform`.
pub fn starter(which: Starter) -> &'static str {
    match which {
        Starter::Paper => include_str!("../starters/paper.toml"),
        Starter::Free => include_str!("../starters/free.toml"),
        Starter::Cubic => include_str!("../starters/cubic.toml"),
        Starter::Ups => include_str!("../starters/ups.toml"),
    }
}
