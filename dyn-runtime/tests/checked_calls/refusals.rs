//! Poses, models and results that are refused.

use dyn_runtime::{Error, Hexapod, Limits, MIN_RECIPROCAL_CONDITION, MIN_ROD_ALIGNMENT};

use crate::arguments::arguments;
use crate::calls::{CALLS, all_calls, calls_at_poses, hexapod_for};
use crate::mock::{JACOBIAN_IN_CONTROL, Mock};

#[test]
fn legs_out_of_reach_or_perpendicular_are_named() {
    let below_threshold = MIN_ROD_ALIGNMENT * (1.0 - 1e-12);
    for call in calls_at_poses().filter(|call| call.name != "rod_alignment") {
        for leg in 0..6 {
            let run_with = |alignment| {
                let mut hexapod = hexapod_for(call);
                hexapod.model.rod_alignment[leg] = alignment;
                let result = (call.run)(&hexapod, &arguments());
                // Forward kinematics has nothing to ask but where the legs are.
                let is_asked = result.is_ok() && call.name != "forward_kinematics";
                assert_eq!(hexapod.model.calls.get(), usize::from(is_asked), "{}", call.name);
                result.map(|_| ())
            };
            for alignment in [-1e-300, -0.3, -1e300] {
                assert_eq!(run_with(alignment), Err(Error::OutOfReach { leg }), "{}", call.name);
            }
            for alignment in [0.0, 1e-9, below_threshold] {
                assert_eq!(run_with(alignment), Err(Error::RodPerpendicular { leg }), "{}", call.name);
            }
            assert_eq!(run_with(MIN_ROD_ALIGNMENT), Ok(()), "{}", call.name);
        }
    }
}

#[test]
fn alignment_is_told_even_out_of_reach() {
    let mut hexapod = Hexapod::new(Mock::regular());
    hexapod.model.rod_alignment = [0.9, 0.5, 0.0, -0.5, -3.0, 1.0];
    let alignment =
        hexapod.rod_alignment(&arguments().base, &arguments().platform).expect("no reach is refused");
    assert_eq!(alignment.as_slice(), hexapod.model.rod_alignment);
}

/// A rod without length gives minus infinity, a parameter that is NaN gives NaN.
#[test]
fn a_model_that_is_not_a_mechanism_is_told_from_poses_out_of_reach() {
    let mut far = arguments();
    far.platform.pose.position_m.y = -1e160;
    for call in calls_at_poses() {
        for leg in 0..6 {
            for alignment in [f64::NEG_INFINITY, f64::INFINITY, f64::NAN] {
                let mut hexapod = hexapod_for(call);
                hexapod.model.rod_alignment[leg] = alignment;
                let near = (call.run)(&hexapod, &arguments());
                assert_eq!(near, Err(Error::InvalidModel { leg }), "{} {alignment}", call.name);
                assert_eq!(hexapod.model.calls.get(), 0, "{}", call.name);
            }
            // So far apart that squares overflow: not the model's fault.
            for alignment in [f64::NEG_INFINITY, f64::NAN] {
                let mut hexapod = hexapod_for(call);
                hexapod.model.rod_alignment[leg] = alignment;
                let expected = if call.name == "rod_alignment" {
                    Error::NonFiniteResult
                } else {
                    Error::OutOfReach { leg }
                };
                assert_eq!((call.run)(&hexapod, &far), Err(expected), "{} {alignment}", call.name);
            }
        }
    }
}

/// Calls that solve with J_dp, and whether they do so before the model is asked.
const SOLVING: [(&str, bool); 4] = [
    ("inverse_dynamics", true),
    ("passive_inverse_dynamics", true),
    ("control", false),
    ("platform_velocity", false),
];

#[test]
fn the_calls_that_solve_with_the_jacobian_refuse_a_singular_one() {
    for call in all_calls() {
        let mut hexapod = hexapod_for(call);
        let mut jacobian_dp = hexapod.model.jacobian_dp.unwrap_or([[1.0; 6]; 6]);
        jacobian_dp[5] = jacobian_dp[4];
        hexapod.model.jacobian_dp = Some(jacobian_dp);
        let result = (call.run)(&hexapod, &arguments());
        match SOLVING.iter().find(|(name, _)| *name == call.name) {
            Some((name, is_first)) => {
                assert_eq!(result, Err(Error::SingularJacobian { reciprocal_condition: 0.0 }), "{name}");
                assert_eq!(hexapod.model.calls.get(), usize::from(!is_first), "{name}");
            }
            None => assert!(result.is_ok(), "{}", call.name),
        }
    }
}

