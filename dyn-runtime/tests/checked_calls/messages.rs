//! What errors say.

use dyn_runtime::Input::{BaseVelocity, PlatformRotation};
use dyn_runtime::nalgebra::{Matrix3, Vector3};
use dyn_runtime::{Error, GimbalLock, Pose, Quantity};

#[test]
fn messages_name_what_is_wrong_and_what_to_do() {
    let message = |error: Error| error.to_string();
    let invalid = message(Error::InvalidModel { leg: 0 });
    assert!(
        invalid.contains("leg 1 (index 0)") && invalid.contains("every parameter is filled in"),
        "{invalid}"
    );
    assert!(GimbalLock { cos_c2: -3.4e-9 }.to_string().contains("cos c2 is -3.4e-9"));
    assert!(message(Error::OutOfReach { leg: 2 }).starts_with("leg 3 (index 2) is out of reach"));
    assert!(
        message(Error::RodPerpendicular { leg: 0 }).starts_with("leg 1 (index 0): the rod is perpendicular")
    );
    assert!(
        message(Error::NonFinite { input: BaseVelocity, element: 5 })
            .starts_with("velocity of the base: element 5 (counted from 0, row by row) is NaN or infinite")
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
    let limit = message(Error::InvalidLimit { quantity: Quantity::HookeJointAngle, leg: Some(3) });
    assert!(limit.starts_with("leg 4 (index 3): the limit of angle at the Hooke joint is NaN"), "{limit}");
    let bound = message(Error::InvalidLimit { quantity: Quantity::Conditioning, leg: None });
    assert!(bound.starts_with("all legs together: the limit of conditioning"), "{bound}");
    assert!(message(Error::InvalidCoil { leg: 0 }).starts_with("leg 1 (index 0): the voice coil"));
    let beyond = |quantity| message(Error::BeyondLimit { quantity, leg: Some(0), margin: -1.5 });
    assert!(beyond(Quantity::ActuatorForce).ends_with("by 1.500e0 N; ask for less acceleration"));
    assert!(beyond(Quantity::ActuatorLength).ends_with("nearer to its home"));
    assert!(message(Error::NonFiniteResult).contains("check units"));
    assert!(size_of::<Error>() <= 32);
}
