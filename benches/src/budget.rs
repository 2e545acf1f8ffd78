//! Instruction counts that may not grow: of generated code, so that it stays fast, and of the reference, so that
//! ratios are never won by slowing it down.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::counts::Counts;

/// How far counts may exceed the budget, as a fraction: the C library's copying and the order of code differ a little
/// from machine to machine.
pub const SLACK: f64 = 0.02;

/// The implementation whose budget [`Budget::lowered`] never raises.
const REFERENCE: &str = "reference";

/// Counts and the circumstances they hold in; `instruction_budget.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Budget {
    /// [`CODEGEN`](crate::CODEGEN) of the program that counted.
    pub codegen: String,
    /// Instructions per call by function and implementation.
    pub instructions_per_call: Counts,
}

/// A count beside its budget.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The function.
    pub function: String,
    /// The implementation.
    pub implementation: String,
    /// Instructions per call.
    pub counted: u64,
    /// The most that was granted, without [`SLACK`]; none for a case that the budget does not know.
    pub granted: Option<u64>,
}

impl Comparison {
    /// Whether the count is within the budget and [`SLACK`].
    pub fn holds(&self) -> bool {
        self.granted.is_some_and(|granted| self.counted as f64 <= granted as f64 * (1.0 + SLACK))
    }
}

impl Budget {
    /// Where the budget is committed.
    pub fn path() -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("instruction_budget.json")
    }

    /// The committed budget.
    ///
    /// # Errors
    /// If it cannot be read, in words.
    pub fn committed() -> Result<Self, String> {
        let path = Self::path();
        let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        serde_json::from_str(&text).map_err(|error| format!("{}: {error}", path.display()))
    }

    /// Every count beside its budget.
    pub fn compare(&self, counts: &Counts) -> Vec<Comparison> {
        let granted = |function: &String, implementation: &String| {
            self.instructions_per_call.get(function)?.get(implementation).copied()
        };
        counts
            .iter()
            .flat_map(|(function, row)| {
                row.iter().map(move |(implementation, &n)| (function, implementation, n))
            })
            .map(|(function, implementation, counted)| Comparison {
                function: function.clone(),
                implementation: implementation.clone(),
                counted,
                granted: granted(function, implementation),
            })
            .collect()
    }

    /// `counted` as the next budget after `self`. While compiler and flags stay the same, what is granted to the
    /// reference only falls.
    pub fn lowered(&self, mut counted: Self) -> Self {
        if self.codegen == counted.codegen {
            for (function, row) in &mut counted.instructions_per_call {
                let before = self.instructions_per_call.get(function).and_then(|row| row.get(REFERENCE));
                if let (Some(&before), Some(now)) = (before, row.get_mut(REFERENCE)) {
                    *now = before.min(*now);
                }
            }
        }
        counted
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases::all;
    use crate::states::{States, platform, sampled};

    fn budget(generated: u64, reference: u64) -> Budget {
        let row = [("generated", generated), ("reference", reference)];
        let row = row.map(|(name, count)| (name.to_owned(), count)).into();
        Budget { codegen: "same".into(), instructions_per_call: [("energy".to_owned(), row)].into() }
    }

    #[test]
    fn counts_may_exceed_by_the_slack_alone() {
        let budget = budget(1000, 1000);
        let holds = |counts: &Budget| -> Vec<bool> {
            budget.compare(&counts.instructions_per_call).iter().map(Comparison::holds).collect()
        };
        assert_eq!(holds(&self::budget(1020, 900)), [true, true]);
        assert_eq!(holds(&self::budget(1021, 1021)), [false, false]);
    }

    #[test]
    fn a_case_without_budget_does_not_hold() {
        let nothing = Budget { codegen: "same".into(), instructions_per_call: Counts::new() };
        assert!(nothing.compare(&budget(1, 1).instructions_per_call).iter().all(|case| !case.holds()));
    }

    #[test]
    fn the_reference_is_granted_more_only_to_another_compiler() {
        assert_eq!(budget(1000, 5000).lowered(budget(1500, 6000)), budget(1500, 5000));
        assert_eq!(budget(1000, 5000).lowered(budget(800, 4000)), budget(800, 4000));
        let other = Budget { codegen: "other".into(), ..budget(1500, 6000) };
        assert_eq!(budget(1000, 5000).lowered(other.clone()), other);
    }

    #[test]
    fn the_committed_budget_covers_every_case() {
        let budget = Budget::committed().unwrap();
        let platform = platform();
        for case in all(&platform, &States::new(&sampled(&platform))) {
            let row = budget.instructions_per_call.get(case.function);
            assert!(row.is_some_and(|row| row.contains_key(case.implementation)), "{case:?}");
        }
    }
}