/// Where the lengths at the start are the ones wanted, no step is needed.
#[test]
fn forward_kinematics_refuses_a_singular_jacobian_where_it_needs_a_step() {
    let mut hexapod = Hexapod::new(Mock::regular());
    let mut jacobian_dp = hexapod.model.jacobian_dp.expect("regular");
    jacobian_dp[5] = jacobian_dp[4];
    hexapod.model.jacobian_dp = Some(jacobian_dp);
    let a = arguments();
    let pose = |lengths| hexapod.forward_kinematics(&a.base.pose, &lengths, &a.platform.pose).map(drop);
    assert_eq!(pose(a.actuator_length_m), Ok(()));
    let refusal = Err(Error::SingularJacobian { reciprocal_condition: 0.0 });
    assert_eq!(pose(a.actuator_length_m * 1.01), refusal);
}

#[test]
fn an_ill_conditioned_jacobian_is_refused_with_its_condition() {
    let hexapod_with = |difference: f64| {
        let mut mock = Mock::regular();
        let jacobian_dp = mock.jacobian_dp.as_mut().expect("regular");
        jacobian_dp[5] = jacobian_dp[4];
        jacobian_dp[5][5] += difference;
        Hexapod::new(mock)
    };
    let a = arguments();
    let forces = |hexapod: &Hexapod<Mock>| {
        hexapod.inverse_dynamics(&a.base, &a.platform, &a.platform_acceleration, &a.external_wrench)
    };
    let Err(Error::SingularJacobian { reciprocal_condition }) = forces(&hexapod_with(1e-6)) else {
        panic!("refused");
    };
    assert!((1e-9..MIN_RECIPROCAL_CONDITION).contains(&reciprocal_condition), "{reciprocal_condition}");
    assert!(forces(&hexapod_with(1e-2)).is_ok());
}

#[test]
fn any_output_that_is_not_finite_is_refused() {
    for call in CALLS.iter().filter(|call| call.name != "rod_alignment") {
        let mut hexapod = hexapod_for(call);
        (call.run)(&hexapod, &arguments()).expect(call.name);
        for poisoned in 0..hexapod.model.outputs.get() {
            hexapod.model.poisoned = Some(poisoned);
            // J_dp is judged before the results are.
            let expected = if call.name == "control" && JACOBIAN_IN_CONTROL.contains(&poisoned) {
                Error::SingularJacobian { reciprocal_condition: 0.0 }
            } else {
                Error::NonFiniteResult
            };
            assert_eq!((call.run)(&hexapod, &arguments()), Err(expected), "{} {poisoned}", call.name);
        }
    }
}

/// Of the kinematics of the legs, monitors look at lengths, their rates and directions, and at J_dp.
#[test]
fn monitors_look_at_what_they_need() {
    let (lengths_and_rates, directions) = (0..12, 18..36);
    let a = arguments();
    let monitor = |hexapod: &Hexapod<Mock>| {
        hexapod.monitor(&a.base, &a.platform, &a.actuator_force_n, &Limits::none()).map(drop)
    };
    let mut hexapod = Hexapod::new(Mock::regular());
    assert_eq!(monitor(&hexapod), Ok(()));
    for poisoned in 0..hexapod.model.outputs.get() {
        hexapod.model.poisoned = Some(poisoned);
        let is_needed = lengths_and_rates.contains(&poisoned) || directions.contains(&poisoned);
        let expected = if is_needed { Err(Error::NonFiniteResult) } else { Ok(()) };
        assert_eq!(monitor(&hexapod), expected, "{poisoned}");
    }
    let mut hexapod = Hexapod::new(Mock::regular());
    hexapod.model.jacobian_dp = Some([[f64::NAN; 6]; 6]);
    assert_eq!(monitor(&hexapod), Err(Error::NonFiniteResult));
}

#[test]
fn a_velocity_that_is_not_finite_is_refused() {
    let mut hexapod = Hexapod::new(Mock::regular());
    let a = arguments();
    for poisoned in 0..36 {
        hexapod.model.poisoned = Some(poisoned);
        let found = hexapod.platform_velocity(&a.base, &a.platform.pose, &a.actuator_velocity_m_s);
        assert_eq!(found, Err(Error::NonFiniteResult), "{poisoned}");
    }
}
