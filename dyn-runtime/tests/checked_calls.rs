//! Every checked call against a mock model: what goes in, what comes out, what is refused.

mod mock;

use dyn_runtime::nalgebra::{Matrix3, Rotation3, SMatrix, Vector3, Vector6};
use dyn_runtime::{
    Acceleration, BaseMotion, Error, Hexapod, Input, MIN_RECIPROCAL_CONDITION, MIN_ROD_ALIGNMENT,
    PlatformState, Pose, Twist, Wrench,
};
use mock::Mock;

/// Arguments for any call, all numbers different.
#[derive(Clone)]
struct Arguments {
    base: BaseMotion,
    platform: PlatformState,
    platform_acceleration: Acceleration,
    actuator_force_n: Vector6<f64>,
    external_wrench: Wrench,
}

/// One checked call: its name, what it depends on, and itself, giving its outputs flat and row-major in the
/// order of the model's function.
struct Call {
    name: &'static str,
    inputs: &'static [Input],
    run: fn(&Hexapod<Mock>, &Arguments) -> Result<Vec<f64>, Error>,
}

use Input::*;
const POSES: &[Input] = &[BasePosition, BaseRotation, PlatformPosition, PlatformRotation];
const STATES: &[Input] =
    &[BasePosition, BaseRotation, BaseVelocity, PlatformPosition, PlatformRotation, PlatformVelocity];
const MOTIONS: &[Input] = &[
    BasePosition,
    BaseRotation,
    BaseVelocity,
    BaseAcceleration,
    PlatformPosition,
    PlatformRotation,
    PlatformVelocity,
    PlatformAcceleration,
];
const ALL: &[Input] = &[
    BasePosition,
    BaseRotation,
    BaseVelocity,
    BaseAcceleration,
    PlatformPosition,
    PlatformRotation,
    PlatformVelocity,
    PlatformAcceleration,
    ActuatorForce,
    ExternalWrench,
];
const INVERSE: &[Input] = &[
    BasePosition,
    BaseRotation,
    BaseVelocity,
    BaseAcceleration,
    PlatformPosition,
    PlatformRotation,
    PlatformVelocity,
    PlatformAcceleration,
    ExternalWrench,
];
const FORWARD: &[Input] = &[
    BasePosition,
    BaseRotation,
    BaseVelocity,
    BaseAcceleration,
    PlatformPosition,
    PlatformRotation,
    PlatformVelocity,
    ActuatorForce,
    ExternalWrench,
];

