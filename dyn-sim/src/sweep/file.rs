//! Sweep files: a scenario, and what varies.

use std::path::{Path, PathBuf};

use dyn_platform::{FileError, Refusal, first_line, nearest, read_text};
use serde::Deserialize;
use toml::{Spanned, Table};

use super::keys;
use crate::scenario::{self, Scenario, ScenarioError, Steering, syntax};

/// Version of the sweep file format.
const VERSION: i64 = 1;

/// More designs fill the memory: each keeps about 4 kB.
const MOST_DESIGNS: usize = 1_000_000;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    version: Spanned<i64>,
    name: Spanned<String>,
    #[serde(default)]
    description: String,
    scenario: Spanned<String>,
    #[serde(default)]
    hold: Option<Spanned<bool>>,
    designs: Option<Spanned<i64>>,
    seed: Option<Spanned<u64>>,
    #[serde(default)]
    vary: Vec<Spanned<Vary>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Vary {
    platform: Option<Spanned<String>>,
    scenario: Option<Spanned<String>>,
    parameter: Option<Spanned<String>>,
    from: Option<f64>,
    to: Option<f64>,
    steps: Option<Spanned<i64>>,
    values: Option<Vec<f64>>,
    relative: Option<f64>,
    absolute: Option<f64>,
}

/// A sweep after all checks.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// Short name; results are filed under it.
    pub name: String,
    /// One sentence for people.
    pub description: String,
    /// The file as read.
    pub text: String,
    /// The scenario with nothing varied.
    pub nominal: Scenario,
    /// What varies.
    pub variations: Vec<Variation>,
    /// Number of designs and seed, where they are drawn at random; else every combination is a design.
    pub random: Option<(usize, u64)>,
    /// Whether free platforms are held by constant forces, each by its own.
    pub hold: bool,
    pub(super) folder: PathBuf,
    pub(super) scenario_name: String,
    pub(super) scenario: Table,
    pub(super) platform_name: String,
    pub(super) platform: Table,
}

/// One number that varies, or all those of a parameter, each for itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Variation {
    /// Where it stands.
    pub varied: Varied,
    /// What it may be.
    pub spread: Spread,
    /// What it is in the files: one number, or those of the parameter.
    pub nominal: Vec<f64>,
}

/// What a variation changes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Varied {
    /// The number at a path in the platform file.
    Platform(String),
    /// The number at a path in the scenario file.
    Scenario(String),
    /// The numbers of a resolved parameter.
    Parameter(String),
}

/// What a number may be.
#[derive(Clone, Debug, PartialEq)]
pub enum Spread {
    /// One of these.
    Values(Vec<f64>),
    /// Between these two.
    Between([f64; 2]),
    /// Nominal times `1 +- this`.
    Relative(f64),
    /// Nominal `+-` this.
    Absolute(f64),
}

impl Variation {
    /// Names of its numbers.
    pub fn labels(&self) -> Vec<String> {
        match &self.varied {
            Varied::Platform(path) | Varied::Scenario(path) => vec![path.clone()],
            Varied::Parameter(name) if self.nominal.len() == 1 => vec![name.clone()],
            Varied::Parameter(name) => (0..self.nominal.len()).map(|k| format!("{name}.{k}")).collect(),
        }
    }
}

