//! Which call ends how.

use std::collections::{BTreeMap, BTreeSet};

use dyn_capi::Status::{self, *};

/// Every status of a call but `NonFiniteResult`, which calls of a model may have and need not.
fn own(call: &str) -> Vec<Status> {
    let at_poses = [UnknownModel, NonFinite, NotARotation, InvalidModel, OutOfReach, RodPerpendicular];
    let own: Vec<Status> = match call {
        "dyn_rotation_from_quaternion" => vec![NonFinite, NotARotation],
        "dyn_rotation_from_angles" | "dyn_angular_velocity" => vec![NonFinite],
        "dyn_angle_rates" => vec![NonFinite, GimbalLock],
        "dyn_currents" => vec![NonFinite, InvalidCoil],
        "dyn_check_model" => vec![UnknownModel, InvalidParameter],
        // The paper does not say what its coils are.
        "dyn_model_voice_coils" => return vec![NullPointer, WrongStructSize, UnknownModel, NotInModel],
        "dyn_model_limits" => vec![UnknownModel, NotInModel],
        // Out of reach is what it tells.
        "dyn_rod_alignment" => vec![UnknownModel, NonFinite, NotARotation, InvalidModel],
        "dyn_inverse_dynamics" | "dyn_control" | "dyn_passive_inverse_dynamics" | "dyn_platform_velocity" => {
            [&at_poses[..], &[SingularJacobian]].concat()
        }
        "dyn_forward_kinematics" => [&at_poses[..], &[SingularJacobian, NoConvergence]].concat(),
        "dyn_monitor" => [&at_poses[..], &[InvalidLimit]].concat(),
        "dyn_check_limits" => [&at_poses[..], &[InvalidLimit, BeyondLimit]].concat(),
        _ => at_poses.to_vec(),
    };
    [&[Ok, NullPointer, WrongStructSize], &own[..]].concat()
}

/// How often each call ended how.
#[derive(Default)]
pub struct Seen {
    calls: u64,
    /// By call and status.
    counts: BTreeMap<(&'static str, i32), u64>,
}

impl Seen {
    pub fn calls(&self) -> u64 {
        self.calls
    }

    /// Counts an end that the call may have.
    pub fn add(&mut self, call: &'static str, status: Status) {
        let is_conversion = call.contains("rotation") || call.contains("angle") || call.contains("angular");
        let may_be = status == NonFiniteResult && !is_conversion;
        assert!(may_be || own(call).contains(&status), "{call}: {status:?}");
        self.calls += 1;
        *self.counts.entry((call, status as i32)).or_default() += 1;
    }

    /// Every function of the header that gives a status has been called and has ended in every way that it has.
    pub fn assert_complete(&self) {
        let header = include_str!("../../include/dyn_capi.h");
        let functions = header.lines().filter_map(|line| line.strip_prefix("dyn_status "));
        let functions: BTreeSet<&str> = functions.filter_map(|line| line.split('(').next()).collect();
        let called: BTreeSet<&str> = self.counts.keys().map(|(call, _)| *call).collect();
        assert_eq!(called, functions);
        let count = |call: &'static str, status: Status| self.counts.get(&(call, status as i32)).copied();
        let mut missing = Vec::new();
        for call in called {
            let seen = own(call).into_iter().map(|status| (status, count(call, status).unwrap_or(0)));
            let seen: Vec<(Status, u64)> = seen.collect();
            println!("{call}: {seen:?}, not finite {}", count(call, NonFiniteResult).unwrap_or(0));
            missing.extend(seen.iter().filter(|(_, count)| *count == 0).map(|(status, _)| (call, *status)));
        }
        assert!(missing.is_empty(), "never seen: {missing:?}");
        assert!(self.counts.keys().any(|(_, status)| *status == NonFiniteResult as i32));
    }
}
