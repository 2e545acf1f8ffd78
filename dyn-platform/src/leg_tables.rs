//! The tables about legs in a file: what all legs have in common, what each has of its own, and the default of what
//! neither gives.

use std::array;
use std::ops::Range;

use toml::Spanned;

use crate::checks::{self, Fault};
use crate::document::{Reading, Section};
use crate::findings::Findings;
use crate::keys::{self, Key, Value};
use crate::legs::{Layout, Leg, LegKind, Place, Property, named};
use crate::parameters::Vector3;
use crate::platform::{LegType, Pose};
use crate::refusal::Refusal;

/// The tables about legs: `[legs]`, and each `[[leg]]` in the place of its number.
pub(crate) struct LegTables<'d> {
    common: Option<Section<'d>>,
    tables: [Option<Section<'d>>; 6],
    /// Where to point when all legs lack something: `[legs]`, else the first `[[leg]]`, else the top of the file.
    header: Range<usize>,
    /// Numbers of the legs about which nothing more is said: a refusal says already that they are missing.
    refused: [bool; 6],
}

impl<'d> LegTables<'d> {
    /// Finds the tables. In a free layout each leg needs its own, since no other place holds its joints.
    pub fn find(file: &Section<'d>, free_layout: bool, findings: &mut Findings) -> Self {
        let shared = keys::in_legs(file.leg_type());
        let common = file.section(&keys::LEGS, &shared, findings);
        let in_leg = [keys::only_in_leg(file.leg_type()), shared].concat();
        let entries = file.sections("[[leg]]", &keys::LEG, &in_leg, findings).unwrap_or_default();
        let first = common.as_ref().or(entries.first()).unwrap_or(file);
        let header = first.header.clone();
        let last_header = entries.last().unwrap_or(file).header.clone();

        let mut tables: [Option<Section>; 6] = Default::default();
        let mut all_numbered = true;
        for mut table in entries {
            let Some(number) = table.require(&keys::LEG_NUMBER, leg_number, findings) else {
                all_numbered = false;
                continue;
            };
            let place = &mut tables[*number.get_ref() - 1];
            if place.is_some() {
                all_numbered = false;
                findings.refuse(Refusal::new(
                    number.span(),
                    "given a second time",
                    format!("leg {} is given twice", number.get_ref()),
                    "give each of the numbers 1 to 6 to one [[leg]] only",
                ));
                continue;
            }
            table.title = format!("leg {}", number.get_ref());
            *place = Some(table);
        }

        let missing: Vec<usize> = (1..=6).filter(|number| tables[number - 1].is_none()).collect();
        // Without any [[leg]] there is no layout at all, and a wrong or repeated number is a likelier cause than a leg
        // left out: both have their own refusal.
        if free_layout && all_numbered && (1..6).contains(&missing.len()) && !file.has_misspelt(&keys::LEG) {
            let (is_or_are, table) =
                if missing.len() == 1 { ("is", "a [[leg]] table") } else { ("are", "[[leg]] tables") };
            findings.refuse(Refusal::new(
                last_header,
                format!("{} of 6 legs are given, the last one here", 6 - missing.len()),
                format!("{} {is_or_are} missing: a platform has six legs", named(&missing)),
                format!("add {table} with `number`, `base_point_m` and `platform_point_m`"),
            ));
        }
        let refused = array::from_fn(|leg| tables[leg].is_none() && (free_layout || !all_numbered));
        if common.is_none() && !free_layout && tables.iter().all(Option::is_none) {
            if file.key_span(&keys::LEGS).is_none() && !file.has_misspelt(&keys::LEGS) {
                findings.refuse(file.missing_section(&keys::LEGS));
            }
            return Self { common, tables, header, refused: [true; 6] };
        }
        Self { common, tables, header, refused }
    }

    /// A joint of each leg in a free layout.
    pub fn points(&self, property: &Property, findings: &mut Findings) -> Option<[Spanned<Vector3>; 6]> {
        all(self
            .tables
            .each_ref()
            .map(|table| table.as_ref()?.require(&property.key, checks::vector, findings)))
    }

    /// The first joint point of a leg, if any is given.
    pub fn any_point(&self, leg_type: Option<LegType>) -> Option<Range<usize>> {
        let points = keys::only_in_leg(leg_type).into_iter().filter(|key| key.name != keys::LEG_NUMBER.name);
        let spans =
            points.flat_map(|key| self.tables.iter().flatten().filter_map(|table| table.key_span(key)));
        spans.min_by_key(|span| span.start)
    }