impl Sweep {
    /// Reads and checks a sweep file, its scenario and its platform; paths count from the folder of the file they stand in.
    ///
    /// # Errors
    /// A file cannot be read, or holds mistakes; each mistake comes with line, caret and remedy.
    pub fn from_file(path: &Path) -> Result<Self, ScenarioError> {
        let text = read_text(
            path,
            "sweep",
            "check the path and its permissions; scenarios/sweep.toml is an example",
        )
        .map_err(ScenarioError::File)?;
        let source_name = path.display().to_string();
        let refused = |refusals| ScenarioError::File(FileError::new(&source_name, text.as_str(), refusals));
        let file: File =
            toml::from_str(&text).map_err(|error| refused(vec![syntax::refusal(&error, &text)]))?;
        if *file.version.get_ref() != VERSION {
            let what = format!(
                "the file has format version {}, this reader knows version {VERSION} only",
                file.version.get_ref()
            );
            let help = "write `version = 1` and bring the file into the form of scenarios/README.md";
            return Err(refused(vec![Refusal::new(
                file.version.span(),
                format!("must be {VERSION}"),
                what,
                help,
            )]));
        }
        let scenario_path = path.parent().unwrap_or(Path::new("")).join(file.scenario.get_ref());
        if !scenario_path.is_file() {
            let what = format!("there is no scenario file {}", scenario_path.display());
            let help = "give its path, counted from the folder of the sweep file";
            return Err(refused(vec![Refusal::new(file.scenario.span(), "no such file", what, help)]));
        }
        let nominal = Scenario::from_file(&scenario_path)?;
        let scenario_name = scenario_path.display().to_string();
        let folder = scenario_path.parent().unwrap_or(Path::new("")).to_owned();
        let platform_path = scenario::platform_of(&scenario_name, &nominal.text, &folder)?;
        let platform_text = read_text(&platform_path, "platform", "it was there a moment ago")
            .map_err(ScenarioError::Platform)?;
        // Both have been read before: they are TOML.
        let table = |text: &str| text.parse::<Table>().unwrap_or_default();
        let mut sweep = Self {
            name: file.name.get_ref().clone(),
            description: file.description,
            scenario: table(&nominal.text),
            platform: table(&platform_text),
            text: text.clone(),
            nominal,
            variations: Vec::new(),
            random: None,
            hold: file.hold.as_ref().is_some_and(|hold| *hold.get_ref()),
            folder,
            scenario_name,
            platform_name: platform_path.display().to_string(),
        };
        let mut refusals = Vec::new();
        scenario::check_name(&file.name, &mut refusals);
        if let (Some(hold), Steering::Target(_)) = (file.hold, &sweep.nominal.steering)
            && *hold.get_ref()
        {
            let what = "nothing is to be held: the scenario's [target] decides the forces";
            refusals.push(Refusal::new(hold.span(), "with [target]", what, "remove `hold`"));
        }
        let random = file.designs.is_some();
        for vary in &file.vary {
            match variation(&sweep, vary, random) {
                Ok(variation) => sweep.variations.push(variation),
                Err(refusal) => refusals.push(refusal),
            }
        }
        if file.vary.is_empty() {
            let help = "add a [[vary]] table: `platform = \"payload.mass_kg\"`, `from = 5.0`, `to = 7.0`, `steps = 5`";
            refusals.push(Refusal::new(first_line(&text), "no [[vary]]", "nothing varies", help));
        }
        match (file.designs, file.seed) {
            (Some(designs), seed) => match usize::try_from(*designs.get_ref()) {
                Ok(count @ 1..=MOST_DESIGNS) => {
                    sweep.random = Some((count, seed.map_or(0, |seed| *seed.get_ref())));
                }
                _ => refusals.push(too_many(designs.span(), *designs.get_ref() as f64)),
            },
            (None, Some(seed)) => refusals.push(Refusal::new(
                seed.span(),
                "without `designs`",
                "`seed` means nothing where every combination is a design",
                "add `designs = 1000` to draw at random, or remove `seed`",
            )),
            (None, None) => {
                let count: f64 = sweep
                    .variations
                    .iter()
                    .map(|variation| match &variation.spread {
                        Spread::Values(values) => values.len() as f64,
                        _ => 1.0,
                    })
                    .product();
                if count > MOST_DESIGNS as f64 {
                    refusals.push(too_many(first_line(&text), count));
                }
            }
        }
        if refusals.is_empty() { Ok(sweep) } else { Err(refused(refusals)) }
    }
}

fn too_many(at: std::ops::Range<usize>, count: f64) -> Refusal {
    let what = format!("{count} designs; there may be 1 to {MOST_DESIGNS}");
    Refusal::new(at, "how many", what, "vary less, in fewer steps, or draw some at random: `designs = 1000`")
}

