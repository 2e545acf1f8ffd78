//! Poses, models and results that are refused.

use dyn_runtime::{Error, Hexapod, MIN_RECIPROCAL_CONDITION, MIN_ROD_ALIGNMENT};

use crate::arguments::arguments;
use crate::calls::{CALLS, hexapod_for};
use crate::mock::Mock;

#[test]
fn legs_out_of_reach_or_perpendicular_are_named() {
    let below_threshold = MIN_ROD_ALIGNMENT * (1.0 - 1e-12);
    for call in CALLS.iter().filter(|call| call.name != "rod_alignment") {
        for leg in 0..6 {
            let run_with = |alignment| {
                let mut hexapod = hexapod_for(call);
                hexapod.model.rod_alignment[leg] = alignment;
                let result = (call.run)(&hexapod, &arguments());
                assert_eq!(hexapod.model.calls.get(), usize::from(result.is_ok()), "{}", call.name);
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
    for call in CALLS {
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

#[test]
fn only_inverse_dynamics_refuses_a_singular_jacobian() {
    for call in CALLS {
        let mut hexapod = hexapod_for(call);
        let mut jacobian_dp = hexapod.model.jacobian_dp.unwrap_or([[1.0; 6]; 6]);
        jacobian_dp[5] = jacobian_dp[4];
        hexapod.model.jacobian_dp = Some(jacobian_dp);
        let result = (call.run)(&hexapod, &arguments());
        if call.name == "inverse_dynamics" {
            assert_eq!(result, Err(Error::SingularJacobian { reciprocal_condition: 0.0 }));
            assert_eq!(hexapod.model.calls.get(), 0);
        } else {
            assert!(result.is_ok(), "{}", call.name);
        }
    }
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
            assert_eq!(
                (call.run)(&hexapod, &arguments()),
                Err(Error::NonFiniteResult),
                "{} {poisoned}",
                call.name
            );
        }
    }
}
