//! The legs of a file: what they have in common, what each has of its own, and the default of what neither gives.

use std::array;
use std::ops::Range;

use toml::Spanned;

use crate::checks::{self, Fault};
use crate::document::{FromToml, Reading, Section};
use crate::keys::{self, Key};
use crate::parameters::Vector3;
use crate::refusal::Refusal;

/// The tables about legs: `[legs]`, and each `[[leg]]` in the place of its number.
pub(crate) struct Legs<'d> {
    common: Option<Section<'d>>,
    tables: [Option<Section<'d>>; 6],
    /// Where to point when all legs lack something: `[legs]`, else the first `[[leg]]`, else the top of the file.
    header: Range<usize>,
    /// Numbers of the legs about which nothing more is said: a refusal says already that they are missing.
    refused: [bool; 6],
}

/// What is known of each leg beside its joints. Only the rod's length is needed again with its place.
pub(crate) struct LegProperties {
    pub actuator_axis: [Vector3; 6],
    pub rod_length: [Spanned<f64>; 6],
    pub rod_mass: [f64; 6],
    pub rod_inertia: [f64; 6],
    pub rod_com_fraction: [f64; 6],
    pub mover_mass: [f64; 6],
    pub mover_offset: [f64; 6],
    pub rest_length: [f64; 6],
    pub axial_stiffness: [f64; 6],
    pub axial_damping: [f64; 6],
}