/// What a `[[vary]]` table says.
fn variation(sweep: &Sweep, vary: &Spanned<Vary>, random: bool) -> Result<Variation, Refusal> {
    let (at, table) = (vary.span(), vary.get_ref());
    let here = first_line_of(&sweep.text, at);
    let in_file = |document: &Table, path: &Spanned<String>| {
        keys::number(document, path.get_ref()).map(|number| vec![number]).ok_or_else(|| {
            let what = format!("there is no number `{}` in that file", path.get_ref());
            Refusal::new(path.span(), "no such number", what, keys::remedy(document, path.get_ref()))
        })
    };
    let (varied, nominal) = match (&table.platform, &table.scenario, &table.parameter) {
        (Some(path), None, None) => {
            (Varied::Platform(path.get_ref().clone()), in_file(&sweep.platform, path)?)
        }
        (None, Some(path), None) => {
            if matches!(path.get_ref().as_str(), "duration_s" | "step_s" | "version" | "spectrum.start_s") {
                let what = format!("`{}` must be the same for all designs", path.get_ref());
                return Err(Refusal::new(path.span(), "may not vary", what, "vary another number"));
            }
            (Varied::Scenario(path.get_ref().clone()), in_file(&sweep.scenario, path)?)
        }
        (None, None, Some(name)) => {
            let platform = &sweep.nominal.platform;
            let Some(numbers) = platform.parameters.get(name.get_ref()) else {
                let known = || platform.leg_type.parameters().map(|info| info.name);
                let help = match nearest(name.get_ref(), known()) {
                    Some(meant) => format!("did you mean `{meant}`?"),
                    None => format!("known: {}", known().collect::<Vec<_>>().join(", ")),
                };
                let what = format!("there is no parameter `{}`", name.get_ref());
                return Err(Refusal::new(name.span(), "no such parameter", what, help));
            };
            (Varied::Parameter(name.get_ref().clone()), numbers.to_vec())
        }
        _ => {
            let help = "give one of `platform = \"payload.mass_kg\"`, `scenario = \"free.position_m.2\"`, \
                        `parameter = \"axial_stiffness\"`";
            return Err(Refusal::new(
                here,
                "what varies?",
                "a [[vary]] table names one thing that varies",
                help,
            ));
        }
    };
    let spread = spread(table, &here, random, &nominal)?;
    if nominal.len() > 1 && matches!(spread, Spread::Values(_) | Spread::Between(_)) {
        let what = "the numbers of a parameter vary each for itself, about what each is";
        let help = "give `relative` or `absolute`; to vary all alike, the key in the platform file: `platform = \"...\"`";
        return Err(Refusal::new(here, "about what each is", what, help));
    }
    Ok(Variation { varied, spread, nominal })
}

/// How a number varies.
fn spread(
    table: &Vary,
    here: &std::ops::Range<usize>,
    random: bool,
    nominal: &[f64],
) -> Result<Spread, Refusal> {
    let refused = |label: &str, what: &str, help: &str| Err(Refusal::new(here.clone(), label, what, help));
    let finite = |number: f64| number.is_finite();
    match (table.from, table.to, &table.values, table.relative, table.absolute) {
        _ if table.steps.is_some() && (random || table.from.is_none()) => refused(
            "steps?",
            "`steps` divides a range `from` - `to` where every combination is a design",
            "remove `steps`; or give `from` and `to`, and remove `designs`",
        ),
        (Some(from), Some(to), None, None, None) if finite(from) && finite(to) && from < to => {
            if random {
                return Ok(Spread::Between([from, to]));
            }
            match table.steps.as_ref().map(|steps| *steps.get_ref()) {
                Some(steps @ 2..=1_000_000) => {
                    let last = (steps - 1) as f64;
                    let at = |k: i64| from + (to - from) * (k as f64 / last);
                    Ok(Spread::Values((0..steps).map(at).collect()))
                }
                _ => refused(
                    "in how many steps?",
                    "a range needs `steps`, the number of values in it, at least 2",
                    "for example `steps = 5`; or draw at random with `designs = 1000` at the top",
                ),
            }
        }
        (None, None, Some(values), None, None) if !values.is_empty() && values.iter().all(|v| finite(*v)) => {
            Ok(Spread::Values(values.clone()))
        }
        (None, None, None, Some(size), None) | (None, None, None, None, Some(size)) if !random => refused(
            "at random",
            &format!("a tolerance of {size} is drawn at random, but every combination is to be a design"),
            "add `designs = 1000` at the top",
        ),
        (None, None, None, Some(relative), None) if relative > 0.0 && relative < 1.0 => {
            match nominal.iter().all(|number| *number == 0.0) {
                false => Ok(Spread::Relative(relative)),
                true => refused("of zero", "a share of 0 is 0", "give `absolute`, in the unit of the number"),
            }
        }
        (None, None, None, None, Some(absolute)) if absolute > 0.0 && finite(absolute) => {
            Ok(Spread::Absolute(absolute))
        }
        _ => refused(
            "how?",
            "a [[vary]] table says in one way what its number may be",
            "one of `from` < `to` (with `steps`), `values = [...]`, `relative` between 0 and 1, `absolute` > 0",
        ),
    }
}

/// The first line of a part of the text.
fn first_line_of(text: &str, at: std::ops::Range<usize>) -> std::ops::Range<usize> {
    at.start..at.start + first_line(&text[at.start..]).end
}
