//! Which numbers each design has, and the design that is made of them.

use dyn_platform::{Limits, Platform};
use dyn_runtime::models::Uhp;
use dyn_runtime::nalgebra::Vector6;
use dyn_runtime::{Acceleration, BaseMotion, Hexapod, PlatformState, Wrench};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::file::{Spread, Sweep, Variation, Varied};
use super::keys;
use crate::mechanism::run_time_model;
use crate::motion::Motion;
use crate::scenario::{Scenario, ScenarioError, Steering};

/// A platform and what happens to it.
#[derive(Clone, Debug)]
pub struct Design {
    /// Its dynamics, under the gravity that acts in the scenario.
    pub model: Uhp,
    /// What its actuators may do.
    pub limits: Limits,
    /// Motion of its base.
    pub base: Motion,
    /// What it does; where it is held, under forces that do so.
    pub steering: Steering,
}

impl Sweep {
    /// The numbers of all designs, in the order of [`labels`](Self::labels).
    pub fn numbers(&self) -> Vec<Vec<f64>> {
        let Some((count, seed)) = self.random else { return self.combinations() };
        let mut random = Pcg64::seed_from_u64(seed);
        (0..count)
            .map(|_| self.variations.iter().flat_map(|variation| drawn(variation, &mut random)).collect())
            .collect()
    }

    /// Every combination; the last variation changes fastest.
    fn combinations(&self) -> Vec<Vec<f64>> {
        let mut designs = vec![Vec::new()];
        for variation in &self.variations {
            let Spread::Values(values) = &variation.spread else { continue };
            let with = |design: &Vec<f64>, value: &f64| [design.as_slice(), &[*value]].concat();
            designs = designs.iter().flat_map(|design| values.iter().map(|v| with(design, v))).collect();
        }
        designs
    }

    /// Names of the numbers that vary.
    pub fn labels(&self) -> Vec<String> {
        self.variations.iter().flat_map(Variation::labels).collect()
    }

    /// The design with these numbers.
    ///
    /// # Errors
    /// Why there is no such design, in a sentence: what its platform file or scenario would be refused for.
    pub fn design(&self, numbers: &[f64]) -> Result<Design, String> {
        let scenario = self.scenario_with(numbers).map_err(|error| in_a_sentence(&error))?;
        let mut platform = scenario.platform;
        if !scenario.gravity_on
            && let Some(gravity) = platform.parameters.get_mut("gravity")
        {
            gravity.fill(0.0);
        }
        let model = run_time_model(&platform);
        let steering = match scenario.steering {
            Steering::Free(start, _) if self.hold => {
                let force = held(model, &scenario.base, &start).map_err(|error| error.to_string())?;
                Steering::Free(start, force)
            }
            other => other,
        };
        Ok(Design { model, limits: platform.limits, base: scenario.base, steering })
    }

    /// The scenario of the design with these numbers.
    ///
    /// # Errors
    /// As its files would be refused.
    pub fn scenario_with(&self, numbers: &[f64]) -> Result<Scenario, ScenarioError> {
        let (mut platform, mut scenario) = (self.platform.clone(), self.scenario.clone());
        let mut rest = numbers;
        let mut parameters = Vec::new();
        for variation in &self.variations {
            let (own, after) = rest.split_at(variation.nominal.len());
            rest = after;
            match &variation.varied {
                Varied::Platform(path) => keys::put(&mut platform, path, own[0]),
                Varied::Scenario(path) => keys::put(&mut scenario, path, own[0]),
                Varied::Parameter(name) => parameters.push((name, variation, own)),
            }
        }
        let platform_text = platform.to_string();
        let mut platform =
            Platform::from_toml(&self.platform_name, &platform_text).map_err(ScenarioError::Platform)?;
        for (name, variation, own) in parameters {
            if let Some(place) = platform.parameters.get_mut(name) {
                // What is drawn is a distance from nominal: the file's keys may have changed that.
                for ((place, own), nominal) in place.iter_mut().zip(own).zip(&variation.nominal) {
                    *place += own - nominal;
                }
            }
        }
        Scenario::with_platform(&self.scenario_name, &scenario.to_string(), &self.folder, platform)
    }
}

/// The numbers of a variation, at random.
fn drawn(variation: &Variation, random: &mut impl Rng) -> Vec<f64> {
    let mut between = |from: f64, to: f64| from + (to - from) * random.random::<f64>();
    match &variation.spread {
        Spread::Values(values) => {
            let place = between(0.0, values.len() as f64) as usize;
            vec![values[place.min(values.len() - 1)]]
        }
        Spread::Between([from, to]) => vec![between(*from, *to)],
        Spread::Relative(size) => {
            variation.nominal.iter().map(|number| number * (1.0 + between(-size, *size))).collect()
        }
        Spread::Absolute(size) => {
            variation.nominal.iter().map(|number| number + between(-size, *size)).collect()
        }
    }
}

/// The forces that hold a platform where it starts, on a base at rest.
fn held(model: Uhp, base: &Motion, start: &PlatformState) -> Result<Vector6<f64>, dyn_runtime::Error> {
    Hexapod::new(model).inverse_dynamics(
        &BaseMotion::at_rest(base.at(0.0).pose),
        &PlatformState::at_rest(start.pose),
        &Acceleration::zero(),
        &Wrench::zero(),
    )
}

/// The first mistake.
fn in_a_sentence(error: &ScenarioError) -> String {
    let (ScenarioError::File(file) | ScenarioError::Platform(file)) = error;
    file.refusals().first().map_or_else(|| file.to_string(), |refusal| refusal.what.clone())
}
