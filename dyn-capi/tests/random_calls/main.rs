//! Random calls of every function of the header, far beyond what is sensible, bad pointers among them: with any status but
//! `DYN_STATUS_OK` no byte of an output changes, with that one every number is finite, no call gives a status that is not
//! one of its own, and each of these is seen.
//!
//! `RANDOM_CALLS=10000000 cargo test --release -p dyn-capi --test random_calls` is a long run.
#![cfg(all(feature = "uhp", feature = "ups"))]
// C's own interface, called as C calls it.
#![allow(unsafe_code)]

mod place;
mod source;
mod statuses;

use dyn_capi as capi;
use dyn_capi::{Info, Real, Status};

use place::{Output, Place};
use source::{Situation, Source};
use statuses::Seen;

/// Calls of a run unless `RANDOM_CALLS` says otherwise.
const CALLS: u64 = 100_000;

/// Makes calls and looks at what they leave.
struct Caller {
    source: Source,
    seen: Seen,
}

impl Caller {
    /// A call with an output.
    fn call<O: Output>(&mut self, name: &'static str, call: impl FnOnce(*mut O, *mut Info) -> Status) {
        let mut output = Place::<O>::new(&mut self.source);
        self.ask(name, |info| {
            let status = call(output.pointer(), info);
            output.assert_left(name, status);
            status
        });
    }

    /// A call that gives a status and details only.
    fn ask(&mut self, name: &'static str, call: impl FnOnce(*mut Info) -> Status) {
        let mut info = Place::<Info>::new(&mut self.source);
        let status = call(info.pointer());
        info.assert_details(name, status);
        self.seen.add(name, status);
    }

    /// Every function once.
    fn round(&mut self) {
        let situation = self.source.situation();
        self.dynamics(&situation);
        self.limits(&situation);
        self.rotations();
    }

    /// Calls of a model at a state.
    fn dynamics(&mut self, situation: &Situation) {
        let source = &mut self.source;
        let model = source.pointer(&situation.model);
        let inputs = source.pointer(&situation.inputs);
        macro_rules! calls {
            ($($function:ident$(($more:expr))?: $output:ty),+ $(,)?) => {$(
                self.call(stringify!($function), |output: *mut $output, info| {
                    // SAFETY: pointers are null, misaligned, or point to what their type says.
                    unsafe { capi::$function(model, inputs, $($more,)? output, info) }
                });
            )+};
        }
        let lengths = source.numbers(&situation.lengths);
        let rates = source.six(0.5);
        let (lengths, rates) = (source.first(&lengths), source.first(&rates));
        calls! {
            dyn_rod_alignment: [Real; 6],
            dyn_leg_kinematics: capi::LegKinematics,
            dyn_jacobian_dp: [[Real; 6]; 6],
            dyn_jacobian_db: [[Real; 6]; 6],
            dyn_mass_matrix_p: [[Real; 6]; 6],
            dyn_mass_matrix_b: [[Real; 6]; 6],
            dyn_coriolis_matrices: capi::CoriolisMatrices,
            dyn_stiffness_matrices: capi::StiffnessMatrices,
            dyn_matrices: capi::Matrices,
            dyn_passive_forces: capi::PassiveForces,
            dyn_bias: [Real; 6],
            dyn_equation_of_motion: capi::EquationOfMotion,
            dyn_inverse_dynamics: [Real; 6],
            dyn_forward_dynamics: [Real; 6],
            dyn_energy: capi::Energy,
            dyn_control: capi::Control,
            dyn_passive_inverse_dynamics: [Real; 6],
            dyn_base_reaction: [Real; 6],
            dyn_forward_kinematics(lengths): capi::ForwardKinematics,
            dyn_platform_velocity(rates): [Real; 6],
        }
    }

    /// Calls about a model, and about what actuators and joints may do.
    fn limits(&mut self, situation: &Situation) {
        let source = &mut self.source;
        let (limits, coils) = (source.limits(), source.coils());
        let model = source.pointer(&situation.model);
        let inputs = source.pointer(&situation.inputs);
        let (limits, coils) = (source.pointer(&limits), source.pointer(&coils));
        let forces = source.six(60.0);
        let forces = source.first(&forces);
        // SAFETY, of all calls: pointers are null, misaligned, or point to what their type says.
        unsafe {
            self.ask("dyn_check_model", |info| capi::dyn_check_model(model, info));
            self.call("dyn_model_limits", |output, info| capi::dyn_model_limits(model, output, info));
            self.call("dyn_model_voice_coils", |output, info| {
                capi::dyn_model_voice_coils(model, output, info)
            });
            self.call("dyn_monitor", |output, info| capi::dyn_monitor(model, inputs, limits, output, info));
            self.ask("dyn_check_limits", |info| capi::dyn_check_limits(model, inputs, limits, info));
            self.call("dyn_currents", |output, info| capi::dyn_currents(coils, forces, output, info));
        }
    }

    /// Conversions.
    fn rotations(&mut self) {
        let source = &mut self.source;
        let (quaternion, angles, speeds) = (source.quaternion(), source.angles(), source.three(5.0));
        let quaternion = source.first(&quaternion);
        let (angles, speeds) = (source.first(&angles), source.first(&speeds));
        // SAFETY, of all calls: pointers are null, misaligned, or point to as many numbers as the call reads.
        unsafe {
            self.call("dyn_rotation_from_quaternion", |output, info| {
                capi::dyn_rotation_from_quaternion(quaternion, output, info)
            });
            self.call("dyn_rotation_from_angles", |output, info| {
                capi::dyn_rotation_from_angles(angles, output, info)
            });
            self.call("dyn_angular_velocity", |output, info| {
                capi::dyn_angular_velocity(angles, speeds, output, info)
            });
            self.call("dyn_angle_rates", |output, info| capi::dyn_angle_rates(angles, speeds, output, info));
        }
    }
}

#[test]
fn outputs_are_finite_or_left_alone() {
    let wanted = std::env::var("RANDOM_CALLS").ok().and_then(|number| number.parse().ok()).unwrap_or(CALLS);
    let mut caller = Caller { source: Source::new(), seen: Seen::default() };
    while caller.seen.calls() < wanted {
        caller.round();
    }
    caller.seen.assert_complete();
}
