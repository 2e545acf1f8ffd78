//! Every number goes where it belongs; what is not one is named.

use dyn_runtime::Input::*;
use dyn_runtime::nalgebra::{Matrix3, Matrix6, Rotation3, Vector6};
use dyn_runtime::{Error, Hexapod};

use crate::arguments::arguments;
use crate::calls::{ALL, CALLS, all_calls, calls_at_poses, hexapod_for};
use crate::mock::{JACOBIAN_IN_CONTROL, Mock};

#[test]
fn every_number_goes_where_it_belongs() {
    let arguments = arguments();
    for call in CALLS.iter().filter(|call| call.name != "rod_alignment") {
        let hexapod = hexapod_for(call);
        let outputs = (call.run)(&hexapod, &arguments).expect(call.name);
        let inputs: Vec<f64> = call.inputs.iter().flat_map(|input| arguments.flat(*input)).collect();
        assert_eq!(*hexapod.model.inputs.borrow(), inputs, "inputs of {}", call.name);
        let mut counted: Vec<f64> = (1..=hexapod.model.outputs.get()).map(|i| i as f64).collect();
        if call.name == "control" {
            let given = hexapod.model.jacobian_dp.expect("regular");
            counted[JACOBIAN_IN_CONTROL].copy_from_slice(given.as_flattened());
        }
        assert_eq!(outputs, counted, "outputs of {}", call.name);
        assert_eq!(hexapod.model.calls.get(), 1, "{}", call.name);
    }
}

#[test]
fn inputs_that_are_not_finite_are_named_before_the_model_is_asked() {
    for call in all_calls() {
        for input in ALL {
            for element in 0..arguments().flat(*input).len() {
                for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                    let hexapod = hexapod_for(call);
                    let result = (call.run)(&hexapod, &arguments().with(*input, element, value));
                    if call.inputs.contains(input) {
                        assert_eq!(result, Err(Error::NonFinite { input: *input, element }), "{}", call.name);
                        assert_eq!(hexapod.model.calls.get(), 0, "{}", call.name);
                    } else {
                        assert!(result.is_ok(), "{} does not depend on the {input}", call.name);
                    }
                }
            }
        }
    }
}

#[test]
fn rotations_that_are_not_are_named() {
    for call in calls_at_poses() {
        for input in [BaseRotation, PlatformRotation] {
            let hexapod = hexapod_for(call);
            let result = (call.run)(&hexapod, &arguments().with(input, 4, 0.5));
            let Err(Error::NotARotation { input: named, defect }) = result else {
                panic!("{}: {result:?}", call.name);
            };
            assert!(named == input && defect.deviation > 0.01, "{}: {result:?}", call.name);
            assert_eq!(hexapod.model.calls.get(), 0, "{}", call.name);
        }
        let mut reflected = arguments();
        reflected.base.pose.rotation = Rotation3::from_matrix_unchecked(-Matrix3::identity());
        let result = (call.run)(&hexapod_for(call), &reflected);
        let Err(Error::NotARotation { input: BaseRotation, defect }) = result else {
            panic!("{}: {result:?}", call.name);
        };
        assert_eq!(defect.determinant, -1.0, "{}", call.name);
    }
}

/// J_dp of the mock is a lower triangle of ones: each speed is what the rates of a leg and the one before it differ by.
#[test]
fn the_platforms_velocity_is_made_of_rates_and_the_bases() {
    let (hexapod, arguments) = (Hexapod::new(Mock::regular()), arguments());
    let (base, rates) = (&arguments.base, &arguments.actuator_velocity_m_s);
    let found = hexapod.platform_velocity(base, &arguments.platform.pose, rates).expect("regular");
    // J_db counts from 1.
    let jacobian_db = Matrix6::from_fn(|r, c| (6 * r + c + 1) as f64);
    let right = rates + jacobian_db * base.velocity.to_vector();
    let expected = Vector6::from_fn(|row, _| right[row] - if row > 0 { right[row - 1] } else { 0.0 });
    assert!((found.to_vector() - expected).amax() < 1e-11 * right.amax(), "{found:?}, not {expected}");
}