const CALLS: &[Call] = &[
    Call {
        name: "rod_alignment",
        inputs: POSES,
        run: |hexapod, a| Ok(flat(&[hexapod.rod_alignment(&a.base, &a.platform)?])),
    },
    Call {
        name: "leg_kinematics",
        inputs: MOTIONS,
        run: |hexapod, a| {
            let k = hexapod.leg_kinematics(&a.base, &a.platform, &a.platform_acceleration)?;
            let lengths = [k.actuator_length_m, k.actuator_velocity_m_s, k.actuator_acceleration_m_s2];
            let vectors = [
                k.rod_direction,
                k.hooke_joint_position_m,
                k.platform_joint_position_m,
                k.universal_joint_rate_rad_s,
            ];
            Ok([flat(&lengths), flat(vectors.as_flattened())].concat())
        },
    },
    Call {
        name: "body_kinematics",
        inputs: MOTIONS,
        run: |hexapod, a| {
            let k = hexapod.body_kinematics(&a.base, &a.platform, &a.platform_acceleration)?;
            let payload =
                [k.payload_com_position_m, k.payload_com_velocity_m_s, k.payload_com_acceleration_m_s2];
            let legs = [
                k.rod_angular_velocity_rad_s,
                k.rod_angular_acceleration_rad_s2,
                k.rod_com_position_m,
                k.rod_com_velocity_m_s,
                k.rod_com_acceleration_m_s2,
                k.mover_position_m,
                k.mover_velocity_m_s,
                k.mover_acceleration_m_s2,
            ];
            Ok([flat(&payload), flat(legs.as_flattened())].concat())
        },
    },
    Call {
        name: "partial_velocities",
        inputs: POSES,
        run: |hexapod, a| {
            let v = hexapod.partial_velocities(&a.base, &a.platform)?;
            let payload = [v.payload_partial_velocity, v.payload_partial_angular_velocity];
            let legs = [v.rod_partial_velocity, v.rod_partial_angular_velocity, v.mover_partial_velocity];
            Ok([flat(&payload), flat(legs.as_flattened())].concat())
        },
    },
    Call {
        name: "generalised_forces",
        inputs: ALL,
        run: |hexapod, a| {
            let f = hexapod.generalised_forces(
                &a.base,
                &a.platform,
                &a.platform_acceleration,
                &a.actuator_force_n,
                &a.external_wrench,
            )?;
            let legs = [f.rod_active_force, f.rod_inertia_force, f.mover_active_force, f.mover_inertia_force];
            Ok([flat(&[f.payload_active_force, f.payload_inertia_force]), flat(legs.as_flattened())].concat())
        },
    },
    Call {
        name: "jacobian_dp",
        inputs: POSES,
        run: |hexapod, a| Ok(flat(&[hexapod.jacobian_dp(&a.base, &a.platform)?])),
    },
    Call {
        name: "jacobian_db",
        inputs: POSES,
        run: |hexapod, a| Ok(flat(&[hexapod.jacobian_db(&a.base, &a.platform)?])),
    },
    Call {
        name: "mass_matrix_p",
        inputs: POSES,
        run: |hexapod, a| Ok(flat(&[hexapod.mass_matrix_p(&a.base, &a.platform)?])),
    },
    Call {
        name: "mass_matrix_b",
        inputs: POSES,
        run: |hexapod, a| Ok(flat(&[hexapod.mass_matrix_b(&a.base, &a.platform)?])),
    },
    Call {
        name: "coriolis_matrices",
        inputs: STATES,
        run: |hexapod, a| {
            let c = hexapod.coriolis_matrices(&a.base, &a.platform)?;
            Ok(flat(&[c.coriolis_matrix_p, c.coriolis_matrix_b]))
        },
    },
    Call {
        name: "stiffness_matrices",
        inputs: POSES,
        run: |hexapod, a| {
            let k = hexapod.stiffness_matrices(&a.base, &a.platform)?;
            Ok(flat(&[k.stiffness_matrix_p, k.stiffness_matrix_b]))
        },
    },
    Call {
        name: "matrices",
        inputs: STATES,
        run: |hexapod, a| {
            let m = hexapod.matrices(&a.base, &a.platform)?;
            Ok(flat(&[
                m.mass_matrix_p,
                m.coriolis_matrix_p,
                m.jacobian_dp,
                m.mass_matrix_b,
                m.coriolis_matrix_b,
                m.jacobian_db,
            ]))
        },
    },
    Call {
        name: "passive_forces",
        inputs: STATES,
        run: |hexapod, a| {
            let f = hexapod.passive_forces(&a.base, &a.platform)?;
            Ok(flat(&[f.gravity_force, f.spring_force, f.damping_force]))
        },
    },
    Call { name: "bias", inputs: STATES, run: |hexapod, a| Ok(flat(&[hexapod.bias(&a.base, &a.platform)?])) },
    Call {
        name: "equation_of_motion",
        inputs: STATES,
        run: |hexapod, a| {
            let e = hexapod.equation_of_motion(&a.base, &a.platform)?;
            let matrices = [
                e.mass_matrix_p,
                e.coriolis_matrix_p,
                e.stiffness_matrix_p,
                e.jacobian_dp,
                e.mass_matrix_b,
                e.coriolis_matrix_b,
                e.stiffness_matrix_b,
                e.jacobian_db,
            ];
            let forces = [e.gravity_force, e.spring_force, e.damping_force, e.bias];
            Ok([flat(&matrices), flat(&forces)].concat())
        },
    },
    Call {
        name: "inverse_dynamics",
        inputs: INVERSE,
        run: |hexapod, a| {
            Ok(flat(&[hexapod.inverse_dynamics(
                &a.base,
                &a.platform,
                &a.platform_acceleration,
                &a.external_wrench,
            )?]))
        },
    },
    Call {
        name: "forward_dynamics",
        inputs: FORWARD,
        run: |hexapod, a| {
            let acceleration =
                hexapod.forward_dynamics(&a.base, &a.platform, &a.actuator_force_n, &a.external_wrench)?;
            Ok(flat(&[acceleration.to_vector()]))
        },
    },
    Call {
        name: "energy",
        inputs: STATES,
        run: |hexapod, a| {
            let energy = hexapod.energy(&a.base, &a.platform)?;
            Ok(vec![energy.kinetic_j, energy.potential_j])
        },
    },
];