    /// The legs with everything that they are made of; nothing if something is missing or was refused.
    pub fn legs<'p>(
        &self,
        kind: &LegKind,
        home: Option<&'p Pose>,
        layout: Option<&Layout>,
        findings: &mut Findings,
    ) -> Option<[Leg<'p>; 6]> {
        let readings: Vec<(&Property, [Reading<Vec<f64>>; 6])> = kind
            .shared()
            .map(|property| {
                let must = matches!(property.place, Place::Legs);
                let key = &property.key;
                (property, if must { self.require(key, findings) } else { self.read(key, findings) })
            })
            .collect();
        let (home, layout) = (home?, layout?);
        let leg = |leg: usize| {
            let mut made = Leg { number: leg + 1, home, values: Vec::new() };
            for property in kind.properties {
                let reading = readings.iter().find(|(read, _)| read.key.name == property.key.name);
                let value = match (&property.place, reading.map(|(_, legs)| legs[leg].clone())) {
                    (Place::BaseJoint, _) => flat(&layout.base[leg]),
                    (Place::PlatformJoint, _) => flat(&layout.platform[leg]),
                    (_, Some(Reading::Present(value))) => value,
                    (Place::LegsOr(default), Some(Reading::Absent)) => {
                        Spanned::new(0..0, vec![default(&made)])
                    }
                    _ => return None,
                };
                made.values.push((property.parameter.name, value));
            }
            Some(made)
        };
        all(array::from_fn(leg))
    }

    /// A number of each leg that has one, its own or that of `[legs]`.
    pub fn optional(&self, key: &Key, findings: &mut Findings) -> [Option<Spanned<f64>>; 6] {
        let first = |value: Spanned<Vec<f64>>| Spanned::new(value.span(), value.get_ref()[0]);
        self.read(key, findings).map(|reading| reading.present().map(first))
    }

    /// A property of each leg: its own value where its table has one, else that of `[legs]`.
    fn read(&self, key: &Key, findings: &mut Findings) -> [Reading<Vec<f64>>; 6] {
        let mut read = |section: &Option<Section>| match (section, key.value) {
            (None, _) => Reading::Absent,
            (Some(section), Value::Vector | Value::UnitVector) => section.read(
                key,
                |value, key| checks::vector(value, key).map(|vector| vector.to_vec()),
                findings,
            ),
            (Some(section), _) => section.read(
                key,
                |value, key| checks::number(value, key).map(|number| vec![number]),
                findings,
            ),
        };
        let common = read(&self.common);
        self.tables.each_ref().map(|table| match read(table) {
            Reading::Absent => common.clone(),
            own => own,
        })
    }

    /// A property that each leg must have, from its own table or from `[legs]`.
    fn require(&self, key: &Key, findings: &mut Findings) -> [Reading<Vec<f64>>; 6] {
        let readings = self.read(key, findings);
        let lacking: Vec<usize> =
            (0..6).filter(|&leg| matches!(readings[leg], Reading::Absent) && !self.refused[leg]).collect();
        let misspelt_for_all = self.common.as_ref().is_some_and(|common| common.has_misspelt(key));
        if lacking.len() == 6 || lacking.iter().any(|&leg| self.tables[leg].is_none()) {
            let misspelt = self.tables.iter().flatten().any(|table| table.has_misspelt(key));
            if !misspelt_for_all && !misspelt {
                findings.refuse(Refusal::new(
                    self.header.clone(),
                    format!("no `{}` here", key.name),
                    format!("`{}` is missing: neither [legs] nor every leg has it", key.name),
                    key.remedy(),
                ));
            }
        } else if !misspelt_for_all {
            // Some legs have a value of their own, so that the places of the mistake are the others.
            let tables = lacking.into_iter().filter_map(|leg| self.tables[leg].as_ref());
            findings
                .refuse_all(tables.filter(|table| !table.has_misspelt(key)).map(|table| table.missing(key)));
        }
        readings
    }
}

fn leg_number(number: i64, key: &Key) -> Result<usize, Fault> {
    match usize::try_from(number) {
        Ok(number @ 1..=6) => Ok(number),
        _ => Err(Fault::new(
            "must be 1 to 6",
            format!("`{}` of a leg must be 1 to 6, but is {number}", key.name),
            "a platform has six legs: renumber this one or remove it",
        )),
    }
}

fn flat(point: &Spanned<Vector3>) -> Spanned<Vec<f64>> {
    Spanned::new(point.span(), point.get_ref().to_vec())
}

/// All six, or nothing if one is absent.
fn all<T>(options: [Option<T>; 6]) -> Option<[T; 6]> {
    let present: Vec<T> = options.into_iter().flatten().collect();
    present.try_into().ok()
}
