//! Which of a model's physical numbers are baked in and which are given at run time.

use dyn_platform::{Platform, nearest};

use crate::error::GenerateError;
use crate::graph::{Program, Symbol};

/// Where a model's physical numbers come from.
#[derive(Clone, Debug)]
pub struct Numbers<'a> {
    platform: Option<&'a Platform>,
    at_run_time: Choice,
}

#[derive(Clone, Debug)]
enum Choice {
    All,
    Named(Vec<String>),
}

impl<'a> Numbers<'a> {
    /// Every number of `platform` baked into the code.
    pub fn baked(platform: &'a Platform) -> Numbers<'a> {
        Numbers { platform: Some(platform), at_run_time: Choice::Named(Vec::new()) }
    }

    /// The numbers of `platform`, of which those called `names` are given at run time and are the platform's until then.
    ///
    /// A name is that of a parameter (`axial_stiffness`), its key in a platform file (`axial_stiffness_n_per_m`), its symbol
    /// in the paper (`k_e`), each also behind its group (`legs.k_e`), or a group: `payload`, `legs`, `gravity`, `all`.
    pub fn with_run_time(
        platform: &'a Platform,
        names: impl IntoIterator<Item = impl Into<String>>,
    ) -> Numbers<'a> {
        let names = names.into_iter().map(Into::into).collect();
        Numbers { platform: Some(platform), at_run_time: Choice::Named(names) }
    }

    /// Every number given at run time: a model of any platform.
    pub fn at_run_time() -> Numbers<'static> {
        Numbers { platform: None, at_run_time: Choice::All }
    }

    /// The platform whose numbers they are, unless they are any platform's.
    pub fn platform(&self) -> Option<&'a Platform> {
        self.platform
    }

    /// The parameters of `program` that are given at run time, in its order.
    ///
    /// # Errors
    /// A name that no parameter has.
    pub fn run_time_parameters<'p>(&self, program: &'p Program) -> Result<Vec<&'p Symbol>, GenerateError> {
        match &self.at_run_time {
            Choice::All => Ok(program.parameters().collect()),
            Choice::Named(names) => {
                let mut chosen = Vec::new();
                for name in names {
                    chosen.extend(named(program, name)?);
                }
                Ok(program.parameters().filter(|symbol| chosen.contains(&symbol.name.as_str())).collect())
            }
        }
    }
}

/// Symbols of the paper, with the parameter that each stands for in one leg type or another.
const SYMBOLS: [(&str, &str); 17] = [
    ("b", "base_point"),
    ("a", "actuator_axis"),
    ("p", "platform_point"),
    ("s", "rod_length"),
    ("m_s", "rod_mass"),
    ("J_s", "rod_inertia"),
    ("k", "rod_com_fraction"),
    ("m_d", "mover_mass"),
    ("d*", "mover_offset"),
    ("dstar", "mover_offset"),
    ("d0", "rest_length"),
    ("k_e", "axial_stiffness"),
    ("c_e", "axial_damping"),
    ("m_p", "payload_mass"),
    ("r_c", "payload_com"),
    ("I_c", "payload_inertia"),
    ("g", "gravity"),
];

/// The group of a parameter: the table of the platform file that it stands in.
fn group(symbol: &Symbol) -> &'static str {
    if symbol.name == "gravity" {
        "gravity"
    } else if symbol.name.starts_with("payload_") {
        "payload"
    } else {
        "legs"
    }
}

/// Every name of a parameter without group.
fn names_of(symbol: &Symbol) -> Vec<String> {
    let suffix = match symbol.unit.as_str() {
        "m" => "_m",
        "kg" => "_kg",
        "kg m^2" => "_kg_m2",
        "N/m" => "_n_per_m",
        "N s/m" => "_n_s_per_m",
        "m/s^2" => "_m_per_s2",
        _ => "",
    };
    let mut names = vec![symbol.name.clone(), format!("{}{suffix}", symbol.name)];
    if let Some(in_table) = symbol.name.strip_prefix("payload_") {
        names.extend([in_table.to_owned(), format!("{in_table}{suffix}")]);
    }
    let paper = SYMBOLS.iter().filter(|(_, parameter)| *parameter == symbol.name);
    names.extend(paper.map(|(name, _)| (*name).to_owned()));
    names.dedup();
    names
}

/// The parameters that `name` stands for.
fn named<'p>(program: &'p Program, name: &str) -> Result<Vec<&'p str>, GenerateError> {
    let wanted = |symbol: &&Symbol| {
        let group = group(symbol);
        // Without its group, `mass` could be anything's.
        let alone = |own: &String| *own == name && (group != "payload" || !is_short(symbol, own));
        let grouped =
            |own: &String| name.strip_prefix(group).and_then(|rest| rest.strip_prefix('.')) == Some(own);
        name == "all" || name == group || names_of(symbol).iter().any(|own| alone(own) || grouped(own))
    };
    let found: Vec<&str> = program.parameters().filter(wanted).map(|symbol| symbol.name.as_str()).collect();
    if !found.is_empty() {
        return Ok(found);
    }
    let mut known: Vec<String> = ["payload", "legs", "gravity", "all"].map(str::to_owned).into();
    for symbol in program.parameters() {
        let names = names_of(symbol);
        known.extend(names.iter().map(|own| format!("{}.{own}", group(symbol))));
        known.extend(names.into_iter().filter(|own| !is_short(symbol, own)));
    }
    let parameters: Vec<&str> = program.parameters().map(|symbol| symbol.name.as_str()).collect();
    Err(GenerateError::UnknownParameterName {
        name: name.into(),
        help: match nearest(name, known.iter().map(String::as_str)) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!(
                "give the groups payload, legs, gravity or all, or parameters: {}",
                parameters.join(", ")
            ),
        },
    })
}

/// Whether `name` is a parameter's key inside its table only, as `mass` or `mass_kg` in [payload].
fn is_short(symbol: &Symbol, name: &str) -> bool {
    symbol.name.strip_prefix("payload_").is_some_and(|short| name.starts_with(short))
}