/// Elements row by row.
fn flat<const R: usize, const C: usize>(matrices: &[SMatrix<f64, R, C>]) -> Vec<f64> {
    matrices.iter().flat_map(|matrix| matrix.transpose().iter().copied().collect::<Vec<_>>()).collect()
}

fn arguments() -> Arguments {
    let v = |x: f64| Vector3::new(x, x + 0.1, x + 0.2);
    Arguments {
        base: BaseMotion {
            pose: Pose::from_paper_angles(v(1.0), [0.1, 0.2, 0.3]),
            velocity: Twist { linear_m_s: v(2.0), angular_rad_s: v(3.0) },
            acceleration: Acceleration { linear_m_s2: v(4.0), angular_rad_s2: v(5.0) },
        },
        platform: PlatformState {
            pose: Pose::from_paper_angles(v(6.0), [-0.3, 0.1, -0.2]),
            velocity: Twist { linear_m_s: v(7.0), angular_rad_s: v(8.0) },
        },
        platform_acceleration: Acceleration { linear_m_s2: v(9.0), angular_rad_s2: v(10.0) },
        actuator_force_n: Vector6::new(11.0, 11.1, 11.2, 11.3, 11.4, 11.5),
        external_wrench: Wrench { force_n: v(12.0), moment_n_m: v(13.0) },
    }
}

impl Arguments {
    /// An input as the model's functions take it.
    fn flat(&self, input: Input) -> Vec<f64> {
        match input {
            BasePosition => flat(&[self.base.pose.position_m]),
            BaseRotation => flat(&[*self.base.pose.rotation.matrix()]),
            BaseVelocity => flat(&[self.base.velocity.to_vector()]),
            BaseAcceleration => flat(&[self.base.acceleration.to_vector()]),
            PlatformPosition => flat(&[self.platform.pose.position_m]),
            PlatformRotation => flat(&[*self.platform.pose.rotation.matrix()]),
            PlatformVelocity => flat(&[self.platform.velocity.to_vector()]),
            PlatformAcceleration => flat(&[self.platform_acceleration.to_vector()]),
            ActuatorForce => flat(&[self.actuator_force_n]),
            ExternalWrench => flat(&[self.external_wrench.to_vector()]),
            _ => unreachable!("{input} is not in this table"),
        }
    }

