//! What errors say.

use dyn_runtime::Input::{BaseVelocity, PlatformRotation};
use dyn_runtime::nalgebra::{Matrix3, Vector3};
use dyn_runtime::{Error, GimbalLock, Pose};

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
    assert!(size_of::<Error>() <= 32);
}