impl<'d> Legs<'d> {
    /// Finds the tables. In a free layout each leg needs its own, since no other place holds its joints.
    pub fn find(file: &Section<'d>, free_layout: bool, refusals: &mut Vec<Refusal>) -> Self {
        let common = file.section(&keys::LEGS, &[keys::IN_LEGS], refusals);
        let entries =
            file.sections(&keys::LEG, &[keys::ONLY_IN_LEG, keys::IN_LEGS], refusals).unwrap_or_default();
        let first = common.as_ref().or(entries.first()).unwrap_or(file);
        let header = first.header.clone();
        let last_header = entries.last().unwrap_or(file).header.clone();

        let mut tables: [Option<Section>; 6] = Default::default();
        let mut all_numbered = true;
        for mut table in entries {
            let Some(number) = table.require(&keys::LEG_NUMBER, leg_number, refusals) else {
                all_numbered = false;
                continue;
            };
            let place = &mut tables[*number.get_ref() - 1];
            if place.is_some() {
                all_numbered = false;
                refusals.push(Refusal::new(
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
            refusals.push(Refusal::new(
                last_header,
                format!("{} of 6 legs are given, the last one here", 6 - missing.len()),
                format!("{} {is_or_are} missing: a platform has six legs", named(&missing)),
                format!("add {table} with `number`, `base_point_m` and `platform_point_m`"),
            ));
        }
        let refused = array::from_fn(|leg| tables[leg].is_none() && (free_layout || !all_numbered));
        if common.is_none() && !free_layout && tables.iter().all(Option::is_none) {
            if file.key_span(&keys::LEGS).is_none() && !file.has_misspelt(&keys::LEGS) {
                refusals.push(file.missing_section(&keys::LEGS));
            }
            return Self { common, tables, header, refused: [true; 6] };
        }
        Self { common, tables, header, refused }
    }

    /// A joint point of each leg in a free layout.
    pub fn points(&self, key: &Key, refusals: &mut Vec<Refusal>) -> Option<[Vector3; 6]> {
        all(self.tables.each_ref().map(|table| {
            let point = table.as_ref()?.require(key, checks::any, refusals)?;
            Some(point.into_inner())
        }))
    }

    /// The first joint point of a leg, if any is given.
    pub fn any_point(&self) -> Option<Range<usize>> {
        let points = [&keys::BASE_POINT, &keys::PLATFORM_POINT];
        self.tables
            .iter()
            .flatten()
            .flat_map(|table| points.map(|key| table.key_span(key)))
            .flatten()
            .min_by_key(|span| span.start)
    }

    /// Everything about the legs that a layout does not give.
    pub fn properties(&self, refusals: &mut Vec<Refusal>) -> Option<LegProperties> {
        let actuator_axis = self.require(&keys::ACTUATOR_AXIS, checks::unit_vector, refusals);
        let rod_length = self.require(&keys::ROD_LENGTH, checks::positive, refusals);
        let rod_mass = self.require(&keys::ROD_MASS, checks::positive, refusals);
        let rod_inertia = self.read(&keys::ROD_INERTIA, checks::positive, refusals);
        let rod_com_fraction = self.require(&keys::ROD_COM_FRACTION, checks::fraction, refusals);
        let mover_mass = self.require(&keys::MOVER_MASS, checks::positive, refusals);
        let mover_offset = self.require(&keys::MOVER_OFFSET, checks::any, refusals);
        let rest_length = self.require(&keys::REST_LENGTH, checks::any, refusals);
        let axial_stiffness = self.require(&keys::AXIAL_STIFFNESS, checks::not_negative, refusals);
        let axial_damping = self.require(&keys::AXIAL_DAMPING, checks::not_negative, refusals);

        let (rod_length, rod_mass) = (rod_length?, values(rod_mass?));
        let rod_inertia = array::from_fn(|leg| match &rod_inertia[leg] {
            Reading::Present(inertia) => *inertia.get_ref(),
            // The slender uniform rod. (A refused value never gets further than this: the file is refused.)
            Reading::Absent | Reading::Refused => rod_mass[leg] * rod_length[leg].get_ref().powi(2) / 12.0,
        });
        Some(LegProperties {
            actuator_axis: values(actuator_axis?),
            rod_length,
            rod_mass,
            rod_inertia,
            rod_com_fraction: values(rod_com_fraction?),
            mover_mass: values(mover_mass?),
            mover_offset: values(mover_offset?),
            rest_length: values(rest_length?),
            axial_stiffness: values(axial_stiffness?),
            axial_damping: values(axial_damping?),
        })
    }

    /// A property of each leg: its own value where its table has one, else that of `[legs]`.
    fn read<T: FromToml + Clone>(
        &self,
        key: &Key,
        check: impl Fn(T, &Key) -> Result<T, Fault>,
        refusals: &mut Vec<Refusal>,
    ) -> [Reading<T>; 6] {
        let mut read = |section: &Option<Section>| match section {
            Some(section) => section.read(key, &check, refusals),
            None => Reading::Absent,
        };
        let common = read(&self.common);
        self.tables.each_ref().map(|table| match read(table) {
            Reading::Absent => common.clone(),
            own => own,
        })
    }

    /// A property that each leg must have, from its own table or from `[legs]`.
    fn require<T: FromToml + Clone>(
        &self,
        key: &Key,
        check: impl Fn(T, &Key) -> Result<T, Fault>,
        refusals: &mut Vec<Refusal>,
    ) -> Option<[Spanned<T>; 6]> {
        let readings = self.read(key, check, refusals);
        let lacking: Vec<usize> =
            (0..6).filter(|&leg| matches!(readings[leg], Reading::Absent) && !self.refused[leg]).collect();
        let misspelt_for_all = self.common.as_ref().is_some_and(|common| common.has_misspelt(key));
        if lacking.len() == 6 || lacking.iter().any(|&leg| self.tables[leg].is_none()) {
            let misspelt = self.tables.iter().flatten().any(|table| table.has_misspelt(key));
            if !misspelt_for_all && !misspelt {
                refusals.push(Refusal::new(
                    self.header.clone(),
                    format!("no `{}` here", key.name),
                    format!("`{}` is missing: neither [legs] nor every leg has it", key.name),
                    key.remedy(),
                ));
            }
        } else if !misspelt_for_all {
            // Some legs have a value of their own, so that the places of the mistake are the others.
            let tables = lacking.into_iter().filter_map(|leg| self.tables[leg].as_ref());
            refusals.extend(tables.filter(|table| !table.has_misspelt(key)).map(|table| table.missing(key)));
        }
        all(readings.map(Reading::present))
    }
}

/// "leg 4", "legs 1, 2 and 5".
pub(crate) fn named(numbers: &[usize]) -> String {
    match numbers {
        [] => "no leg".into(),
        [number] => format!("leg {number}"),
        [others @ .., last] => {
            let others: Vec<String> = others.iter().map(usize::to_string).collect();
            format!("legs {} and {last}", others.join(", "))
        }
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

fn values<T>(spanned: [Spanned<T>; 6]) -> [T; 6] {
    spanned.map(Spanned::into_inner)
}

/// All six, or nothing if one is absent.
fn all<T>(options: [Option<T>; 6]) -> Option<[T; 6]> {
    let present: Vec<T> = options.into_iter().flatten().collect();
    present.try_into().ok()
}