    /// With one element of one input replaced.
    fn with(&self, input: Input, element: usize, value: f64) -> Self {
        let mut changed = self.clone();
        let six = |upper: &mut Vector3<f64>, lower: &mut Vector3<f64>| {
            *(if element < 3 { &mut upper[element] } else { &mut lower[element - 3] }) = value;
        };
        let nine = |rotation: &mut Rotation3<f64>| {
            let mut matrix = *rotation.matrix();
            matrix[(element / 3, element % 3)] = value;
            *rotation = Rotation3::from_matrix_unchecked(matrix);
        };
        let Self { base, platform, platform_acceleration, actuator_force_n, external_wrench } = &mut changed;
        match input {
            BasePosition => base.pose.position_m[element] = value,
            BaseRotation => nine(&mut base.pose.rotation),
            BaseVelocity => six(&mut base.velocity.linear_m_s, &mut base.velocity.angular_rad_s),
            BaseAcceleration => {
                six(&mut base.acceleration.linear_m_s2, &mut base.acceleration.angular_rad_s2)
            }
            PlatformPosition => platform.pose.position_m[element] = value,
            PlatformRotation => nine(&mut platform.pose.rotation),
            PlatformVelocity => six(&mut platform.velocity.linear_m_s, &mut platform.velocity.angular_rad_s),
            PlatformAcceleration => {
                six(&mut platform_acceleration.linear_m_s2, &mut platform_acceleration.angular_rad_s2);
            }
            ActuatorForce => actuator_force_n[element] = value,
            ExternalWrench => six(&mut external_wrench.force_n, &mut external_wrench.moment_n_m),
            _ => unreachable!("{input} is not in this table"),
        }
        changed
    }
}

/// A hexapod for this call: J_dp counts only where it is the result.
fn hexapod_for(call: &Call) -> Hexapod<Mock> {
    Hexapod::new(if call.name == "jacobian_dp" { Mock::counting() } else { Mock::regular() })
}

#[test]
fn every_number_goes_where_it_belongs() {
    let arguments = arguments();
    for call in CALLS.iter().filter(|call| call.name != "rod_alignment") {
        let hexapod = hexapod_for(call);
        let outputs = (call.run)(&hexapod, &arguments).expect(call.name);
        let inputs: Vec<f64> = call.inputs.iter().flat_map(|input| arguments.flat(*input)).collect();
        assert_eq!(*hexapod.model.inputs.borrow(), inputs, "inputs of {}", call.name);
        let counted: Vec<f64> = (1..=hexapod.model.outputs.get()).map(|i| i as f64).collect();
        assert_eq!(outputs, counted, "outputs of {}", call.name);
        assert_eq!(hexapod.model.calls.get(), 1, "{}", call.name);
    }
}

#[test]
fn inputs_that_are_not_finite_are_named_before_the_model_is_asked() {
    for call in CALLS {
        for input in ALL {
            for element in 0..arguments().flat(*input).len() {
                for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                    let hexapod = hexapod_for(call);
                    let result = (call.run)(&hexapod, &arguments().with(*input, element, value));
                    if call.inputs.contains(input) {
                        assert_eq!(result, Err(Error::NonFinite { input: *input }), "{}", call.name);
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
    for call in CALLS {
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
            for alignment in [-1e-300, -0.3, f64::NEG_INFINITY, f64::NAN] {
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
    hexapod.model.rod_alignment[5] = f64::NAN;
    let result = hexapod.rod_alignment(&arguments().base, &arguments().platform);
    assert_eq!(result, Err(Error::NonFiniteResult));
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

#[test]
fn messages_name_what_is_wrong_and_what_to_do() {
    let message = |error: Error| error.to_string();
    assert!(message(Error::OutOfReach { leg: 2 }).starts_with("leg 3 (index 2) is out of reach"));
    assert!(
        message(Error::RodPerpendicular { leg: 0 }).starts_with("leg 1 (index 0): the rod is perpendicular")
    );
    assert!(
        message(Error::NonFinite { input: BaseVelocity })
            .starts_with("velocity of the base: NaN or infinite")
    );
    let singular = Error::SingularJacobian { reciprocal_condition: 3.21e-9 };
    assert!(message(singular).contains("reciprocal condition number 3.2e-9"));
    let Err(defect) = Pose::from_rotation_matrix(Vector3::zeros(), &(Matrix3::identity() * 2.0)) else {
        panic!("refused");
    };
    let not_a_rotation = message(Error::NotARotation { input: PlatformRotation, defect });
    assert!(
        not_a_rotation.starts_with("rotation of the platform: not a rotation matrix"),
        "{not_a_rotation}"
    );
    assert!(message(Error::NonFiniteResult).contains("check units"));
    assert!(size_of::<Error>() <= 24);
}
